//! Rays that feel about before a place: the same few directions everywhere, so that they are drawn once.

use super::surface::SurfacePoint;
use crate::sampling::{CosineHemisphere, Key, Sequence};
use crate::scene::Scene;
use isolux_geometry::{Direction, Hit, Normal, Point, Ray, Vector};

/// So many directions about an axis, the first `2^k` of them a net.
#[derive(Debug)]
pub(crate) struct ShortRays<const N: usize>([Vector; N]);

impl<const N: usize> ShortRays<N> {
    /// By a key of their own.
    pub(crate) fn of(key: Key) -> Self {
        let sequence = Sequence::new(key);
        let direction = |k: usize| CosineHemisphere::sample(sequence.pair(k as u32, 0));
        Self(std::array::from_fn(direction))
    }

    /// The direction number `k` about an axis.
    pub(crate) fn direction(&self, k: usize, axis: Normal) -> Direction {
        axis.to_direction().from_local(self.0[k])
    }

    /// The ray that way from a place that leaves a triangle.
    pub(crate) fn ray(&self, k: usize, (origin, axis, triangle): (Point, Normal, u32)) -> Ray {
        Ray::new(origin, self.direction(k, axis)).skipping(triangle)
    }

    /// The same of a surface, no longer than `reach_m`.
    pub(crate) fn ray_of(&self, k: usize, at: &SurfacePoint, reach_m: f64) -> Ray {
        self.ray(k, (at.start(), at.shading, at.triangle)).up_to(reach_m as f32)
    }

    /// What all of them meet, transparent or not.
    pub(crate) fn met(&self, scene: &Scene, ray: impl Fn(usize) -> Ray) -> [Option<Hit>; N] {
        let rays: [Ray; N] = std::array::from_fn(ray);
        let mut hits = [None; N];
        scene.bvh().closest_hits(&rays, &mut hits);
        hits
    }
}
