//! The transparent surfaces of a scene in their own hierarchy. They are usually few, so it is fast.

use crate::scene::Scene;
use isolux_geometry::{Bvh, Hit, Ray, TriangleMesh};

/// Transparent triangles, with a bounding volume hierarchy of their own.
pub(crate) struct Panes {
    tree: Option<Bvh>,
    /// The triangle of the scene for each triangle here, in ascending order.
    triangles: Vec<u32>,
}

impl Panes {
    /// Gathers the transparent triangles of a scene.
    pub(crate) fn find(scene: &Scene) -> Self {
        let is_clear = |t: &u32| scene.material(*t).finish(false).is_none();
        let triangles: Vec<u32> = (0..scene.triangle_count()).filter(is_clear).collect();
        let all = scene.bvh().mesh();
        let mut mesh = TriangleMesh { origin: all.origin, ..TriangleMesh::default() };
        for &triangle in &triangles {
            let first = mesh.positions.len() as u32;
            let corners = all.triangles[triangle as usize];
            mesh.positions.extend(corners.map(|corner| all.positions[corner as usize]));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        let tree = (!triangles.is_empty()).then(|| Bvh::build(mesh, |_| true));
        Self { tree, triangles }
    }

    /// Whether there are any transparent triangles.
    pub(crate) fn exist(&self) -> bool {
        self.tree.is_some()
    }

    /// The first transparent triangle on a ray; opaque triangles are ignored.
    pub(crate) fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let own = |triangle: u32| self.triangles.binary_search(&triangle).ok().map(|k| k as u32);
        let hit = self.tree.as_ref()?.closest_hit(&Ray { skip: ray.skip.and_then(own), ..*ray })?;
        Some(Hit { triangle: self.triangles[hit.triangle as usize], ..hit })
    }
}
