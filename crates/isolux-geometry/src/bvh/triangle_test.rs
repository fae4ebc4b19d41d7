//! Where a ray meets one triangle: watertight, and the only arithmetic that decides a hit.
//!
//! After Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2-1): corners are
//! sheared so that the ray runs along an axis, and three edge functions say on which side of each
//! edge it passes. A sheared corner depends on ray and corner alone, and the edge functions of two
//! triangles over a common edge are exact negatives of each other, so no ray slips between them.
//!
//! A rounded edge function may vanish but never has the wrong sign: rounding keeps the order of its
//! two products. What the roundings spoil are the weights and with them the distance. With u = 2^-24
//! the unit roundoff, m the largest sheared coordinate across the ray, M the same or the largest
//! depth, whichever is greater, l the range of the depths, and s the sum of the edge functions:
//!
//! - A weight is off by 4 u m^2 for its own roundings. Where s >= [`TRUSTED`] m^2 that is less than
//!   2^-12 of the sum.
//! - It is off by 4 m u (2 m + 5 M) for the roundings of the sheared corners. Three weights times the
//!   range of the depths, and the roundings of these and of their mean (8 u M), make an error of the
//!   depth of less than u M (96 m l / s + 8). A meeting must lie 256 times as far away ([`NEAR`]).
//!
//! Triangles of a smaller sum, seen close to edge-on, those met closer to the origin, and those of
//! which an edge function vanishes are decided anew in `f64`: products of `f32` numbers are exact
//! there, and so are the signs of the edge functions; zero counts as inside, so that none of the
//! triangles around a point is lost. The distance is then that to the plane of the triangle's own
//! corners, not of the sheared ones. So a ray that starts beside a plane meets it if it goes there,
//! and only then, however near.
//!
//! Whoever is met is thus pierced in the sheared space, exactly, at some depth t*. With D the greatest
//! distance along an axis from the origin to a corner, sheared corners are moved by u (2 m + 5 D) or
//! less (a rounding of the difference to the origin, three of the slope and its product with the
//! depth, one of that, and that of the last difference), m is at most twice the greatest extent L of
//! the triangle, and depths are rounded by u D: at t* the ray passes the triangle's box within
//! u (6 D + 4 L). Nothing is said to be met before the ray enters the box so widened: decided in `f64`, or
//! close to the end of the ray, it is moved there ([`Shear::enter`]), else its distance is too small by
//! less than a 256th. So a walk loses nothing if it leaves out boxes entered beyond the end, or that much
//! farther behind the closest meeting ([`Shear::reach`]).

use super::local::Local;
use crate::{Hit, Vector};

/// Largest coordinate, metres, and largest (inverse: smallest) length of a direction the kernel
/// takes, 2^38: up to here no intermediate result overflows. Rays beyond it meet nothing and
/// triangles beyond it are never met.
pub(super) const LARGEST: f32 = (1_u64 << 38) as f32;

/// Least sum of the edge functions that is trusted, in squares of the largest coordinate across the
/// ray: four unit roundoffs over 2^-12, and as much again.
pub(super) const TRUSTED: f32 = 8.0 * (0.5 * f32::EPSILON) * 4096.0;

/// And in any case, m2: below, weights and distances lose precision to underflow.
pub(super) const TRUSTED_M2: f32 = 1.0 / (1_u64 << 60) as f32;

/// How far away a meeting is not decided anew, in products of the largest coordinate with the largest
/// one across the ray times the range of depths, and with the sum of the edge functions.
pub(super) const NEAR: [f32; 2] = [96.0 * NEAR_ROUNDINGS, 8.0 * NEAR_ROUNDINGS];

const NEAR_ROUNDINGS: f32 = 256.0 * (0.5 * f32::EPSILON);

/// Twice the error of a distance that is not decided anew.
const SLACK: f32 = 1.0 / 128.0;

/// A component of a direction so small that the ray does not leave its place along the axis by more
/// than 2^-38 of the way, as the greatest is 1 / [`LARGEST`] or more.
pub(super) const LEAST: f32 = 1.0 / (LARGEST * LARGEST);

/// The axes in cyclic order, by the last of them.
const CYCLES: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// What the triangle test needs to know about a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shear {
    /// Axes `x, y, z` of the sheared space: `z` is where the direction is largest.
    pub(super) axes: [usize; 3],
    /// The origin along those axes.
    pub(super) origin: [f32; 3],
    /// The direction along those axes.
    direction: [f32; 3],
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
    pub(super) fn new(ray: &Local) -> Option<Self> {
        let Local { origin, direction, t_max, .. } = *ray;
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
        let along = |v: [f32; 3]| [v[axes[0]], v[axes[1]], v[axes[2]]];
        let (origin, direction) = (along(origin), along(direction));
        let per_depth = 1.0 / direction[2];
        Some(Self {
            axes,
            origin,
            direction,
            slope: [direction[0] * per_depth, direction[1] * per_depth],
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
    /// corner and axis.
    pub(super) fn meet(&self, corner: impl Fn(usize, usize) -> f32 + Copy) -> Option<Meeting> {
        let [a, b, c] = [0, 1, 2].map(|k| self.sheared(|axis| corner(k, axis)));
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        let is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
        let is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
        if !(is_front | is_back) {
            return None;
        }
        let sum = u + (v + w);
        let depths = u * a[2] + (v * b[2] + w * c[2]);
        if is_sure([a, b, c], [u, v, w], sum.abs(), depths) {
            let meeting = self.meeting(corner, [depths, v, w, sum]);
            meeting.is_within(self.t_last).then_some(meeting)
        } else {
            self.meet_exactly(corner)
        }
    }

    /// A meeting by the weighted sum of the depths, the second and third weight, and the sum of all
    /// weights.
    #[inline(always)]
    pub(super) fn meeting(
        &self,
        corner: impl Fn(usize, usize) -> f32,
        [depths, v, w, sum]: [f32; 4],
    ) -> Meeting {
        let mut t = depths / sum * self.per_depth;
        if t > self.t_last * (1.0 - SLACK) {
            t = greater(t, self.enter(corner));
        }
        let [v, w, sum] = [v, w, sum].map(f64::from);
        Meeting { t, v, w, sum, back: (sum < 0.0) != (self.per_depth < 0.0) }
    }

    /// Where the ray enters the box of a triangle, widened by the roundings of the shear, and as much
    /// more as the roundings here.
    #[cold]
    #[inline(never)]
    fn enter(&self, corner: impl Fn(usize, usize) -> f32) -> f32 {
        let (mut ahead, mut along) = ([0.0; 3], [0.0; 3]);
        let (mut farthest, mut extent) = (0.0, 0.0);
        for axis in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| corner(k, self.axes[axis]));
            let (low, high) = (lesser(lesser(a, b), c), greater(greater(a, b), c));
            let [from_low, from_high] = [low, high].map(|x| x - self.origin[axis]);
            farthest = greater(farthest, greater(-from_low, from_high));
            extent = greater(extent, high - low);
            along[axis] = self.direction[axis];
            ahead[axis] = if along[axis] > 0.0 { from_low } else { -from_high };
        }
        let wider = (9.0 * farthest + 4.0 * extent) * (0.5 * f32::EPSILON);
        // Along an axis that it does not move along, the ray is in the box all the way.
        let enter = |axis: usize| {
            let speed = along[axis].abs();
            if speed > LEAST { (ahead[axis] - wider) / speed } else { 0.0 }
        };
        greater(enter(0), greater(enter(1), enter(2)))
    }

    /// How far boxes matter where nothing beyond `t_far` does.
    #[inline(always)]
    pub(super) fn reach(&self, t_far: f32) -> f32 {
        lesser(t_far * (1.0 + SLACK), self.t_last)
    }

    /// Meetings with greater `|depths * per_depth| / |sum|` lie beyond `t_far`: the two roundings of
    /// `t`, and those here, are less than that.
    #[inline(always)]
    pub(super) fn beyond(t_far: f32) -> f32 {
        t_far * (1.0 + 8.0 * f32::EPSILON)
    }

    /// The same with exact edge functions, and the distance to the plane of the triangle.
    #[cold]
    #[inline(never)]
    pub(super) fn meet_exactly(
        &self,
        corner: impl Fn(usize, usize) -> f32 + Copy,
    ) -> Option<Meeting> {
        let [a, b, c] = [0, 1, 2].map(|k| self.sheared(|axis| corner(k, axis)).map(f64::from));
        let cross = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        let (u, v, w) = (cross(c, b), cross(a, c), cross(b, a));
        let is_front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
        let is_back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
        let sum = u + v + w;
        // A triangle seen exactly edge-on has no sum of weights.
        if !(is_front | is_back) || sum == 0.0 {
            return None;
        }
        let along_z = f64::from(self.direction[2]);
        let [nearest, farthest] = [f64::min, f64::max]
            .map(|of: fn(f64, f64) -> f64| of(a[2] / along_z, of(b[2] / along_z, c[2] / along_z)));
        // Seen so close to edge-on that its sheared corners stand for another plane than the true
        // ones, it is met all the same, somewhere on it.
        let t = match self.plane_met(corner) {
            Some(t) => t.clamp(nearest, farthest),
            None => (u * a[2] + v * b[2] + w * c[2]) / sum / along_z,
        };
        let back = (sum < 0.0) != (self.per_depth < 0.0);
        let t = greater(t as f32, self.enter(corner));
        ((t > 0.0) & (t <= self.t_last)).then_some(Meeting { t, v, w, sum, back })
    }

    /// Where the ray meets the plane of a triangle; `None` where it runs along it.
    fn plane_met(&self, corner: impl Fn(usize, usize) -> f32) -> Option<f64> {
        let [x, y, z] = self.axes;
        let [a, b, c] = [0, 1, 2]
            .map(|k| Vector::from([corner(k, x), corner(k, y), corner(k, z)].map(f64::from)));
        let normal = (b - a).cross(c - a);
        let towards = normal.dot(Vector::from(self.direction.map(f64::from)));
        let away = normal.dot(a - Vector::from(self.origin.map(f64::from)));
        (towards != 0.0).then(|| away / towards)
    }
}

/// Whether `f32` decides: from the sheared corners, the edge functions, the size of their sum, and
/// the weighted sum of depths. Not where anything is NaN.
#[inline(always)]
pub(super) fn is_sure(
    [a, b, c]: [[f32; 3]; 3],
    [u, v, w]: [f32; 3],
    size: f32,
    depths: f32,
) -> bool {
    let larger = |axis: usize| greater(a[axis].abs(), greater(b[axis].abs(), c[axis].abs()));
    let across = greater(larger(0), larger(1));
    let all = greater(across, larger(2));
    let range = greater(a[2], greater(b[2], c[2])) - lesser(a[2], lesser(b[2], c[2]));
    let near = all * (across * range * NEAR[0] + size * NEAR[1]);
    let is_front = (u > 0.0) & (v > 0.0) & (w > 0.0);
    let is_back = (u < 0.0) & (v < 0.0) & (w < 0.0);
    let is_trusted = size >= across * across * TRUSTED + TRUSTED_M2;
    is_trusted & (depths.abs() > near) & (is_front | is_back)
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
    /// Whether it lies between the origin and `t_far`.
    #[inline(always)]
    pub(super) fn is_within(&self, t_far: f32) -> bool {
        (self.t > 0.0) & (self.t <= t_far)
    }

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

/// The lesser of two numbers, with as little care.
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The edge function.
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
