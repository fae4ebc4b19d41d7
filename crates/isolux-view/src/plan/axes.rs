//! Metres along the sides of a plan.

use super::frame::{Frame, Plane};
use super::words::PlanWords;
use crate::drawing::{Anchor, At, Drawing, Ink, Lettering, Letters, Line};
use crate::round::round_step;

/// Numbers are at least so far apart, pixels.
const APART: f64 = 70.0;
const LONG: f64 = 8.0;
const SHORT: f64 = 4.0;
const INK: Ink = [60; 3];

/// Draws a frame around the plan with ticks below it and to its left, in the coordinates of the scene.
pub(super) fn draw(on: &mut Drawing, plane: &Plane, frame: &Frame, words: &PlanWords) {
    let ([left, top], [width, height]) = (frame.corner, frame.size());
    let (right, bottom) = (left + width, top + height);
    let ring = vec![[left, top], [right, top], [right, bottom], [left, bottom]];
    on.line(Line::around(ring, 1.0, INK));
    for side in 0..2 {
        let (name, start, sense) = plane.axis_along(side).unwrap_or((['u', 'v'][side], 0.0, 1.0));
        let step = round_step(APART / frame.scale);
        let (low, high) = (frame.window.low[side], frame.window.high[side]);
        // Five small ticks to a large one, but for steps of 2: four.
        let parts = if (step / 2.0).log10().fract().abs() < 1e-6 { 4.0 } else { 5.0 };
        let bounds = [start + sense * low, start + sense * high];
        let small = step / parts;
        let (first, last) = (bounds[0].min(bounds[1]) / small, bounds[0].max(bounds[1]) / small);
        for k in (first - 1e-6).ceil() as i64..=(last + 1e-6).floor() as i64 {
            let coordinate = k as f64 * small;
            let along = sense * (coordinate - start);
            let at = match side {
                0 => [frame.at([along, 0.0])[0], bottom],
                _ => [left, frame.at([0.0, along])[1]],
            };
            let is_long = k % parts as i64 == 0;
            tick(on, side, at, if is_long { LONG } else { SHORT });
            if is_long {
                number(on, (side, at), coordinate, words);
            }
        }
        name_axis(on, side, [[right, bottom], [left, top]][side], &format!("{name}, m"));
    }
}

fn tick(on: &mut Drawing, side: usize, at: At, length: f64) {
    let mut end = at;
    end[1 - side] += if side == 0 { length } else { -length };
    on.line(Line::solid(vec![at, end], 1.0, INK));
}

fn number(on: &mut Drawing, (side, at): (usize, At), coordinate: f64, words: &PlanWords) {
    let text = format!("{:.3}", coordinate + 0.0);
    let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
    let (at, anchor) = match side {
        0 => ([at[0], at[1] + LONG + 10.0], Anchor::Middle),
        _ => ([at[0] - LONG - 4.0, at[1]], Anchor::Right),
    };
    let text = if text == "-0" { "0".to_owned() } else { words.local(&text) };
    on.text(Lettering { at, anchor, letters: Letters::Small, ink: INK, halo: None, text });
}

/// Beyond the end of the axis: below the numbers on the right, above those on the left.
fn name_axis(on: &mut Drawing, side: usize, end: At, text: &str) {
    let (at, anchor) = match side {
        0 => ([end[0], end[1] + LONG + 29.0], Anchor::Right),
        _ => ([end[0] - LONG - 4.0, end[1] - 16.0], Anchor::Middle),
    };
    on.text(Lettering {
        at,
        anchor,
        letters: Letters::Small,
        ink: INK,
        halo: None,
        text: text.to_owned(),
    });
}
