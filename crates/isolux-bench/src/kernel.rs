//! What is asked of every kernel that is measured.

use isolux_geometry::{Bvh, Ray};

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
