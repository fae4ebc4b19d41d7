//! Texels beside charts, and those of which nothing is known, from their neighbours.

use super::texels::{Cover, Lightmap};

/// No chart, or that of a texel that none reaches.
const NONE: u32 = u32::MAX;

/// Fills empty texels within the padding of charts, and unknown ones no further from known ones than that, round by round
/// with the mean of their neighbours of the round before, so that bilinear lookups and the first mipmaps find light of
/// the same chart. What is farther from all that is known stays black: nobody knows that light reaches it.
pub(super) fn fill(lightmap: &mut Lightmap) {
    let mut charts = charts(lightmap);
    claim(lightmap, &mut charts);
    let mut is_lit: Vec<bool> = lightmap.covers.iter().map(|c| *c == Cover::Known).collect();
    let mut front: Vec<usize> = (0..is_lit.len()).filter(|&texel| is_lit[texel]).collect();
    for _ in 0..lightmap.layout.padding {
        front = beside(lightmap, &front, |from, to| !is_lit[to] && charts[from] == charts[to]);
        let near: Vec<_> =
            front.iter().map(|&texel| around(lightmap, (&is_lit, &charts), texel)).collect();
        for (&texel, (value, owner)) in front.iter().zip(near) {
            lightmap.shown_lx[texel] = value;
            is_lit[texel] = true;
            if lightmap.covers[texel] == Cover::Empty {
                lightmap.covers[texel] = Cover::Filled;
                lightmap.owners[texel] = owner;
            }
        }
    }
}

/// The chart of every covered texel, or the part of a chart that hangs together, by the number of its first texel.
fn charts(lightmap: &Lightmap) -> Vec<u32> {
    let mut charts = vec![NONE; lightmap.covers.len()];
    let mut waiting = Vec::new();
    for first in 0..charts.len() {
        if lightmap.covers[first] == Cover::Empty || charts[first] != NONE {
            continue;
        }
        charts[first] = first as u32;
        waiting.push(first);
        while let Some(at) = waiting.pop() {
            for next in neighbours(lightmap, at) {
                if lightmap.covers[next] != Cover::Empty && charts[next] == NONE {
                    charts[next] = first as u32;
                    waiting.push(next);
                }
            }
        }
    }
    charts
}

/// Gives every empty texel within the padding of charts to the nearest of them; of two as near, to the first.
fn claim(lightmap: &Lightmap, charts: &mut [u32]) {
    let mut front: Vec<usize> = (0..charts.len()).filter(|&texel| charts[texel] != NONE).collect();
    for _ in 0..lightmap.layout.padding {
        front = beside(lightmap, &front, |_, to| charts[to] == NONE);
        let first = |&texel: &usize| neighbours(lightmap, texel).map(|other| charts[other]).min();
        let nearest: Vec<Option<u32>> = front.iter().map(first).collect();
        for (&texel, nearest) in front.iter().zip(nearest) {
            charts[texel] = nearest.unwrap_or(NONE);
        }
    }
}

/// The neighbours of some texels that are wanted from there, each once, in order.
fn beside(
    lightmap: &Lightmap,
    front: &[usize],
    is_wanted: impl Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let of = |&from: &usize| {
        let is_wanted = &is_wanted;
        neighbours(lightmap, from).filter(move |&to| is_wanted(from, to))
    };
    let mut next: Vec<usize> = front.iter().flat_map(of).collect();
    next.sort_unstable();
    next.dedup();
    next
}

/// Mean of the neighbours of the same chart that have a value, and the side of one of them.
fn around(
    lightmap: &Lightmap,
    (is_lit, charts): (&[bool], &[u32]),
    texel: usize,
) -> ([f32; 3], u32) {
    let (mut sum, mut count, mut owner) = ([0.0; 3], 0.0, 0);
    let is_near = |&other: &usize| is_lit[other] && charts[other] == charts[texel];
    for other in neighbours(lightmap, texel).filter(is_near) {
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
