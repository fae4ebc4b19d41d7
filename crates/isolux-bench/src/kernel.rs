//! What is asked of every kernel that is measured.

use isolux_geometry::{Bvh, Ray};
use std::hint::black_box;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
#[expect(dead_code, reason = "weights are asked for as a solver does, and compared by their t")]
pub(crate) struct Meeting {
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
    pub(crate) triangle: u32,
}

/// Two questions about a ray.
pub(crate) trait Kernel: Sync {
    /// Where the ray meets the first triangle.
    fn closest(&self, ray: &Ray) -> Option<Meeting>;
    /// Whether the ray meets any triangle.
    fn any(&self, ray: &Ray) -> bool;

    /// Asks where each ray meets the first triangle, and forgets.
    fn ask_closest(&self, rays: &[Ray]) {
        for ray in rays {
            black_box(self.closest(ray));
        }
    }

    /// Asks whether each ray meets any triangle, and forgets.
    fn ask_any(&self, rays: &[Ray]) {
        for ray in rays {
            black_box(self.any(ray));
        }
    }
}

/// The same kernel asked about many rays at a time.
pub(crate) struct Together<'a>(pub(crate) &'a Bvh);

/// Rays asked about at a time.
const TOGETHER: usize = 1024;

impl Kernel for Together<'_> {
    fn closest(&self, ray: &Ray) -> Option<Meeting> {
        self.0.closest(ray)
    }

    fn any(&self, ray: &Ray) -> bool {
        self.0.any(ray)
    }

    fn ask_closest(&self, rays: &[Ray]) {
        let mut hits = [None; TOGETHER];
        for rays in rays.chunks(TOGETHER) {
            self.0.closest_hits(rays, &mut hits[..rays.len()]);
            black_box(&hits);
        }
    }

    fn ask_any(&self, rays: &[Ray]) {
        let mut are_hit = [false; TOGETHER];
        for rays in rays.chunks(TOGETHER) {
            self.0.any_hits(rays, &mut are_hit[..rays.len()]);
            black_box(&are_hit);
        }
    }
}

impl Kernel for Bvh {
    #[inline]
    fn closest(&self, ray: &Ray) -> Option<Meeting> {
        let hit = self.closest_hit(ray)?;
        Some(Meeting { t: hit.t, u: hit.u, v: hit.v, triangle: hit.triangle })
    }

    #[inline]
    fn any(&self, ray: &Ray) -> bool {
        self.any_hit(ray)
    }
}
