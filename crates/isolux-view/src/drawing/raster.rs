//! Drawings as pixels.

use super::mark::{At, Ink, Lettering, Line, Mark, Pixels};
use crate::marching::Segment;
use crate::picture::Picture;
use crate::stroke::stroke;

/// Width of the rim of letters with a halo, pixels.
const RIM: i64 = 2;
/// Rows of samples in a pixel of an area.
const ROWS: i64 = 4;

/// Draws a mark over what is there.
pub(super) fn draw(on: &mut Picture, mark: &Mark) {
    match mark {
        Mark::Pixels(pixels) => draw_pixels(on, pixels),
        Mark::Area { rings, ink } => draw_area(on, rings, *ink),
        Mark::Line(line) => stroke(on, &segments(line), 0.5 * line.width, line.ink),
        Mark::Text(lettering) => draw_text(on, lettering),
    }
}

fn draw_pixels(on: &mut Picture, pixels: &Pixels) {
    for (row, inks) in pixels.inks.chunks(pixels.width.max(1)).enumerate() {
        for (column, ink) in inks.iter().enumerate() {
            if let Some(ink) = ink {
                on.blend(pixels.left + column as i64, pixels.top + row as i64, *ink, 1.0);
            }
        }
    }
}

/// Pieces of a line, without its gaps.
fn segments(line: &Line) -> Vec<Segment> {
    let whole = line.points.windows(2).map(|pair| [pair[0], pair[1]]);
    let Some(dash) = line.dash else { return whole.collect() };
    let (mut pieces, mut walked) = (Vec::new(), 0.0);
    for [a, b] in whole {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |along: f64| [0, 1].map(|k| a[k] + along / length * (b[k] - a[k]));
        let mut along = 0.0;
        while along < length {
            let step = walked / dash;
            let end = (along + (step.floor() + 1.0 - step) * dash).max(along + 1e-6).min(length);
            if step.floor() as i64 % 2 == 0 {
                pieces.push([at(along), at(end)]);
            }
            walked += end - along;
            along = end;
        }
    }
    pieces
}

/// Fills where a row of samples has crossed an odd number of sides.
fn draw_area(on: &mut Picture, rings: &[Vec<At>], ink: Ink) {
    let heights = || rings.iter().flatten().map(|at| at[1]);
    let low = heights().fold(f64::INFINITY, f64::min).max(0.0);
    let high = heights().fold(0.0, f64::max).min(f64::from(on.height));
    for y in low as i64..high.ceil() as i64 {
        let mut cover = vec![0.0; on.width as usize];
        for sample in 0..ROWS {
            let across = y as f64 + (sample as f64 + 0.5) / ROWS as f64;
            let mut crossed: Vec<f64> =
                rings.iter().flat_map(|ring| crossings(ring, across)).collect();
            crossed.sort_by(f64::total_cmp);
            for span in crossed.chunks_exact(2) {
                cover_span(&mut cover, span[0], span[1]);
            }
        }
        for (x, covered) in cover.iter().enumerate().filter(|(_, covered)| **covered > 0.0) {
            on.blend(x as i64, y, ink, covered / ROWS as f64);
        }
    }
}

fn crossings(ring: &[At], across: f64) -> impl Iterator<Item = f64> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).filter(move |(a, b)| (a[1] <= across) != (b[1] <= across)).map(
        move |(a, b)| {
            let share = (across - a[1]) / (b[1] - a[1]);
            a[0] + share * (b[0] - a[0])
        },
    )
}

/// Adds what a span covers of every pixel of a row.
fn cover_span(cover: &mut [f64], from: f64, to: f64) {
    let (from, to) = (from.max(0.0), to.min(cover.len() as f64));
    for (x, covered) in cover.iter_mut().enumerate().skip(from as usize) {
        let x = x as f64;
        if x >= to {
            break;
        }
        *covered += (to.min(x + 1.0) - from.max(x)).max(0.0);
    }
}

fn draw_text(on: &mut Picture, lettering: &Lettering) {
    let font = lettering.letters.font();
    let (x, y) =
        (lettering.left().round() as i64, lettering.at[1].round() as i64 - font.height() / 2);
    if let Some(halo) = lettering.halo {
        let [low, high] = lettering.plate();
        let [left, top] = low.map(|c| c.round() as i64);
        on.fill(left, top, (high[0] - low[0]) as i64, (high[1] - low[1]) as i64, halo);
        for (dx, dy) in (-RIM..=RIM).flat_map(|dx| (-RIM..=RIM).map(move |dy| (dx, dy))) {
            font.write(on, (x + dx, y + dy), &lettering.text, halo);
        }
    }
    font.write(on, (x, y), &lettering.text, lettering.ink);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Size;

    #[test]
    fn an_area_covers_pixels_by_their_share() {
        let mut picture = Picture::filled(Size::new(4, 3).unwrap(), [0; 3]);
        let square = vec![[0.5, 1.0], [3.0, 1.0], [3.0, 2.0], [0.5, 2.0]];
        draw_area(&mut picture, &[square], [200; 3]);
        let row: Vec<u8> = (0..4).map(|x| picture.pixel(x, 1).unwrap()[0]).collect();
        assert_eq!(row, [100, 200, 200, 0]);
        assert_eq!((picture.pixel(1, 0), picture.pixel(1, 2)), (Some([0; 3]), Some([0; 3])));
    }

    #[test]
    fn a_ring_in_a_ring_is_a_hole() {
        let mut picture = Picture::filled(Size::new(5, 5).unwrap(), [0; 3]);
        let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
        draw_area(&mut picture, &[square(0.0, 5.0), square(2.0, 3.0)], [9; 3]);
        assert_eq!((picture.pixel(0, 0), picture.pixel(2, 2)), (Some([9; 3]), Some([0; 3])));
    }

    #[test]
    fn dashes_go_on_around_corners() {
        let points = vec![[0.0, 0.0], [3.0, 0.0], [3.0, 5.0]];
        let line = Line { points, width: 1.0, ink: [0; 3], dash: Some(2.0) };
        let length = |[a, b]: &Segment| (b[0] - a[0]).hypot(b[1] - a[1]);
        // On from 0 to 2 and from 4 to 6 of a way of 8.
        let drawn: f64 = segments(&line).iter().map(length).sum();
        assert!((drawn - 4.0).abs() < 1e-9, "{drawn}");
    }
}
