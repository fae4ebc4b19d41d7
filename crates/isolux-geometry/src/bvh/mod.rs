//! The bounding volume hierarchy over a triangle mesh.

use crate::{Hit, Ray, TriangleMesh};

/// Answers ray queries over a triangle mesh.
#[derive(Clone, Debug)]
pub struct Bvh {
    mesh: TriangleMesh,
}

impl Bvh {
    /// Builds the hierarchy. `is_transparent` says for every triangle whether [`Bvh::any_hit`]
    /// looks through it.
    pub fn build(mesh: TriangleMesh, _is_transparent: impl Fn(u32) -> bool) -> Self {
        Self { mesh }
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// The first triangle that the ray meets, transparent or not.
    pub fn closest_hit(&self, _ray: &Ray) -> Option<Hit> {
        None
    }

    /// Whether the ray meets any triangle that is not transparent.
    pub fn any_hit(&self, _ray: &Ray) -> bool {
        false
    }
}
