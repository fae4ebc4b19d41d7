//! Where a ray meets one triangle: watertight, and the only arithmetic that decides a hit.
//!
//! After Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2-1): corners are
//! sheared so that the ray runs along an axis, and three edge functions say on which side of each
//! edge it passes. A sheared corner depends on ray and corner alone, and the edge functions of two
//! triangles over a common edge are exact negatives of each other, so no ray slips between them.
//!
//! The paper falls back to `f64` where an edge function vanishes. Here every triangle is decided in
//! `f64`, where products of `f32` numbers are exact: so are the signs of the edge functions, and
//! the weights have full relative precision even for slivers seen edge-on. That makes the point hit
//! a convex combination of the corners up to the rounding of the shear, which is what lets the box
//! test be conservative (see `slabs`). The hierarchy sifts with the same edge functions in `f32`
//! first (`Lanes::candidates`). Rounding keeps the order of the two products, so that their
//! difference may vanish but never has the wrong sign, and no triangle is lost there.

use crate::{Hit, Ray};

/// Largest coordinate, metres, and largest (inverse: smallest) length of a direction the kernel
/// takes, 2^40: up to here no intermediate result overflows or loses precision to underflow. Rays
/// beyond it meet nothing and triangles beyond it are never met.
pub(super) const LARGEST: f32 = (1_u64 << 40) as f32;

/// The axes in cyclic order, by the last of them.
const CYCLES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// What the triangle test needs to know about a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shear {
    /// Axes `x, y, z` of the sheared space: `z` is where the direction is largest.
    pub(super) axes: [usize; 3],
    /// The origin along those axes.
    pub(super) origin: [f32; 3],
    /// Direction in `x` and `y` for each unit of `z`.
    pub(super) slope: [f32; 2],
    /// Inverse of `depth`.
    pub(super) per_depth: f32,
    /// Component of the direction along `z`.
    depth: f64,
    /// Open end of the interval searched.
    pub(super) t_max: f32,
}

impl Shear {
    /// `None` for rays that can meet nothing: not finite, without direction, without length.
    #[inline(always)]
    pub(super) fn new(ray: &Ray) -> Option<Self> {
        let Ray { origin, direction, t_max, .. } = *ray;
        let [x, y, z] = [direction[0].abs(), direction[1].abs(), direction[2].abs()];
        let largest = greater(greater(x, y), z);
        // Written so that a NaN anywhere fails.
        let sum = x + y + z;
        let is_direction = largest >= 1.0 / LARGEST && sum <= LARGEST;
        let farthest = origin[0].abs() + origin[1].abs() + origin[2].abs();
        if !(is_direction && farthest <= LARGEST && t_max > 0.0) {
            return None;
        }
        let axes = CYCLES[if z == largest { 2 } else { usize::from(y == largest) }];
        let depth = direction[axes[2]];
        let per_depth = 1.0 / depth;
        Some(Self {
            axes,
            origin: [origin[axes[0]], origin[axes[1]], origin[axes[2]]],
            slope: [direction[axes[0]] * per_depth, direction[axes[1]] * per_depth],
            per_depth,
            depth: f64::from(depth),
            t_max,
        })
    }

    /// No triangle whose corners, as `depth * per_depth`, all lie farther away is met up to `t_far`:
    /// three roundings of theirs, and one of `t`, are less than that.
    #[inline(always)]
    pub(super) fn beyond(t_far: f32) -> f32 {
        t_far * (1.0 + 4.0 * f32::EPSILON)
    }

    /// A corner, given axis by axis, in the sheared space.
    #[inline(always)]
    fn sheared(&self, corner: impl Fn(usize) -> f32) -> [f64; 3] {
        let [x, y, z] = self.axes;
        let depth = corner(z) - self.origin[2];
        [
            f64::from(corner(x) - self.origin[0] - self.slope[0] * depth),
            f64::from(corner(y) - self.origin[1] - self.slope[1] * depth),
            f64::from(depth),
        ]
    }

    /// Where the ray meets a triangle within `0 < t < t_max`. `corner` gives the coordinates by
    /// corner and axis.
    #[inline(always)]
    pub(super) fn meet(&self, corner: impl Fn(usize, usize) -> f32) -> Option<Meeting> {
        let a = self.sheared(|axis| corner(0, axis));
        let b = self.sheared(|axis| corner(1, axis));
        let c = self.sheared(|axis| corner(2, axis));
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        let is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
        let is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
        if !(is_front | is_back) {
            return None;
        }
        let sum = u + v + w;
        let t = ((u * a[2] + v * b[2] + w * c[2]) / (sum * self.depth)) as f32;
        // A triangle seen exactly edge-on has no sum of weights, and then `t` is NaN.
        let back = sum * self.depth < 0.0;
        ((t > 0.0) & (t < self.t_max)).then_some(Meeting { t, v, w, sum, back })
    }
}

/// Where a ray meets a triangle, the weights not yet divided by their sum.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) t: f32,
    /// The weights of the second and third corner, and of all three.
    v: f64,
    w: f64,
    sum: f64,
    back: bool,
}

impl Meeting {
    /// With the index of the triangle met.
    #[inline(always)]
    pub(super) fn of(self, triangle: u32) -> Hit {
        let Self { t, v, w, sum, back } = self;
        Hit { t, u: (v / sum) as f32, v: (w / sum) as f32, triangle, back }
    }
}

/// The greater of two numbers, without the care that `f32::max` takes of NaN.
#[inline(always)]
pub(super) fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The edge function: exact for coordinates that come from `f32`, but for one rounding that keeps
/// the sign.
#[inline(always)]
fn cross(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

/// Whether the first meeting, with triangle `a.0`, comes before the second: nearer, or as near and
/// on a front where the other is on a back, or else of lower index. A strict total order, so that
/// the closest hit does not depend on the order in which triangles are tried.
#[inline(always)]
pub(super) fn comes_before(a: (u32, &Meeting), b: (u32, &Meeting)) -> bool {
    if a.1.t != b.1.t {
        return a.1.t < b.1.t;
    }
    (a.1.back, a.0) < (b.1.back, b.0)
}

/// The corners of a triangle the kernel can meet; `None` where an index is out of range or a
/// coordinate is not finite or beyond [`LARGEST`].
pub(super) fn corners(mesh: &crate::TriangleMesh, triangle: u32) -> Option<[[f32; 3]; 3]> {
    let [a, b, c] = *mesh.triangles.get(triangle as usize)?;
    let corner = |index: u32| {
        let position = *mesh.positions.get(index as usize)?;
        position.iter().all(|x| x.abs() <= LARGEST).then_some(position)
    };
    Some([corner(a)?, corner(b)?, corner(c)?])
}
