//! Short rays that probe the surroundings of a place. Their directions are the same everywhere, so they are
//! drawn once.

use super::surface::{Stand, SurfacePoint};
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::Scene;
use isolux_geometry::{Direction, Hit, Normal, Ray, Vector};

/// `N` cosine-distributed directions about an axis, of which the first `2^k` are a digital net.
#[derive(Debug)]
pub(crate) struct ShortRays<const N: usize>([Vector; N]);

impl<const N: usize> ShortRays<N> {
    /// Directions drawn with a key.
    pub(crate) fn of(key: Key) -> Self {
        let sequence = Sequence::new(key);
        let direction = |k: usize| CosineHemisphere::sample(sequence.pair(k as u32, 0));
        Self(std::array::from_fn(direction))
    }

    /// Direction number `k` about an axis.
    pub(crate) fn direction(&self, k: usize, axis: Normal) -> Direction {
        axis.to_direction().from_local(self.0[k])
    }

    /// Ray number `k` from a stand.
    pub(crate) fn ray(&self, k: usize, from: Stand) -> Ray {
        Ray::new(from.origin, self.direction(k, from.normal)).skipping(from.triangle)
    }

    /// Ray number `k` from a surface, at most `reach_m` long.
    pub(crate) fn ray_of(&self, k: usize, at: &SurfacePoint, reach_m: f64) -> Ray {
        self.ray(k, at.stand()).up_to(reach_m as f32)
    }

    /// The closest hits of all rays, on transparent surfaces too.
    pub(crate) fn met(&self, scene: &Scene, ray: impl Fn(usize) -> Ray) -> [Option<Hit>; N] {
        let rays: [Ray; N] = std::array::from_fn(ray);
        let mut hits = [None; N];
        scene.bvh().closest_hits(&rays, &mut hits);
        hits
    }
}
