//! The transparent surfaces of a scene by themselves: few, as a rule, and soon asked.

use crate::scene::Scene;
use isolux_geometry::{Bvh, Hit, Ray, TriangleMesh};

/// Transparent triangles, in a tree of their own.
pub(crate) struct Panes {
    tree: Option<Bvh>,
    /// The triangle of the scene that each is, ascending.
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

    /// Whether there are any.
    pub(crate) fn exist(&self) -> bool {
        self.tree.is_some()
    }

    /// The first transparent triangle that a ray meets, opaque ones left out.
    pub(crate) fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let own = |triangle: u32| self.triangles.binary_search(&triangle).ok().map(|k| k as u32);
        let hit = self.tree.as_ref()?.closest_hit(&Ray { skip: ray.skip.and_then(own), ..*ray })?;
        Some(Hit { triangle: self.triangles[hit.triangle as usize], ..hit })
    }
}
