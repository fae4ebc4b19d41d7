//! A place on one side of a surface.

use crate::scene::Scene;
use isolux_geometry::{Direction, Hit, Normal, Point, Ray, offset_origin};

/// A place on one side of a triangle; both normals point to that side.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfacePoint {
    pub(super) triangle: u32,
    pub(super) back: bool,
    /// Barycentric weights of the second and third corner.
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) point: Point,
    pub(super) geometric: Normal,
    pub(super) shading: Normal,
}

impl SurfacePoint {
    /// Where a ray arrives.
    pub(super) fn from_hit(scene: &Scene, hit: &Hit) -> Self {
        Self::new(scene, hit.triangle, hit.back, f64::from(hit.u), f64::from(hit.v))
    }

    /// A place by its barycentric weights.
    pub(super) fn new(scene: &Scene, triangle: u32, back: bool, u: f64, v: f64) -> Self {
        let corners = scene.triangle(triangle);
        let geometric = scene.geometric_normal(triangle);
        let shading = scene.shading_normal(triangle, u, v);
        Self {
            triangle,
            back,
            u,
            v,
            point: corners.point(u, v),
            geometric: if back { -geometric } else { geometric },
            shading: if back { -shading } else { shading },
        }
    }

    /// The ray that leaves this side.
    pub(super) fn leave(&self, direction: Direction) -> Ray {
        Ray::new(offset_origin(self.point, self.geometric), direction).skipping(self.triangle)
    }

    /// The ray that goes through to the other side.
    pub(super) fn cross(&self, direction: Direction) -> Ray {
        Ray::new(offset_origin(self.point, -self.geometric), direction).skipping(self.triangle)
    }

    /// The same place seen from the other side.
    pub(super) fn other_side(&self) -> Self {
        Self { back: !self.back, geometric: -self.geometric, shading: -self.shading, ..*self }
    }
}
