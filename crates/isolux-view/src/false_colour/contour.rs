//! Lines of equal value, by marching squares over the middles of the pixels; never from one surface to another.

use super::legend::number;
use super::scale::Axis;
use crate::image::{LuminanceImage, Surface};
use crate::marching::{Segment, crossings};
use crate::picture::Picture;
use crate::stroke::stroke;
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
