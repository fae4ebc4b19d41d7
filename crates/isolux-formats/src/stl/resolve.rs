//! Solids into parts of a scene.

use super::record::Solid;
use crate::bare::{Part, UNNAMED};
use crate::findings::Findings;

pub(super) fn parts(solids: Vec<Solid>, findings: &mut Findings) -> Vec<Part> {
    let reversed: usize = solids.iter().map(|solid| solid.reversed).sum();
    let total: usize = solids.iter().map(|solid| solid.triangles.len()).sum();
    if reversed > 0 {
        let what = format!(
            "the normals of {reversed} of {total} facets point to the side from which their corners \
             turn clockwise"
        );
        let remedy =
            "the order of corners counts; it matters only for materials whose sides differ";
        findings.warning("", what, remedy);
    }
    let part = |solid: Solid| Part {
        material: if solid.name.is_empty() { UNNAMED.to_owned() } else { solid.name.clone() },
        name: solid.name,
        positions: solid.vertices.into_positions(),
        triangles: solid.triangles,
        ..Part::default()
    };
    solids.into_iter().map(part).collect()
}
