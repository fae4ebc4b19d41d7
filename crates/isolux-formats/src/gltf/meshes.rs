//! Meshes to shapes in world coordinates, one for every node that names the mesh.

use super::buffers::Document;
use super::limits;
use super::nodes::{self, Placed};
use super::notes::{Flaw, Notes, no_such};
use super::primitive::{Size, Source};
use super::surfaces::Surfaces;
use isolux::scene::Shape;
use std::collections::HashMap;

/// All shapes of the scene, ordered by the first use of their mesh.
pub(super) fn shapes(
    document: &Document,
    placed: &[Placed],
    surfaces: &mut Surfaces,
    notes: &mut Notes,
) -> Vec<Shape> {
    let mut budget = Budget { vertices: limits::VERTICES, triangles: limits::TRIANGLES };
    let mut shapes = Vec::new();
    for (mesh, instances) in uses(document, placed, notes) {
        for (index, record) in document.root.meshes[mesh].primitives.iter().enumerate() {
            let source = Source::new(document, record, mesh, index);
            let made = instantiate(source, &instances, &mut budget, surfaces, notes);
            if let Some(made) = notes.accept(made.map_err(|flaw| flaw.rooted(source.place()))) {
                shapes.extend(made.into_iter().zip(&instances).map(|(shape, instance)| {
                    let name = shape_name(document, instance.node, mesh, index);
                    Shape { name, ..shape }
                }));
            }
        }
    }
    shapes
}

/// Meshes in the order of their first use, with the nodes that use them.
fn uses<'p>(
    document: &Document,
    placed: &'p [Placed],
    notes: &mut Notes,
) -> Vec<(usize, Vec<&'p Placed>)> {
    let root = &document.root;
    let mut uses: Vec<(usize, Vec<&Placed>)> = Vec::new();
    let mut slot_of_mesh = HashMap::new();
    for instance in placed {
        let node = &root.nodes[instance.node];
        let place = || format!("nodes[{}]", instance.node);
        let Some(mesh) = node.mesh.map(|mesh| mesh.value()) else { continue };
        if mesh >= root.meshes.len() {
            notes.problem(no_such("meshes", mesh, root.meshes.len()).at("mesh").rooted(place()));
            continue;
        }
        if node.skin.is_some() {
            let what = "skins are left out; the mesh stands as stored, placed by its own node";
            notes.warn(Flaw::new(what, "apply the pose before export").at(place()));
        }
        let slot = *slot_of_mesh.entry(mesh).or_insert_with(|| {
            uses.push((mesh, Vec::new()));
            uses.len() - 1
        });
        uses[slot].1.push(instance);
    }
    uses
}

fn instantiate(
    source: Source,
    instances: &[&Placed],
    budget: &mut Budget,
    surfaces: &mut Surfaces,
    notes: &mut Notes,
) -> Result<Vec<Shape>, Flaw> {
    let Some(size) = source.size(notes)?.filter(|size| size.triangles > 0) else {
        return Ok(Vec::new());
    };
    budget.spend(size, instances.len())?;
    let decoded = source.decode(size, surfaces, notes)?;
    let place = |instance: &&Placed| decoded.placed(String::new(), &instance.world_from_node);
    Ok(instances.iter().map(place).collect())
}

/// After its node, else its mesh; with the number of the primitive where there are several.
fn shape_name(document: &Document, node: usize, mesh: usize, primitive: usize) -> String {
    let root = &document.root;
    let record = &root.meshes[mesh];
    let named = root.nodes[node].name.as_ref().or(record.name.as_ref());
    let name = named.cloned().unwrap_or_else(|| nodes::name(root, node));
    if record.primitives.len() > 1 { format!("{name} [{primitive}]") } else { name }
}

/// What the placed scene may still take.
struct Budget {
    vertices: u64,
    triangles: u64,
}

impl Budget {
    fn spend(&mut self, size: Size, instances: usize) -> Result<(), Flaw> {
        let left = |budget: u64, each: usize| {
            budget.checked_sub((each as u64).checked_mul(instances as u64)?)
        };
        let vertices = left(self.vertices, size.vertices);
        let triangles = left(self.triangles, size.triangles);
        let (Some(vertices), Some(triangles)) = (vertices, triangles) else {
            let what = format!(
                "{} vertices and {} triangles, placed {instances} times, exceed {} and {} of a scene",
                size.vertices,
                size.triangles,
                limits::VERTICES,
                limits::TRIANGLES
            );
            return Err(Flaw::new(what, "simplify or split the scene"));
        };
        *self = Self { vertices, triangles };
        Ok(())
    }
}
