//! Meshes to shapes in world coordinates, one for every place of the mesh.

use super::buffers::Document;
use super::nodes::{self, Placed};
use super::notes::{Flaw, Notes, no_such};
use super::primitive::{Pose, Size, Source};
use super::skin::{self, WorldFromNode};
use super::surfaces::Surfaces;
use super::{instances, limits};
use isolux::geometry::Transform;
use isolux::scene::Shape;
use std::collections::HashMap;

/// Where a shape comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Origin {
    pub(crate) node: usize,
    /// Number of the copy where a node has several.
    pub(crate) copy: Option<usize>,
    pub(crate) mesh: usize,
    pub(crate) primitive: usize,
}

/// All shapes of the scene, ordered by the first use of their mesh.
pub(super) fn shapes(
    document: &Document,
    placed: &[Placed],
    surfaces: &mut Surfaces,
    notes: &mut Notes,
) -> Vec<(Origin, Shape)> {
    let mut budget =
        Budget { shapes: limits::SHAPES, vertices: limits::VERTICES, triangles: limits::TRIANGLES };
    let mut shapes = Vec::new();
    for Use { mesh, pose, copies } in uses(document, placed, notes) {
        for (index, record) in document.root.meshes[mesh].primitives.iter().enumerate() {
            let source = Source::new(document, record, mesh, index);
            let made = instantiate(source, (&pose, &copies), &mut budget, surfaces, notes);
            if let Some(made) = notes.accept(made.map_err(|flaw| flaw.rooted(source.place()))) {
                shapes.extend(made.into_iter().zip(&copies).map(|(shape, copy)| {
                    let name = shape_name(document, copy, mesh, index);
                    let (node, copy) = (copy.node, copy.number);
                    (Origin { node, copy, mesh, primitive: index }, Shape { name, ..shape })
                }));
            }
        }
    }
    shapes
}

/// A mesh in one pose, and where it stands.
struct Use {
    mesh: usize,
    pose: Pose,
    copies: Vec<Copy>,
}

/// One of the places of a mesh.
struct Copy {
    node: usize,
    /// Its number where a node has several.
    number: Option<usize>,
    world_from_mesh: Transform,
}

/// Meshes in the order of their first use; one is used anew by each node that bends it.
fn uses(document: &Document, placed: &[Placed], notes: &mut Notes) -> Vec<Use> {
    let root = &document.root;
    let mut uses: Vec<Use> = Vec::new();
    let mut slot_of_mesh = HashMap::new();
    let mut instances_left = limits::INSTANCES;
    let has_skin = placed.iter().any(|p| root.nodes[p.node].skin.is_some());
    let world_from_node = if has_skin { skin::places(placed) } else { HashMap::new() };
    for instance in placed {
        let node = &root.nodes[instance.node];
        let place = || format!("nodes[{}]", instance.node);
        let Some(mesh) = node.mesh.map(|mesh| mesh.value()) else { continue };
        if mesh >= root.meshes.len() {
            notes.problem(no_such("meshes", mesh, root.meshes.len()).at("mesh").rooted(place()));
            continue;
        }
        let made = copies(document, instance, &mut instances_left).and_then(|copies| {
            Ok((copies, pose(document, instance.node, mesh, &world_from_node)?))
        });
        let made = made.map_err(|flaw| flaw.rooted(place()));
        let Some((copies, pose)) = notes.accept(made) else { continue };
        let bent_by = pose.is_of_node.then_some(instance.node);
        let slot = *slot_of_mesh.entry((mesh, bent_by)).or_insert_with(|| {
            uses.push(Use { mesh, pose, copies: Vec::new() });
            uses.len() - 1
        });
        uses[slot].copies.extend(copies);
    }
    uses
}

/// The places of a node's mesh.
fn copies(document: &Document, node: &Placed, left: &mut usize) -> Result<Vec<Copy>, Flaw> {
    let Some(instances) = instances::node_from_instances(document, node.node)? else {
        let world_from_mesh = node.world_from_node;
        return Ok(vec![Copy { node: node.node, number: None, world_from_mesh }]);
    };
    *left = left.checked_sub(instances.len()).ok_or_else(|| {
        let what = format!("more than {} instances in all", limits::INSTANCES);
        Flaw::new(what, "split the scene")
    })?;
    let place = |(number, node_from_mesh): (usize, &Transform)| Copy {
        node: node.node,
        number: Some(number),
        world_from_mesh: node.world_from_node.then_from(node_from_mesh),
    };
    Ok(instances.iter().enumerate().map(place).collect())
}

/// How a node bends its mesh.
fn pose(
    document: &Document,
    node: usize,
    mesh: usize,
    world_from_node: &WorldFromNode,
) -> Result<Pose, Flaw> {
    let record = &document.root.nodes[node];
    let own = record.weights.as_ref();
    let weights = own.or(document.root.meshes[mesh].weights.as_ref());
    let weights: Vec<f64> = weights.into_iter().flatten().copied().map(f64::from).collect();
    if !weights.iter().all(|weight| weight.is_finite()) {
        let flaw = Flaw::new("a weight that is no finite number", "mend it");
        return Err(flaw.at("weights"));
    }
    let joints = record.skin.map(|s| skin::world_from_mesh(document, s.value(), world_from_node));
    let joints = joints.transpose()?;
    Ok(Pose { is_of_node: own.is_some() || joints.is_some(), weights, joints })
}

fn instantiate(
    source: Source,
    (pose, copies): (&Pose, &[Copy]),
    budget: &mut Budget,
    surfaces: &mut Surfaces,
    notes: &mut Notes,
) -> Result<Vec<Shape>, Flaw> {
    let Some(size) = source.size(notes)?.filter(|size| size.triangles > 0) else {
        return Ok(Vec::new());
    };
    budget.spend(size, copies.len())?;
    let decoded = source.decode(size, pose, surfaces, notes)?;
    Ok(copies.iter().map(|copy| decoded.placed(&copy.world_from_mesh)).collect())
}

/// After its node, else its mesh; with the number of the copy and of the primitive where there are several.
fn shape_name(document: &Document, copy: &Copy, mesh: usize, primitive: usize) -> String {
    let root = &document.root;
    let record = &root.meshes[mesh];
    let named = root.nodes[copy.node].name.as_ref().or(record.name.as_ref());
    let mut name = named.cloned().unwrap_or_else(|| nodes::name(root, copy.node));
    if let Some(number) = copy.number {
        name += &format!("[{number}]");
    }
    if record.primitives.len() > 1 { format!("{name} [{primitive}]") } else { name }
}

/// What the placed scene may still take.
struct Budget {
    shapes: u64,
    vertices: u64,
    triangles: u64,
}

impl Budget {
    fn spend(&mut self, size: Size, instances: usize) -> Result<(), Flaw> {
        let left = |budget: u64, each: usize| {
            budget.checked_sub((each as u64).checked_mul(instances as u64)?)
        };
        let shapes = left(self.shapes, 1).ok_or_else(|| {
            let what = format!("more than {} surfaces of the scene in all", limits::SHAPES);
            Flaw::new(what, "join meshes, or split the scene")
        })?;
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
        *self = Self { shapes, vertices, triangles };
        Ok(())
    }
}
