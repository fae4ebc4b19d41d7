//! Where a ray enters and leaves boxes: conservative, so that no hit is lost.
//!
//! The triangle test moves corners by rounding: by at most 5 u D in each coordinate, D the greatest distance
//! along an axis between the origin and a corner, u = 2^-24 the unit roundoff (one rounding each of the
//! difference to the origin, the slope, its product with the depth, and the last difference, which is
//! up to 2 D). The exact line then meets a convex combination of moved corners; `t` is rounded once more
//! (u D). So the point `origin + t direction` lies within 6 u D of the triangle's box. The
//! box test `plane / direction - origin / direction` itself errs by less than 5 u (M + |origin|) /
//! |direction|, M the largest coordinate of the scene, and D <= M + |origin|. Boxes widened by 16 u (M + |origin|) therefore
//! contain every hit of their triangles, wherever the ray starts.

use crate::Ray;

/// What the box test needs to know about a ray. A plane at `p` is met at `p * inverse - offset`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs {
    pub(super) inverse: [f32; 3],
    /// Offsets for the planes through which the ray enters, widened.
    pub(super) enter: [f32; 3],
    /// Offsets for the planes through which it leaves, widened.
    pub(super) leave: [f32; 3],
    /// In [`Node::planes`](super::wide::Node::planes), the plane of each axis through which the ray enters; the other one differs in the
    /// last bit.
    pub(super) entry_planes: [usize; 3],
}

impl Slabs {
    /// For rays that passed [`Shear::new`](super::triangle_test::Shear::new), in a scene of the
    /// given largest coordinate.
    #[inline(always)]
    pub(super) fn new(ray: &Ray, reach: f32) -> Self {
        let Ray { origin, direction, .. } = *ray;
        let greatest = |v: [f32; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let margin = 8.0 * f32::EPSILON * (reach + greatest(origin)) + f32::MIN_POSITIVE;
        // A component so small that the ray does not leave its place along the axis: no division by
        // zero, and no more than D 2^-40 away from the ray.
        let least = greatest(direction) / super::triangle_test::LARGEST;
        let inverse = direction.map(|d| 1.0 / if d.abs() < least { least.copysign(d) } else { d });
        let offset = |axis: usize| origin[axis] * inverse[axis];
        let widening = |axis: usize| margin * inverse[axis].abs();
        Self {
            inverse,
            enter: std::array::from_fn(|axis| offset(axis) + widening(axis)),
            leave: std::array::from_fn(|axis| offset(axis) - widening(axis)),
            entry_planes: std::array::from_fn(|axis| {
                2 * axis + usize::from(inverse[axis].is_sign_negative())
            }),
        }
    }
}
