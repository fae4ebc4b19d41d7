//! Edges where light leaks, and triangles that lie on each other.

use super::finding::Finding;
use isolux::scene::Scene;
use isolux_formats::counted;
use std::collections::HashMap;

/// Vertices of one place: coordinates bit by bit.
type Vertex = [u32; 3];

/// How the edges of the scene are shared.
pub(super) struct Borders {
    /// Edges of one triangle only.
    pub open: u64,
    /// Edges of three and more triangles.
    forked: u64,
    /// Triangles with the same three vertices as another.
    doubled: u64,
    /// The shape with most open edges and how many it has.
    worst: Option<(String, u64)>,
}

impl Borders {
    pub(super) fn of(scene: &Scene) -> Self {
        let mut edges: HashMap<[Vertex; 2], (u32, u32)> = HashMap::new();
        let mut faces: HashMap<[Vertex; 3], u32> = HashMap::new();
        for triangle in 0..scene.triangle_count() {
            let corners = corners(scene, triangle);
            for k in 0..3 {
                let mut edge = [corners[k], corners[(k + 1) % 3]];
                edge.sort_unstable();
                edges.entry(edge).or_insert((0, triangle)).0 += 1;
            }
            let mut face = corners;
            face.sort_unstable();
            *faces.entry(face).or_default() += 1;
        }
        let mut open_of_shape = vec![0; scene.shape_names().len()];
        for &(_, triangle) in edges.values().filter(|(count, _)| *count == 1) {
            open_of_shape[scene.shape_of(triangle) as usize] += 1;
        }
        Self {
            open: open_of_shape.iter().sum(),
            forked: edges.values().filter(|(count, _)| *count > 2).count() as u64,
            doubled: faces.values().map(|count| u64::from(count - 1)).sum(),
            worst: worst(scene, &open_of_shape),
        }
    }

    pub(super) fn findings(&self) -> Vec<Finding> {
        let mut found = Vec::new();
        if let Some((shape, count)) = &self.worst {
            found.push(Finding::note(
                if shape.is_empty() { "scene".to_owned() } else { format!("shape `{shape}`") },
                format!("{count} of the {} open edges of the scene", self.open),
                "fine for single sheets; where walls should meet, light leaks: weld them",
            ));
        }
        if self.forked > 0 {
            found.push(Finding::note(
                "scene",
                counted(
                    self.forked,
                    "edge of three or more triangles",
                    "edges of three or more triangles",
                ),
                "fine where walls meet; inside one object, remove inner faces",
            ));
        }
        if self.doubled > 0 {
            found.push(Finding::warning(
                "scene",
                counted(
                    self.doubled,
                    "triangle lies on another one",
                    "triangles lie on another one",
                ),
                "remove the copies: which of the two is lit is left to rounding",
            ));
        }
        found
    }
}

fn corners(scene: &Scene, triangle: u32) -> [Vertex; 3] {
    let mesh = scene.bvh().mesh();
    // Adding zero turns -0 into 0.
    mesh.triangles[triangle as usize]
        .map(|vertex| mesh.positions[vertex as usize].map(|c| (c + 0.0).to_bits()))
}

fn worst(scene: &Scene, open_of_shape: &[u64]) -> Option<(String, u64)> {
    let (shape, &count) = open_of_shape.iter().enumerate().max_by_key(|(_, count)| **count)?;
    (count > 0).then(|| (scene.shape_names()[shape].clone(), count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::scene::{Finish, Material, SceneParts, Shape};

    fn borders(triangles: &[[[f64; 3]; 3]]) -> Borders {
        let shape = Shape {
            positions: triangles.iter().flatten().copied().collect(),
            triangles: (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
            ..Shape::default()
        };
        let materials = vec![Material::two_sided("m", Finish::BLACK)];
        let parts = SceneParts { shapes: vec![shape], materials, ..SceneParts::default() };
        Borders::of(&Scene::assemble(parts).unwrap())
    }

    #[test]
    fn edges_are_counted_by_place() {
        const O: [f64; 3] = [0.0, -0.0, 0.0];
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        const Y: [f64; 3] = [0.0, 1.0, 0.0];
        const Z: [f64; 3] = [0.0, 0.0, 1.0];
        let tetrahedron = [[O, Y, X], [[0.0; 3], X, Z], [O, Z, Y], [X, Y, Z]];
        for (triangles, open, forked, doubled) in [
            (&tetrahedron[..], 0, 0, 0),
            (&tetrahedron[..1], 3, 0, 0),
            (&tetrahedron[..2], 4, 0, 0),
            (&[[O, X, Y], [Y, O, X]], 0, 0, 1),
            (&[[O, X, Y], [O, X, Z], [O, X, [1.0; 3]]], 6, 1, 0),
        ] {
            let found = borders(triangles);
            assert_eq!((found.open, found.forked, found.doubled), (open, forked, doubled));
        }
    }
}
