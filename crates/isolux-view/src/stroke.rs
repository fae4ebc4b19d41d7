//! Lines of a width on a picture.

use crate::marching::Segment;
use crate::picture::Picture;

/// Draws segments as one line: a pixel gets the darkest of their shades, not their sum.
pub(crate) fn stroke(picture: &mut Picture, segments: &[Segment], half_width: f64, ink: [u8; 3]) {
    let reach = half_width + 1.0;
    let ends = [picture.width, picture.height];
    let range = |axis: usize, of: &[Segment]| {
        let (low, high) = of.iter().flatten().fold((f64::INFINITY, 0.0_f64), |(low, high), at| {
            (low.min(at[axis]), high.max(at[axis]))
        });
        ((low - reach).max(0.0) as u32)..((high + reach).max(0.0) as u32 + 1).min(ends[axis])
    };
    let (columns, rows) = (range(0, segments), range(1, segments));
    let (width, height) = (columns.len(), rows.len());
    let mut opacity = vec![0.0_f32; width * height];
    for segment @ [a, b] in segments {
        for y in range(1, std::slice::from_ref(segment)) {
            for x in range(0, std::slice::from_ref(segment)) {
                let middle = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let cover = (half_width + 0.5 - distance(middle, *a, *b)).clamp(0.0, 1.0) as f32;
                let (column, row) = ((x - columns.start) as usize, (y - rows.start) as usize);
                let pixel = &mut opacity[row * width + column];
                *pixel = pixel.max(cover);
            }
        }
    }
    // A line thinner than a pixel is paler, not wider.
    let strength = (2.0 * half_width).min(1.0);
    for (index, &cover) in opacity.iter().enumerate().filter(|(_, cover)| **cover > 0.0) {
        let x = i64::from(columns.start) + (index % width) as i64;
        let y = i64::from(rows.start) + (index / width) as i64;
        picture.blend(x, y, ink, strength * f64::from(cover));
    }
}

/// Distance of a point to a segment.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, off) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = along[0] * along[0] + along[1] * along[1];
    let share = if length2 > 0.0 {
        ((off[0] * along[0] + off[1] * along[1]) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (dx, dy) = (off[0] - share * along[0], off[1] - share * along[1]);
    (dx * dx + dy * dy).sqrt()
}
