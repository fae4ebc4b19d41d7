//! Bright pixels that belong together, as `evalglare` finds them.

use super::field::{Field, Piece};
use isolux::geometry::{Direction, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// What is closer is one source, rad: `evalglare` says 0.2 and counts angles twice.
const TOGETHER_RAD: f64 = 0.1;
/// What is brighter, as the sun is, is no part of what is about it, cd/m2.
const PEAK_CD_M2: f64 = 50_000.0;

/// A source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// The sum of directions by light.
    sum: Vector,
    pub(super) steradians: f64,
    /// Luminance by solid angle.
    light: f64,
}

impl Patch {
    fn of(piece: &Piece) -> Self {
        Self {
            sum: piece.towards * (piece.luminance_cd_m2 * piece.steradians),
            steradians: piece.steradians,
            light: piece.luminance_cd_m2 * piece.steradians,
        }
    }

    fn take(&mut self, other: &Self) {
        self.sum += other.sum;
        self.steradians += other.steradians;
        self.light += other.light;
    }

    /// Its middle.
    pub(super) fn towards(&self) -> Option<Direction> {
        self.sum.direction()
    }

    /// Mean luminance.
    pub(super) fn luminance_cd_m2(&self) -> f64 {
        self.light / self.steradians
    }

    fn angle_to(&self, other: &Self) -> f64 {
        libm::atan2(self.sum.cross(other.sum).length(), self.sum.dot(other.sum))
    }
}

/// The sources of a view: all that is brighter than a luminance, peaks apart.
pub(super) fn patches(field: &Field, threshold_cd_m2: f64) -> Vec<Patch> {
    let is_peak = |piece: &Piece| piece.luminance_cd_m2 > PEAK_CD_M2;
    let is_bright = |piece: &Piece| piece.luminance_cd_m2 > threshold_cd_m2;
    let mut found = grouped(field, |piece| is_bright(piece) && is_peak(piece));
    found.extend(grouped(field, |piece| is_bright(piece) && !is_peak(piece)));
    found
}

/// Pixels that a chain of near ones connects are one patch.
fn grouped(field: &Field, counts: impl Fn(&Piece) -> bool) -> Vec<Patch> {
    let mut pixels: Vec<Option<Patch>> = vec![None; field.across * field.across];
    for piece in field.pieces.iter().filter(|piece| counts(piece)) {
        match &mut pixels[piece.pixel] {
            Some(patch) => patch.take(&Patch::of(piece)),
            empty => *empty = Some(Patch::of(piece)),
        }
    }
    let mut found = Vec::new();
    for first in 0..pixels.len() {
        let Some(patch) = pixels[first].take() else { continue };
        let (mut whole, mut open) = (patch, vec![(first, patch)]);
        while let Some((at, from)) = open.pop() {
            for next in around(at, field.across) {
                let is_near = |patch: &mut Patch| patch.angle_to(&from) < TOGETHER_RAD;
                if let Some(patch) = pixels[next].take_if(is_near) {
                    whole.take(&patch);
                    open.push((next, patch));
                }
            }
        }
        found.push(whole);
    }
    found
}

/// Pixels of a square picture in which near places may lie: round the rim of the hemisphere the picture is stretched by pi / 2.
fn around(pixel: usize, across: usize) -> impl Iterator<Item = usize> {
    let reach = (TOGETHER_RAD / PI * FRAC_PI_2 * across as f64).ceil() as usize + 1;
    let span = move |at: usize| at.saturating_sub(reach)..(at + reach + 1).min(across);
    let (x, y) = (pixel % across, pixel / across);
    span(y).flat_map(move |row| span(x).map(move |column| row * across + column))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of pixels a degree apart from straight ahead to the right, in a picture of 180.
    fn piece(degrees: usize, luminance_cd_m2: f64) -> Piece {
        let (sin, cos) = libm::sincos((degrees as f64).to_radians());
        let pixel = 90 * 180 + 90 + degrees;
        Piece { pixel, towards: Vector::new(sin, cos, 0.0), steradians: 1e-4, luminance_cd_m2 }
    }

    fn check(pieces: &[(usize, f64)], expected: &[(f64, f64)]) {
        let pieces = pieces.iter().map(|&(at, luminance)| piece(at, luminance)).collect();
        let mut found: Vec<(f64, f64)> = patches(&Field { across: 180, pieces }, 2000.0)
            .iter()
            .map(|patch| (patch.luminance_cd_m2(), patch.steradians * 1e4))
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for ((luminance, size), (l, s)) in found.iter().zip(expected) {
            assert!((luminance / l - 1.0).abs() < 1e-9 && (size - s).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn near_pixels_are_one_source_and_far_ones_are_others() {
        check(&[(0, 3000.0), (1, 5000.0), (40, 6000.0)], &[(4000.0, 2.0), (6000.0, 1.0)]);
        check(&[(0, 1999.0), (3, 100.0)], &[]);
        // A tenth of a radian is 5.7 degrees: a chain holds together, a gap of 6 does not.
        check(&[(0, 3000.0), (10, 3000.0), (5, 3000.0)], &[(3000.0, 3.0)]);
        check(&[(0, 3000.0), (6, 4000.0)], &[(3000.0, 1.0), (4000.0, 1.0)]);
    }

    #[test]
    fn the_sun_is_apart_from_its_sky() {
        check(&[(0, 1e8), (1, 1e4), (2, 1e4)], &[(1e4, 2.0), (1e8, 1.0)]);
        // Looks of one pixel.
        check(&[(0, 1e8), (0, 1e4), (0, 100.0)], &[(1e4, 1.0), (1e8, 1.0)]);
    }
}
