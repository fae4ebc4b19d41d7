//! Where a ray meets one triangle: watertight, and the only arithmetic that decides a hit.
//!
//! After Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection" (JCGT 2-1): corners are
//! sheared so that the ray runs along an axis, and three edge functions say on which side of each
//! edge it passes. A sheared corner depends on ray and corner alone, and the edge functions of two
//! triangles over a common edge are exact negatives of each other, so no ray slips between them.
//!
//! The paper falls back to `f64` where an edge function vanishes. Here every triangle that passes a
//! filter in `f32` (see [`Shear::sides`]) is decided in `f64`, where the products of `f32` numbers are exact:
//! the signs of the edge functions are then exact, and the weights have full relative precision
//! even for slivers seen edge-on. That makes the point hit a convex combination of the corners up to
//! the rounding of the shear, which is what lets the box test be conservative (see `slabs`).

use crate::{Hit, Ray};

/// Largest coordinate, metres, and largest (inverse: smallest) length of a direction the kernel
/// takes, 2^40: up to here no intermediate result overflows or loses precision to underflow. Rays beyond
/// it meet nothing and triangles beyond it are never met.
pub(super) const LARGEST: f32 = (1_u64 << 40) as f32;

/// What the triangle test needs to know about a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shear {
    /// Axes `x, y, z` of the sheared space: `z` is where the direction is largest.
    pub(super) axes: [usize; 3],
    /// The origin along those axes.
    pub(super) origin: [f32; 3],
    /// Direction in `x` and `y` for each unit of `z`.
    pub(super) slope: [f32; 2],
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
        let [x, y, z] = direction.map(f32::abs);
        let largest = x.max(y).max(z);
        // Written so that a NaN anywhere fails.
        let sum = x + y + z;
        let usable = largest >= 1.0 / LARGEST && sum <= 3.0 * LARGEST && t_max > 0.0;
        if !(usable && origin.iter().all(|o| o.abs() <= LARGEST)) {
            return None;
        }
        let axes = if z == largest {
            [0, 1, 2]
        } else if y == largest {
            [2, 0, 1]
        } else {
            [1, 2, 0]
        };
        let depth = direction[axes[2]];
        Some(Self {
            axes,
            origin: axes.map(|axis| origin[axis]),
            slope: [direction[axes[0]] / depth, direction[axes[1]] / depth],
            depth: f64::from(depth),
            t_max,
        })
    }

    /// A corner in the sheared space.
    #[inline(always)]
    fn sheared(&self, corner: [f32; 3]) -> [f32; 3] {
        let z = corner[self.axes[2]] - self.origin[2];
        [
            corner[self.axes[0]] - self.origin[0] - self.slope[0] * z,
            corner[self.axes[1]] - self.origin[1] - self.slope[1] * z,
            z,
        ]
    }

    /// Where the ray meets a triangle within `0 < t < t_max`.
    #[inline(always)]
    pub(super) fn meet(&self, corners: [[f32; 3]; 3], triangle: u32) -> Option<Hit> {
        let [a, b, c] = corners.map(|corner| self.sheared(corner).map(f64::from));
        let weights = [cross(c, b), cross(a, c), cross(b, a)];
        let [u, v, w] = weights;
        if weights.iter().any(|&x| x < 0.0) && weights.iter().any(|&x| x > 0.0) {
            return None;
        }
        let sum = u + v + w;
        let t = ((u * a[2] + v * b[2] + w * c[2]) / (sum * self.depth)) as f32;
        // A triangle seen exactly edge-on has no sum of weights, and then `t` is NaN.
        (t > 0.0 && t < self.t_max).then(|| Hit {
            t,
            u: (v / sum) as f32,
            v: (w / sum) as f32,
            triangle,
            back: sum * self.depth < 0.0,
        })
    }
}

/// The edge function: exact for coordinates that come from `f32`, but for one rounding that keeps
/// the sign.
#[inline(always)]
fn cross(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

/// Whether the first hit comes before the second: nearer, or as near and on a front where the other
/// is on a back, or else of lower index. A strict total order, so that the closest hit does not
/// depend on the order in which triangles are tried.
#[inline(always)]
pub(super) fn comes_before(a: &Hit, b: &Hit) -> bool {
    if a.t != b.t {
        return a.t < b.t;
    }
    (a.back, a.triangle) < (b.back, b.triangle)
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
