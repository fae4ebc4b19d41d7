//! Where a ray enters and leaves boxes: conservative, so that no hit is lost.
//!
//! A triangle is met no sooner than where the ray enters its box widened by u (9 D + 4 L), computed
//! with an error of 3 u D (`triangle_test`; u = 2^-24 the unit roundoff, D the greatest distance along
//! an axis from the origin to the triangle, L its extent). Boxes in the tree are [`widened`] by 4 u L. The
//! box test `plane / direction - origin / direction` itself errs by less than 3 u (D + |origin|) /
//! |direction|. So planes moved by u (15 D + 3 |origin|), with the scene's D, hold every hit.

use super::bounds::Bounds;
use super::local::Local;
use super::triangle_test::{LEAST, greater};
use super::wide::Node;

/// By how much planes are moved for rays from `origin`, metres.
#[inline(always)]
pub(super) fn margin(scene: &Bounds, origin: [f32; 3]) -> f32 {
    let far =
        |axis: usize| greater(scene.high[axis] - origin[axis], origin[axis] - scene.low[axis]);
    let distance = greater(far(0), greater(far(1), greater(far(2), 0.0)));
    let size = greater(origin[0].abs(), greater(origin[1].abs(), origin[2].abs()));
    // Rounded up for the roundings here.
    (16.0 * distance + 4.0 * size) * (0.5 * f32::EPSILON) + LEAST_MARGIN_M
}

/// The box of a triangle as the tree holds it.
pub(super) fn widened(corners: &[[f32; 3]; 3]) -> Bounds {
    let tight = Bounds::around(corners);
    let extent = (0..3).fold(0.0, |most, axis| greater(most, tight.high[axis] - tight.low[axis]));
    tight.widened(4.0 * (0.5 * f32::EPSILON) * extent)
}

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
    /// Of the planes of a node, that of each axis through which the ray enters.
    entry_planes: [usize; 3],
}

impl Slabs {
    /// For rays that passed [`Shear::new`](super::triangle_test::Shear::new), in a scene of the
    /// given bounds.
    #[inline(always)]
    pub(super) fn new(ray: &Local, scene: &Bounds) -> Self {
        let Local { origin, direction, .. } = *ray;
        let margin = margin(scene, origin);
        // With it there is no division by zero.
        let inverse = |axis: usize| {
            let d = direction[axis];
            1.0 / if d.abs() < LEAST { LEAST.copysign(d) } else { d }
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

    /// The rows of planes through which the ray enters, and those through which it leaves.
    #[inline(always)]
    pub(super) fn rows<'n, const W: usize>(
        &self,
        node: &'n Node<W>,
    ) -> ([&'n [f32; W]; 3], [&'n [f32; W]; 3]) {
        // SAFETY: of the six planes, `new` chose 2 `axis` or 2 `axis` + 1.
        #[allow(unsafe_code, reason = "a check a row would cost as much as the row")]
        let row = |plane: usize| unsafe { node.planes.get_unchecked(plane) };
        let enter = self.entry_planes.map(row);
        (enter, self.entry_planes.map(|plane| row(plane ^ 1)))
    }
}
