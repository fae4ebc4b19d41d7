//! Symbols of a plan.

use crate::drawing::{At, Drawing, Ink, Line, Mark, PAPER};

pub(super) const LAMP: Ink = [176, 36, 24];
pub(super) const CUT: Ink = [0; 3];
/// Solid things that are cut.
pub(super) const SOLID: Ink = [150; 3];
const BEHIND: Ink = [110; 3];
const POINT: Ink = [70; 3];
const BORDER: Ink = [90; 3];
/// Radius of a luminaire that is a point, pixels.
pub(super) const RADIUS: f64 = 6.0;

/// And of the smallest one.
pub(super) const LEAST_RADIUS: f64 = 1.6;
/// A circle with less has no room for a cross.
pub(super) const CROSSED: f64 = 4.0;

/// Lines of walls that are cut.
pub(super) fn cut(on: &mut Drawing, piece: [At; 2]) {
    on.line(Line::solid(piece.to_vec(), 3.0, CUT));
}

/// Edges of what lies below.
pub(super) fn behind(on: &mut Drawing, piece: [At; 2]) {
    on.line(Line::solid(piece.to_vec(), 1.0, BEHIND));
}

/// The rectangle of a grid that does not end at walls.
pub(super) fn border(on: &mut Drawing, mut ring: Vec<At>) {
    ring.extend(ring.first().copied());
    on.line(Line { points: ring, width: 1.0, ink: BORDER, dash: Some(5.0) });
}

/// A luminaire that is a point: a circle with a cross, a dot where it is small.
pub(super) fn round(on: &mut Drawing, at: At, radius: f64) {
    let ring: Vec<At> = (0..24)
        .map(|k| libm::sincos(f64::from(k) * std::f64::consts::TAU / 24.0))
        .map(|(sine, cosine)| [at[0] + radius * cosine, at[1] + radius * sine])
        .collect();
    if radius < CROSSED {
        on.add(Mark::Area { rings: vec![ring], ink: LAMP });
        return;
    }
    on.add(Mark::Area { rings: vec![ring.clone()], ink: PAPER });
    let reach = radius * std::f64::consts::FRAC_1_SQRT_2;
    for sense in [1.0, -1.0] {
        let ends =
            vec![[at[0] - reach, at[1] - sense * reach], [at[0] + reach, at[1] + sense * reach]];
        on.line(Line::solid(ends, 1.2, LAMP));
    }
    on.line(Line::around(ring, 1.5, LAMP));
}

pub(super) fn round_sample(on: &mut Drawing, at: At) {
    round(on, at, RADIUS);
}

pub(super) fn dot_sample(on: &mut Drawing, at: At) {
    round(on, at, LEAST_RADIUS);
}

/// A luminous opening: its ring, with diagonals if it has four corners.
pub(super) fn opening(on: &mut Drawing, ring: &[At]) {
    on.line(Line::around(ring.to_vec(), 3.5, PAPER));
    if let [a, b, c, d] = ring {
        on.line(Line::solid(vec![*a, *c], 0.8, LAMP));
        on.line(Line::solid(vec![*b, *d], 0.8, LAMP));
    }
    on.line(Line::around(ring.to_vec(), 1.5, LAMP));
}

/// A point of the grid: a small cross.
pub(super) fn point(on: &mut Drawing, [x, y]: At) {
    on.line(Line::solid(vec![[x - 3.0, y], [x + 3.0, y]], 1.0, POINT));
    on.line(Line::solid(vec![[x, y - 3.0], [x, y + 3.0]], 1.0, POINT));
}

pub(super) fn cut_sample(on: &mut Drawing, [x, y]: At) {
    cut(on, [[x - 14.0, y], [x + 14.0, y]]);
}

pub(super) fn behind_sample(on: &mut Drawing, [x, y]: At) {
    behind(on, [[x - 14.0, y], [x + 14.0, y]]);
}

pub(super) fn border_sample(on: &mut Drawing, [x, y]: At) {
    border(
        on,
        vec![[x - 13.0, y - 7.0], [x + 13.0, y - 7.0], [x + 13.0, y + 7.0], [x - 13.0, y + 7.0]],
    );
}

pub(super) fn opening_sample(on: &mut Drawing, [x, y]: At) {
    opening(
        on,
        &[[x - 10.0, y - 6.0], [x + 10.0, y - 6.0], [x + 10.0, y + 6.0], [x - 10.0, y + 6.0]],
    );
}
