//! Lines of equal value, drawn over a plan.

use super::field::Field;
use super::frame::Frame;
use super::levels::Levels;
use super::room::Room;
use super::words::PlanWords;
use crate::drawing::{At, Drawing, Ink, Letters, Line, Mark, Pixels};
use crate::marching::{Segment, crossings};
use rayon::prelude::*;
use std::collections::HashMap;

/// Side of the squares that lines cross, pixels.
const SQUARE: f64 = 3.0;
/// Labels of one line are so far apart along it, pixels.
const LABEL_DISTANCE: f64 = 520.0;
/// A line shorter than its label times this has none.
const SHORTEST_LABELLED: f64 = 2.5;
const WIDTH: f64 = 1.3;
const INK: Ink = [40, 40, 40];

/// Colours of the values, pixel by pixel of the frame.
pub(super) fn bands(field: &Field<'_>, frame: &Frame, levels: &Levels) -> Mark {
    let inks = levels.inks();
    let [width, height] = frame.size().map(|side| side.round() as usize);
    let (left, top) = (frame.corner[0].round() as i64, frame.corner[1].round() as i64);
    let row = |y: usize| -> Vec<Option<Ink>> {
        let middle = |x: usize| [left as f64 + x as f64 + 0.5, top as f64 + y as f64 + 0.5];
        let value = |x| field.at(frame.place(middle(x)));
        (0..width).map(|x| value(x).map(|value| inks[levels.band(value)])).collect()
    };
    let inks = (0..height).into_par_iter().flat_map_iter(row).collect();
    Mark::Pixels(Pixels { left, top, width, inks })
}

/// Lines of equal value, level by level.
pub(super) struct Isolines(Vec<Vec<Vec<At>>>);

impl Isolines {
    pub(super) fn of(field: &Field<'_>, frame: &Frame, levels: &Levels) -> Self {
        Self(segments(field, frame, &levels.lux).iter().map(|pieces| joined(pieces)).collect())
    }

    /// Draws the lines, below all that is written and all that stands in the room.
    pub(super) fn draw(&self, on: &mut Drawing) {
        for line in self.0.iter().flatten() {
            on.line(Line::solid(line.clone(), WIDTH, INK));
        }
    }

    /// Writes their values on them, where there is room.
    pub(super) fn label(
        &self,
        on: &mut Drawing,
        room: &mut Room,
        (levels, words): (&Levels, &PlanWords),
    ) {
        let inks = levels.inks();
        for (k, lines) in self.0.iter().enumerate() {
            let text = words.local(&number(levels.lux[k]));
            for line in lines {
                label(on, room, line, (&text, inks[k + 1]));
            }
        }
    }
}

/// A level as it is written: as many digits as it has.
pub(super) fn number(level: f64) -> String {
    let text = format!("{level:.6}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// The pieces of every level, from square to square.
fn segments(field: &Field<'_>, frame: &Frame, levels: &[f64]) -> Vec<Vec<Segment>> {
    let [columns, rows] = frame.size().map(|side| (side / SQUARE).ceil() as usize);
    let size = frame.size();
    // The last square may be narrower: lines end at the frame.
    let node = |x: usize, y: usize| {
        [0, 1].map(|k| frame.corner[k] + (([x, y][k] as f64) * SQUARE).min(size[k]))
    };
    let values: Vec<Option<f64>> = (0..=rows)
        .into_par_iter()
        .flat_map_iter(|y| (0..=columns).map(move |x| field.at(frame.place(node(x, y)))))
        .collect();
    let mut found = vec![Vec::new(); levels.len()];
    for y in 0..rows {
        for x in 0..columns {
            let at = |dx: usize, dy: usize| values[(y + dy) * (columns + 1) + x + dx];
            let [Some(a), Some(b), Some(c), Some(d)] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)]
            else {
                continue;
            };
            let (low, high) = (node(x, y), node(x + 1, y + 1));
            let place = |p: [f64; 2]| [0, 1].map(|k| low[k] + p[k] * (high[k] - low[k]));
            for (lines, &level) in found.iter_mut().zip(levels) {
                lines.extend(crossings([a, b, c, d], level).map(|segment| segment.map(place)));
            }
        }
    }
    found
}

/// Pieces that meet, as lines.
fn joined(pieces: &[Segment]) -> Vec<Vec<At>> {
    // Neighbouring squares compute the same place, but for rounding.
    let key = |at: At| at.map(|coordinate| (coordinate * 4096.0).round() as i64);
    let mut ends: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    for (index, piece) in pieces.iter().enumerate() {
        piece.iter().for_each(|at| ends.entry(key(*at)).or_default().push(index));
    }
    let mut is_used = vec![false; pieces.len()];
    let follow = |line: &mut Vec<At>, is_used: &mut Vec<bool>| {
        while let Some(&end) = line.last() {
            let those = ends.get(&key(end)).map_or(&[][..], Vec::as_slice);
            let Some(&next) = those.iter().find(|&&index| !is_used[index]) else { break };
            is_used[next] = true;
            let [a, b] = pieces[next];
            line.push(if key(a) == key(end) { b } else { a });
        }
    };
    let mut lines = Vec::new();
    for first in 0..pieces.len() {
        if is_used[first] {
            continue;
        }
        is_used[first] = true;
        let mut line = vec![pieces[first][0], pieces[first][1]];
        follow(&mut line, &mut is_used);
        line.reverse();
        follow(&mut line, &mut is_used);
        lines.push(line);
    }
    lines
}

/// Labels along a line, where there is room.
fn label(on: &mut Drawing, room: &mut Room, line: &[At], (text, halo): (&str, Ink)) {
    let step = |pair: &[At]| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
    let length: f64 = line.windows(2).map(step).sum();
    let width = crate::drawing::extent(Letters::Small, text)[0];
    if length < SHORTEST_LABELLED * width {
        return;
    }
    let count = (length / LABEL_DISTANCE).ceil();
    let (mut walked, mut placed) = (0.0, 0.0);
    for pair in line.windows(2) {
        walked += step(pair);
        // From the middle of every stretch on.
        let is_due = walked >= (placed + 0.35) * length / count;
        if is_due && placed < count && room.write(on, pair[1], text, (INK, Some(halo))) {
            placed = (walked / length * count).floor().max(placed) + 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_joined_whatever_their_order_and_sense() {
        let pieces = [[[1.0, 0.0], [2.0, 0.0]], [[1.0, 0.0], [0.0, 0.0]], [[3.0, 0.0], [2.0, 0.0]]];
        let lines = joined(&pieces);
        assert_eq!(lines, [[[3.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 0.0]]]);
    }

    #[test]
    fn levels_are_written_short() {
        assert_eq!([500.0, 0.5, 2500.0].map(number), ["500", "0.5", "2500"]);
    }
}
