//! One sample of an emitting surface of several triangles, for the ends of gathering rays.
//!
//! One triangle is drawn by the projected solid angle at its centroid, which is about right unless
//! the triangle is near. Only that triangle is then sampled exactly.

use super::super::polygon::{Place, drawn, pieces, steradians, target};
use super::triangle_tree::height_above;
use crate::engine::ray::{Dice, SurfacePoint};
use isolux_geometry::{Point, Vector};

/// Numbers of triangles for this method: fewer are all sampled exactly, more form clusters.
const TRIANGLE_COUNTS: std::ops::RangeInclusive<usize> = 5..=128;

/// Radius of a triangle over its distance, up to which its weight comes from its centroid alone.
const FAR_RADIUS_RATIO: f64 = 0.5;

/// The triangles of an emitter.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facets(Vec<Facet>);

/// A triangle that emits from its counter-clockwise side.
#[derive(Clone, Copy, Debug)]
struct Facet {
    start: Point,
    middle: Point,
    radius_m: f64,
    /// Twice the area along the normal, m2.
    twice_m2: Vector,
}

impl Facets {
    /// The facets of an emitter; empty where this method does not apply.
    pub(crate) fn of(triangles: &[[Point; 3]]) -> Self {
        let facet = |corners: &[Point; 3]| {
            let &[a, b, c] = corners;
            let middle = a + ((b - a) + (c - a)) / 3.0;
            let reach_m = corners.iter().map(|&p| (p - middle).length()).fold(0.0, f64::max);
            // Allowance for the rounding of a length and of the steps after it.
            let radius_m = reach_m * (1.0 + 1e-12);
            Facet { start: a, middle, radius_m, twice_m2: (b - a).cross(c - a) }
        };
        let are_some = TRIANGLE_COUNTS.contains(&triangles.len());
        Self(triangles.iter().filter(|_| are_some).map(facet).collect())
    }

    /// Whether this method applies to the emitter.
    pub(crate) fn are_some(&self) -> bool {
        !self.0.is_empty()
    }

    /// A place on one of the triangles and the projected solid angle that it stands for, sr; `None`
    /// where nothing is seen.
    pub(crate) fn look(
        &self,
        at: &SurfacePoint,
        triangles: &[[Point; 3]],
        dice: &mut Dice,
    ) -> Option<(Place, f64)> {
        let mut weights = [0.0; *TRIANGLE_COUNTS.end()];
        let mut whole = 0.0;
        for ((weight, facet), corners) in weights.iter_mut().zip(&self.0).zip(triangles) {
            *weight = facet.weight(at, corners);
            whole += *weight;
        }
        if whole <= 0.0 {
            return None;
        }
        let [pick, accept] = dice.pair();
        let weights = &weights[..self.0.len()];
        let mut left = pick * whole;
        let drawn_one = weights.iter().position(|&weight| {
            left -= weight;
            left < 0.0
        });
        // Rounding may leave a remainder past the last triangle.
        let triangle = drawn_one.or_else(|| weights.iter().rposition(|&weight| weight > 0.0))?;
        let (weight, corners) = (weights[triangle], triangles[triangle]);
        let pieces = pieces(at, std::iter::once((triangle, corners)));
        let steradians: f64 = pieces.iter().map(|piece| piece.steradians).sum();
        let within = ((left + weight) / weight).clamp(0.0, 1.0);
        let piece = drawn(&pieces, within * steradians)?;
        let point = target(piece, corners, at, accept, dice);
        Place::seen(at, triangle, point, 1.0).map(|place| (place, steradians * whole / weight))
    }
}

impl Facet {
    /// Approximate projected solid angle, sr; zero only where nothing is seen.
    fn weight(&self, at: &SurfacePoint, corners: &[Point; 3]) -> f64 {
        let depth = self.twice_m2.dot(at.point - self.start);
        let to = self.middle - at.point;
        let height_m = to.dot(at.shading.to_vector());
        if depth <= 0.0 || height_m + self.radius_m <= 0.0 {
            return 0.0;
        }
        let distance2 = to.length_squared();
        if self.radius_m * self.radius_m > FAR_RADIUS_RATIO * FAR_RADIUS_RATIO * distance2 {
            return steradians(at, *corners);
        }
        let height_m = height_above(height_m, self.radius_m).max(f64::MIN_POSITIVE);
        0.5 * depth * height_m / (distance2 * distance2)
    }
}
