//! The bounding volume hierarchy over a triangle mesh.

use crate::{Hit, Ray, TriangleMesh};

/// Answers ray queries over a triangle mesh.
#[derive(Clone, Debug)]
pub struct Bvh {
    mesh: TriangleMesh,
}

impl Bvh {
    /// Builds the hierarchy.
    pub fn build(mesh: TriangleMesh) -> Self {
        Self { mesh }
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// The first triangle that the ray meets.
    pub fn closest_hit(&self, _ray: &Ray) -> Option<Hit> {
        None
    }

    /// Whether the ray meets any triangle for which `blocks` says yes.
    pub fn any_hit(&self, _ray: &Ray, _blocks: impl Fn(u32) -> bool) -> bool {
        false
    }
}
