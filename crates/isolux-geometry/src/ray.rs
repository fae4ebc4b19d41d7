//! Rays, what they hit, and where they may start.

use crate::{Direction, Normal, Point, Vector};

/// A query of the ray kernel: what lies at `origin + t direction` for `0 < t < t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start, metres.
    pub origin: [f32; 3],
    /// Need not have length one; `t` counts in its length.
    pub direction: [f32; 3],
    /// Open end of the interval searched.
    pub t_max: f32,
    /// A triangle that this ray never meets: the one it starts on.
    pub skip: Option<u32>,
}

impl Ray {
    /// A ray without end.
    pub fn new(origin: Point, direction: Direction) -> Self {
        Self {
            origin: origin.to_f32(),
            direction: direction.to_f32(),
            t_max: f32::INFINITY,
            skip: None,
        }
    }

    /// The open segment between two points: `t` runs from 0 at `from` to 1 at `to`, and both ends
    /// are left out by the rounding bound of the coordinates.
    pub fn between(from: Point, to: Point) -> Self {
        let d: Vector = to - from;
        Self {
            origin: from.to_f32(),
            direction: [d.x as f32, d.y as f32, d.z as f32],
            t_max: 1.0 - 8.0 * f32::EPSILON,
            skip: None,
        }
    }

    /// The same ray, blind to triangle `index`.
    pub fn skipping(self, index: u32) -> Self {
        Self { skip: Some(index), ..self }
    }
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Barycentric weight of the second corner.
    pub u: f32,
    /// Barycentric weight of the third corner.
    pub v: f32,
    /// Index of the triangle.
    pub triangle: u32,
    /// Whether the ray arrives at the back (corners turn clockwise as seen from its origin).
    pub back: bool,
}

/// The point from which to trace a ray that leaves a surface at `point` on the side of `normal`:
/// moved along the normal by a bound of the rounding errors of `f32` coordinates of that size, and
/// no further (after Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8.6).
pub fn offset_origin(point: Point, normal: Normal) -> Point {
    let v = point.to_vector();
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    // Eight roundings of half an ulp each lie between the stored vertices and the traced origin.
    let bound = 8.0 * f64::from(f32::EPSILON) * largest + f64::from(f32::MIN_POSITIVE);
    point + normal * bound
}
