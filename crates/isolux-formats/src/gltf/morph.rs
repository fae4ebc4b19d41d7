//! Morph targets: shapes added to that of a mesh, each with its weight (glTF 2.0, section 3.7.2.2).

use super::accessor;
use super::buffers::Document;
use super::notes::Flaw;
use gltf_json::mesh::MorphTarget;

/// Adds `weight` times each target to positions or normals; `accessor` picks which of a target's.
pub(super) fn add(
    document: &Document,
    targets: &[MorphTarget],
    weights: &[f64],
    accessor: impl Fn(&MorphTarget) -> Option<usize>,
    vectors: &mut [[f64; 3]],
) -> Result<(), Flaw> {
    for (index, (target, &weight)) in targets.iter().zip(weights).enumerate() {
        if weight == 0.0 {
            continue;
        }
        let Some(accessor) = accessor(target).filter(|&a| holds_data(document, a)) else {
            continue;
        };
        let deltas = accessor::vectors::<3>(document, accessor)
            .map_err(|flaw| flaw.at(format!("targets[{index}]")))?;
        if deltas.len() != vectors.len() {
            let what = format!("{} displacements for {} vertices", deltas.len(), vectors.len());
            let flaw = Flaw::new(what, "export the file again");
            return Err(flaw.at(format!("targets[{index}]")));
        }
        for (vector, delta) in vectors.iter_mut().zip(deltas) {
            *vector = std::array::from_fn(|k| vector[k] + weight * delta[k]);
        }
    }
    Ok(())
}

/// An accessor without data stands for zeros.
fn holds_data(document: &Document, accessor: usize) -> bool {
    let record = document.root.accessors.get(accessor);
    record.is_none_or(|record| record.buffer_view.is_some() || record.sparse.is_some())
}
