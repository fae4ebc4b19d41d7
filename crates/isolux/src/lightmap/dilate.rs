//! Texels beside charts, and those of which nothing is known, from their neighbours.

use super::texels::{Cover, Lightmap};

/// Fills empty texels within the padding of charts, and all unknown ones, round by round with the mean of their
/// neighbours of the round before, so that bilinear lookups and the first mipmaps find light of the same chart.
pub(super) fn fill(lightmap: &mut Lightmap) {
    let padding = lightmap.layout.padding;
    let mut is_lit: Vec<bool> = lightmap.covers.iter().map(|c| *c == Cover::Known).collect();
    let mut front: Vec<usize> = (0..is_lit.len()).filter(|&texel| is_lit[texel]).collect();
    for round in 0.. {
        let mut next: Vec<usize> = front
            .iter()
            .flat_map(|&texel| neighbours(lightmap, texel))
            .filter(|&texel| !is_lit[texel])
            .filter(|&texel| round < padding || lightmap.covers[texel] == Cover::Unknown)
            .collect();
        next.sort_unstable();
        next.dedup();
        let values: Vec<_> = next.iter().map(|&t| around(lightmap, &is_lit, t)).collect();
        for (&texel, (value, owner)) in next.iter().zip(values) {
            lightmap.shown_lx[texel] = value;
            is_lit[texel] = true;
            if lightmap.covers[texel] == Cover::Empty {
                lightmap.covers[texel] = Cover::Filled;
                lightmap.owners[texel] = owner;
            }
        }
        if next.is_empty() {
            return;
        }
        front = next;
    }
}

/// Mean of the neighbours that have a value, and the side of one of them.
fn around(lightmap: &Lightmap, is_lit: &[bool], texel: usize) -> ([f32; 3], u32) {
    let (mut sum, mut count, mut owner) = ([0.0; 3], 0.0, 0);
    for other in neighbours(lightmap, texel).filter(|&other| is_lit[other]) {
        count += 1.0;
        owner = lightmap.owners[other];
        for (sum, value) in sum.iter_mut().zip(lightmap.shown_lx[other]) {
            *sum += f64::from(value);
        }
    }
    (sum.map(|sum| (sum / f64::max(count, 1.0)) as f32), owner)
}

/// The texels around one, on its page.
fn neighbours(lightmap: &Lightmap, texel: usize) -> impl Iterator<Item = usize> + use<> {
    let (width, height) = (lightmap.layout.width as usize, lightmap.layout.height as usize);
    let (x, row) = (texel % width, texel / width);
    let (y, first_row) = (row % height, row - row % height);
    let near = |at: usize, size: usize| at.saturating_sub(1)..(at + 2).min(size);
    near(y, height)
        .flat_map(move |y| near(x, width).map(move |x| (first_row + y) * width + x))
        .filter(move |&other| other != texel)
}
