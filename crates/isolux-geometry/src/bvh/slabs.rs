//! Where a ray enters and leaves boxes: conservative, so that no hit is lost.
//!
//! The triangle test moves corners by rounding: by at most 6 u D in each coordinate, D the greatest
//! distance along an axis between the origin and a corner, u = 2^-24 the unit roundoff (a rounding
//! of the difference to the origin, two of the slope, one of its product with the depth, and that of
//! the last difference, which is up to 2 D). The ray passes a convex combination of moved corners at
//! a distance for which the boxes allow (`triangle_test::REACH`), at a depth that is rounded ten
//! times more (three products, two sums, the sum of the weights, division, and the step to `t`).
//! So the point `origin + t direction` lies within 16 u D of the triangle's box. The box test
//! `plane / direction - origin / direction` itself errs by less than 6 u (M + |origin|) /
//! |direction|, M the largest coordinate of the scene, and D <= M + |origin|. Boxes widened by
//! 32 u (M + |origin|) contain every hit of their triangles, wherever the ray starts.

use super::triangle_test::{LARGEST, greater};
use crate::Ray;

/// What underflow may do to a depth, metres: the smallest number over the least sum of weights, and
/// far more.
const LEAST_MARGIN_M: f32 = 1.0 / (1_u64 << 60) as f32;

/// What the box test needs to know about a ray. A plane at `p` is met at `p * inverse - offset`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs {
    pub(super) inverse: [f32; 3],
    /// Offsets for the planes through which the ray enters, widened.
    pub(super) enter: [f32; 3],
    /// Offsets for the planes through which it leaves, widened.
    pub(super) leave: [f32; 3],
    /// Of the planes of a node, that of each axis through which the ray enters; the other one
    /// differs in the last bit.
    pub(super) entry_planes: [usize; 3],
}

impl Slabs {
    /// For rays that passed [`Shear::new`](super::triangle_test::Shear::new), in a scene of the
    /// given largest coordinate.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, reach: f32) -> Self {
        let Ray { origin, direction, .. } = *ray;
        let greatest = |v: [f32; 3]| greater(greater(v[0].abs(), v[1].abs()), v[2].abs());
        let margin = 16.0 * f32::EPSILON * (reach + greatest(origin)) + LEAST_MARGIN_M;
        // A component so small that the ray does not leave its place along the axis: no division by
        // zero, and no more than D 2^-38 away from the ray.
        let least = greatest(direction) / LARGEST;
        let inverse = |axis: usize| {
            let d = direction[axis];
            1.0 / if d.abs() < least { least.copysign(d) } else { d }
        };
        let inverse = [inverse(0), inverse(1), inverse(2)];
        let enter = |axis: usize| origin[axis] * inverse[axis] + margin * inverse[axis].abs();
        let leave = |axis: usize| origin[axis] * inverse[axis] - margin * inverse[axis].abs();
        let entry = |axis: usize| 2 * axis + usize::from(inverse[axis].is_sign_negative());
        Self {
            inverse,
            enter: [enter(0), enter(1), enter(2)],
            leave: [leave(0), leave(1), leave(2)],
            entry_planes: [entry(0), entry(1), entry(2)],
        }
    }
}
