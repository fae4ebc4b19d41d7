//! Lines of equal value, by marching squares (Lorensen and Cline 1987, in two dimensions) over the
//! middles of the pixels; never from one surface to another.

use super::legend::number;
use super::scale::Axis;
use crate::image::{LuminanceImage, Surface};
use crate::picture::Picture;
use crate::text::Font;
use rayon::prelude::*;

/// Half the width of a line, in heights of a label: 1.2 pixels wide beside letters of 16.
const HALF_WIDTH: f64 = 0.6 / 16.0;
/// Labels of one level are at least so many letters' width apart.
const LABEL_DISTANCE_LETTERS: i64 = 30;
/// A piece of line shorter than its label times this has none.
const SHORTEST_LABELLED: i64 = 4;
const DARK: [u8; 3] = [0; 3];
const LIGHT: [u8; 3] = [255; 3];

/// A piece of a line within one square of four pixel middles, pixels.
type Segment = [[f64; 2]; 2];

/// Draws lines and labels of all levels over a picture of the values.
pub(super) fn draw(
    picture: &mut Picture,
    image: &LuminanceImage,
    values: &[Option<f64>],
    axis: &Axis,
    levels: &[f64],
) {
    let font = Font::for_labels(picture.height);
    let mut labels = Labels { font, placed: Vec::new() };
    for (&level, segments) in levels.iter().zip(segments(image, values, levels)) {
        // Dark lines in the lighter half of the colours.
        let (ink, halo) = if axis.position(level) > 0.5 { (DARK, LIGHT) } else { (LIGHT, DARK) };
        stroke(picture, &segments, HALF_WIDTH * font.height() as f64, ink);
        labels.place(picture, &segments, &number(level), ink, halo);
    }
    labels.draw(picture);
}

/// The lines of every level.
fn segments(image: &LuminanceImage, values: &[Option<f64>], levels: &[f64]) -> Vec<Vec<Segment>> {
    let (width, height) = (image.size().width() as usize, image.size().height() as usize);
    let row = |y: usize| {
        let mut found = Vec::new();
        for x in 0..width - 1 {
            let corner = y * width + x;
            // Clockwise from the top left.
            let square = [corner, corner + 1, corner + width + 1, corner + width];
            let Some(v) = whole_square(image, values, square) else { continue };
            let place = |p: [f64; 2]| [x as f64 + 0.5 + p[0], y as f64 + 0.5 + p[1]];
            for (k, &level) in levels.iter().enumerate() {
                found.extend(crossings(v, level).map(|segment| (k, segment.map(place))));
            }
        }
        found
    };
    let rows: Vec<Vec<(usize, Segment)>> = (0..height - 1).into_par_iter().map(row).collect();
    let mut lines = vec![Vec::new(); levels.len()];
    for (k, segment) in rows.into_iter().flatten() {
        lines[k].push(segment);
    }
    lines
}

/// The values at the corners of a square that lies on one surface.
fn whole_square(
    image: &LuminanceImage,
    values: &[Option<f64>],
    square: [usize; 4],
) -> Option<[f64; 4]> {
    let [a, b, c, d] = square.map(|pixel| values[pixel]);
    let all = [a?, b?, c?, d?];
    let surfaces = square.map(|pixel| image.surface(pixel));
    let joined = |k: usize| {
        let next = surfaces[(k + 1) % 4];
        surfaces[k].zip(next).is_some_and(|(one, other)| Surface::continues(one, other))
    };
    (0..4).all(joined).then_some(all)
}

/// Where a level crosses the unit square with the given corner values, clockwise from the top left.
fn crossings(values: [f64; 4], level: f64) -> impl Iterator<Item = Segment> {
    const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = values.map(|v| v >= level);
    let on_edge = move |k: usize| {
        let next = (k + 1) % 4;
        let share = (level - values[k]) / (values[next] - values[k]);
        let mix = |axis: usize| CORNERS[k][axis] + share * (CORNERS[next][axis] - CORNERS[k][axis]);
        [mix(0), mix(1)]
    };
    let crossed: Vec<usize> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).collect();
    // At a saddle the mean decides which opposite corners are joined.
    let joined = 0.25 * values.iter().sum::<f64>() >= level;
    let pairs = match crossed.as_slice() {
        [] => vec![],
        [a, b] => vec![[*a, *b]],
        _ if above[0] == joined => vec![[0, 1], [2, 3]],
        _ => vec![[3, 0], [1, 2]],
    };
    pairs.into_iter().map(move |pair| pair.map(on_edge))
}

/// Draws segments as one line: a pixel gets the darkest of their shades, not their sum.
fn stroke(picture: &mut Picture, segments: &[Segment], half_width: f64, ink: [u8; 3]) {
    let mut opacity = vec![0.0_f32; picture.rgb.len()];
    for [a, b] in segments {
        let reach = half_width + 1.0;
        let range = |axis: usize, end: u32| {
            let low = (a[axis].min(b[axis]) - reach).max(0.0) as u32;
            low..((a[axis].max(b[axis]) + reach) as u32 + 1).min(end)
        };
        for y in range(1, picture.height) {
            for x in range(0, picture.width) {
                let middle = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                let cover = (half_width + 0.5 - distance(middle, *a, *b)).clamp(0.0, 1.0) as f32;
                let pixel = &mut opacity[(y * picture.width + x) as usize];
                *pixel = pixel.max(cover);
            }
        }
    }
    let width = i64::from(picture.width);
    for (index, &cover) in opacity.iter().enumerate().filter(|(_, cover)| **cover > 0.0) {
        let (x, y) = (index as i64 % width, index as i64 / width);
        picture.blend(x, y, ink, f64::from(cover));
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

/// Labels that do not disturb each other.
struct Labels {
    font: Font,
    placed: Vec<Label>,
}

struct Label {
    left: i64,
    top: i64,
    width: i64,
    text: String,
    ink: [u8; 3],
    halo: [u8; 3],
}

impl Labels {
    fn distance(&self) -> i64 {
        LABEL_DISTANCE_LETTERS * self.font.width("0")
    }

    /// Whether two labels hide each other, or say the same nearby.
    fn disturb(&self, a: &Label, b: &Label) -> bool {
        let (dx, dy) = ((a.left - b.left).abs(), (a.top - b.top).abs());
        let overlap =
            a.left < b.left + b.width && b.left < a.left + a.width && dy < self.font.height();
        overlap || (a.text == b.text && dx.max(dy) < self.distance())
    }

    fn fits(&self, label: &Label, picture: &Picture) -> bool {
        label.left >= 0
            && label.top >= 0
            && label.left + label.width <= i64::from(picture.width)
            && label.top + self.font.height() <= i64::from(picture.height)
            && !self.placed.iter().any(|known| self.disturb(known, label))
    }

    /// Finds a place on every line of a level that is long enough.
    fn place(
        &mut self,
        picture: &Picture,
        segments: &[Segment],
        text: &str,
        ink: [u8; 3],
        halo: [u8; 3],
    ) {
        let (tile, width) = (self.distance(), self.font.width(text));
        let tile_of = |[a, _]: &Segment| (a[1] as i64 / tile, a[0] as i64 / tile);
        let mut in_tiles: Vec<&Segment> = segments.iter().collect();
        in_tiles.sort_by_key(|segment| tile_of(segment));
        for run in in_tiles.chunk_by(|a, b| tile_of(a) == tile_of(b)) {
            if (run.len() as i64) < SHORTEST_LABELLED * width {
                continue;
            }
            let places = run[run.len() / 2..].iter().chain(run[..run.len() / 2].iter().rev());
            let mut labels = places.map(|[a, _]| Label {
                left: a[0] as i64 - width / 2,
                top: a[1] as i64 - self.font.height() / 2,
                width,
                text: text.to_owned(),
                ink,
                halo,
            });
            if let Some(label) = labels.find(|label| self.fits(label, picture)) {
                self.placed.push(label);
            }
        }
    }

    fn draw(&self, picture: &mut Picture) {
        const AROUND: [(i64, i64); 8] =
            [(-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, 1), (-1, 1), (1, -1)];
        for label in &self.placed {
            for (dx, dy) in AROUND {
                let place = (label.left + dx, label.top + dy);
                self.font.write(picture, place, &label.text, label.halo);
            }
            self.font.write(picture, (label.left, label.top), &label.text, label.ink);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_between_two_rows_crosses_in_proportion() {
        let found: Vec<Segment> = crossings([0.0, 0.0, 10.0, 10.0], 2.5).collect();
        assert_eq!(found, [[[1.0, 0.25], [0.0, 0.25]]]);
    }

    #[test]
    fn a_level_outside_crosses_nothing() {
        assert_eq!(crossings([1.0, 2.0, 3.0, 4.0], 5.0).count(), 0);
        assert_eq!(crossings([1.0; 4], 1.0).count(), 0);
    }

    #[test]
    fn a_saddle_is_crossed_twice() {
        let found: Vec<Segment> = crossings([3.0, 0.0, 3.0, 0.0], 1.0).collect();
        // The mean 1.5 joins the high corners, so each line cuts off a low one.
        assert_eq!(found.len(), 2);
        for [a, b] in found {
            let cut = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            assert!((cut[0] > 0.5) != (cut[1] > 0.5), "{cut:?}");
        }
    }
}
