//! Where a ray meets one triangle: watertight, and the only arithmetic that decides a hit.
//!
//! After Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2-1): corners are
//! sheared so that the ray runs along an axis, and three edge functions say on which side of each
//! edge it passes. A sheared corner depends on ray and corner alone, and the edge functions of two
//! triangles over a common edge are exact negatives of each other, so no ray slips between them.
//!
//! A rounded edge function may vanish but never has the wrong sign: rounding keeps the order of its
//! two products. Zero counts as inside, so none of the triangles around a point is lost. What the
//! roundings do spoil are the weights. With u = 2^-24 the unit roundoff, m the largest sheared
//! coordinate and s the sum of the edge functions, the point that the weights stand for lies up to
//! 12 u m^3 / s beside the ray. For a ray within a triangle whose longest edge is L (along any axis)
//! m <= 2 L, so that distance is at most 2^-10 L unless s < [`LEAST_SUM`] L^2; boxes are that much
//! larger than their triangles (see [`REACH`]). Triangles seen so close to edge-on are decided anew
//! in `f64`, where products of `f32` numbers are exact, and so are the signs.
//!
//! That a ray whose edge functions agree lies within the triangle is itself true up to roundings
//! only: to 12 u m^2 / s <= 2^-13 (m / L)^2 longest edges. That bounds m, unless m is thousands of L
//! to begin with and all is rounding. So where a corner is farther from the ray than fits the sum
//! ([`FAR`]), the triangle is decided in `f64`, too.

use crate::{Hit, Ray};

/// Largest coordinate, metres, and largest (inverse: smallest) length of a direction the kernel
/// takes, 2^38: up to here no intermediate result overflows. Rays beyond it meet nothing and
/// triangles beyond it are never met.
pub(super) const LARGEST: f32 = (1_u64 << 38) as f32;

/// How far beside its triangle, in longest edges, a point that is hit may lie.
pub(super) const REACH: f32 = 1.0 / 1024.0;

/// Sums of the edge functions below this many squares of the longest edge are not trusted: twelve
/// unit roundoffs times (2 L)^3 over L [`REACH`].
const LEAST_SUM: f32 = 12.0 * 8.0 * (0.5 * f32::EPSILON) / REACH;

/// Nor are those below this share of the squared distance of the first corner: within a triangle that
/// distance is at most sqrt(8) L.
pub(super) const FAR: f32 = LEAST_SUM / 8.0;

/// Nor are those from which on the weights would lose precision to underflow, m2.
const LEAST_SUM_M2: f32 = 1.0 / (1_u128 << 80) as f32;

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
    /// Inverse of the direction along `z`.
    pub(super) per_depth: f32,
    /// The last `t` of the interval searched, whose end is open.
    pub(super) t_last: f32,
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
        let per_depth = 1.0 / direction[axes[2]];
        Some(Self {
            axes,
            origin: [origin[axes[0]], origin[axes[1]], origin[axes[2]]],
            slope: [direction[axes[0]] * per_depth, direction[axes[1]] * per_depth],
            per_depth,
            t_last: t_max.next_down(),
        })
    }

    /// A corner, given axis by axis, in the sheared space.
    #[inline(always)]
    fn sheared(&self, corner: impl Fn(usize) -> f32) -> [f32; 3] {
        let [x, y, z] = self.axes;
        let depth = corner(z) - self.origin[2];
        [
            corner(x) - self.origin[0] - self.slope[0] * depth,
            corner(y) - self.origin[1] - self.slope[1] * depth,
            depth,
        ]
    }

    /// Where the ray meets a triangle within `0 < t < t_max`. `corner` gives the coordinates by
    /// corner and axis, `least_sum` is that of [`least_sum`].
    pub(super) fn meet(
        &self,
        corner: impl Fn(usize, usize) -> f32,
        least_sum: f32,
    ) -> Option<Meeting> {
        let [a, b, c] = [0, 1, 2].map(|k| self.sheared(|axis| corner(k, axis)));
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        let is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
        let is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
        if !(is_front | is_back) {
            return None;
        }
        let sum = u + (v + w);
        let distance2 = a[0] * a[0] + a[1] * a[1];
        if (sum.abs() >= least_sum) & (sum.abs() >= distance2 * FAR) {
            let t = (u * a[2] + (v * b[2] + w * c[2])) / sum * self.per_depth;
            ((t > 0.0) & (t <= self.t_last)).then_some(self.meeting(t, v, w, sum))
        } else {
            self.meet_exactly(corner)
        }
    }

    /// A meeting at `t`, by the second and third weight and the sum of all.
    #[inline(always)]
    pub(super) fn meeting(&self, t: f32, v: f32, w: f32, sum: f32) -> Meeting {
        let [v, w, sum] = [v, w, sum].map(f64::from);
        Meeting { t, v, w, sum, back: (sum < 0.0) != (self.per_depth < 0.0) }
    }

    /// The same with exact edge functions.
    #[cold]
    #[inline(never)]
    pub(super) fn meet_exactly(&self, corner: impl Fn(usize, usize) -> f32) -> Option<Meeting> {
        let sheared = |k: usize| self.sheared(|axis| corner(k, axis)).map(f64::from);
        let [a, b, c] = [0, 1, 2].map(sheared);
        let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        let is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
        let is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
        let sum = u + v + w;
        let t = (u * a[2] + v * b[2] + w * c[2]) / sum * f64::from(self.per_depth);
        let t = t as f32;
        let back = (sum < 0.0) != (self.per_depth < 0.0);
        // A triangle seen exactly edge-on has no sum of weights, and then `t` is NaN.
        let is_met = (is_front | is_back) & (t > 0.0) & (t <= self.t_last);
        is_met.then_some(Meeting { t, v, w, sum, back })
    }
}

/// Below which sum of the edge functions a triangle is decided by [`Shear::meet_exactly`].
pub(super) fn least_sum(corners: &[[f32; 3]; 3]) -> f32 {
    let edge = longest_edge(corners);
    (LEAST_SUM * edge * edge).max(LEAST_SUM_M2)
}

/// The longest edge along any axis.
pub(super) fn longest_edge([a, b, c]: &[[f32; 3]; 3]) -> f32 {
    let along = |axis: usize| {
        let [a, b, c] = [a[axis], b[axis], c[axis]];
        a.max(b).max(c) - a.min(b).min(c)
    };
    along(0).max(along(1)).max(along(2))
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

/// The edge function.
#[inline(always)]
fn cross(p: [f32; 3], q: [f32; 3]) -> f32 {
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
