//! The forest of nodes: which are in the scene, and where (glTF 2.0, section 3.5).

use super::limits;
use super::notes::{Flaw, Notes, no_such};
use gltf_json::{Node, Root};
use isolux::geometry::{Transform, Vector};

/// A node of the scene and its place in the world.
pub(super) struct Placed {
    pub(super) node: usize,
    pub(super) world_from_node: Transform,
}

/// All nodes of the default scene, parents before children. Whatever makes the nodes anything but
/// a forest is noted as a problem; then the result is empty.
pub(super) fn place(root: &Root, notes: &mut Notes) -> Vec<Placed> {
    let Some(parents) = parents(root, notes) else { return Vec::new() };
    if let Some(flaw) = cycle(&parents) {
        notes.problem(flaw);
        return Vec::new();
    }
    let roots = scene_roots(root, &parents, notes);
    let mut placed = Vec::new();
    let mut open: Vec<(usize, Transform, usize)> =
        roots.into_iter().rev().map(|node| (node, Transform::IDENTITY, 0)).collect();
    while let Some((node, world_from_parent, depth)) = open.pop() {
        if depth > limits::NODE_DEPTH {
            let what = format!("nodes nested more than {} levels deep", limits::NODE_DEPTH);
            notes.problem(Flaw::new(what, "flatten the hierarchy").at(format!("nodes[{node}]")));
            break;
        }
        let world = world_from_node(root, node, &world_from_parent, notes);
        let world = world.map_err(|flaw| flaw.rooted(format!("nodes[{node}]")));
        let Some(world_from_node) = notes.accept(world) else { continue };
        if is_hidden(&root.nodes[node]) {
            let what = "what is hidden is left out";
            let place = format!("nodes[{node}].extensions.{VISIBILITY}");
            notes.warn(Flaw::new(what, "show it if it is there").at(place));
            continue;
        }
        placed.push(Placed { node, world_from_node });
        open.extend(children(&root.nodes[node]).rev().map(|c| (c, world_from_node, depth + 1)));
    }
    placed
}

/// Name of a node, by its number where it has none.
pub(super) fn name(root: &Root, node: usize) -> String {
    root.nodes[node].name.clone().unwrap_or_else(|| format!("node {node}"))
}

const VISIBILITY: &str = "KHR_node_visibility";

/// Whether a node is hidden, with all below it.
fn is_hidden(node: &Node) -> bool {
    let others = node.extensions.as_ref().map(|e| &e.others);
    let visible = others.and_then(|others| others.get(VISIBILITY)?.get("visible"));
    visible.is_some_and(|visible| visible == false)
}

fn children(node: &Node) -> impl DoubleEndedIterator<Item = usize> {
    node.children.iter().flatten().map(gltf_json::Index::value)
}

/// The parent of every node; `None` if a child does not exist or has two.
fn parents(root: &Root, notes: &mut Notes) -> Option<Vec<Option<usize>>> {
    let mut parents = vec![None; root.nodes.len()];
    let mut sound = true;
    for (index, node) in root.nodes.iter().enumerate() {
        for child in children(node) {
            let place = format!("nodes[{index}].children");
            match parents.get_mut(child) {
                Some(slot @ None) => {
                    *slot = Some(index);
                    continue;
                }
                Some(Some(other)) => {
                    let what = format!("nodes[{child}] is already a child of nodes[{other}]");
                    let remedy =
                        "give each node one parent; repeat a mesh by naming it in two nodes";
                    notes.problem(Flaw::new(what, remedy).at(place));
                }
                None => notes.problem(no_such("nodes", child, root.nodes.len()).at(place)),
            }
            sound = false;
        }
    }
    sound.then_some(parents)
}

/// A node that is its own ancestor, if there is one.
fn cycle(parents: &[Option<usize>]) -> Option<Flaw> {
    const UNSEEN: usize = 0;
    // The walk from a node towards the root in which a node was first met.
    let mut walk = vec![UNSEEN; parents.len()];
    for start in 0..parents.len() {
        let mut at = Some(start);
        while let Some(node) = at.filter(|&node| walk[node] == UNSEEN) {
            walk[node] = start + 1;
            at = parents[node];
        }
        if let Some(node) = at.filter(|&node| walk[node] == start + 1) {
            let what = format!("nodes[{node}] is its own ancestor");
            let remedy = "nodes form trees; take it out of its descendants' children";
            return Some(Flaw::new(what, remedy).at(format!("nodes[{node}]")));
        }
    }
    None
}

fn scene_roots(root: &Root, parents: &[Option<usize>], notes: &mut Notes) -> Vec<usize> {
    let scene = match (root.scene, root.scenes.len()) {
        (Some(scene), _) => scene.value(),
        (None, 1) => 0,
        (None, scenes) => {
            if scenes > 1 {
                let what = format!("none of {scenes} scenes is the default; all nodes are taken");
                notes.warn(Flaw::new(what, "name the default scene in `scene`").at("scenes"));
            }
            return (0..parents.len()).filter(|&node| parents[node].is_none()).collect();
        }
    };
    let Some(nodes) = root.scenes.get(scene).map(|s| &s.nodes) else {
        notes.problem(no_such("scenes", scene, root.scenes.len()).at("scene"));
        return Vec::new();
    };
    if root.scenes.len() > 1 {
        let what = format!("only scenes[{scene}], the default, is read");
        notes.warn(Flaw::new(what, "split the file to solve the others").at("scenes"));
    }
    let mut listed = vec![false; parents.len()];
    let mut roots = Vec::new();
    for node in nodes.iter().map(gltf_json::Index::value) {
        let checked = scene_root(node, parents, &mut listed);
        let place = format!("scenes[{scene}].nodes");
        roots.extend(notes.accept(checked.map_err(|flaw| flaw.at(place))));
    }
    roots
}

fn scene_root(node: usize, parents: &[Option<usize>], listed: &mut [bool]) -> Result<usize, Flaw> {
    let parent = parents.get(node).ok_or_else(|| no_such("nodes", node, parents.len()))?;
    if let Some(parent) = parent {
        let what = format!("nodes[{node}] is also a child of nodes[{parent}]");
        return Err(Flaw::new(what, "a scene names its root nodes only"));
    }
    if std::mem::replace(&mut listed[node], true) {
        return Err(Flaw::new(format!("nodes[{node}] is named twice"), "name it once"));
    }
    Ok(node)
}

fn world_from_node(
    root: &Root,
    index: usize,
    world_from_parent: &Transform,
    notes: &mut Notes,
) -> Result<Transform, Flaw> {
    let node = &root.nodes[index];
    if node.matrix.is_some() && has_parts(node) {
        let what = "a matrix besides translation, rotation or scale; the matrix is taken";
        notes.warn(Flaw::new(what, "keep one of the two").at(format!("nodes[{index}]")));
    }
    let parent_from_node = match &node.matrix {
        Some(matrix) => from_matrix(&matrix.map(f64::from))?,
        None => from_parts(node)?,
    };
    let world = world_from_parent.then_from(&parent_from_node);
    let [a, b, c] = world.columns;
    if [a, b, c, world.translation].iter().all(|v| v.length().is_finite()) {
        Ok(world)
    } else {
        Err(not_finite(""))
    }
}

fn has_parts(node: &Node) -> bool {
    node.translation.is_some() || node.rotation.is_some() || node.scale.is_some()
}

/// Column-major; the last row of an affine map is 0 0 0 1.
pub(super) fn from_matrix(m: &[f64; 16]) -> Result<Transform, Flaw> {
    if !m.iter().all(|c| c.is_finite()) {
        return Err(not_finite("matrix"));
    }
    if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
        let what = "the last row of the matrix is not 0 0 0 1";
        return Err(Flaw::new(what, "use moves, rotations and scales only").at("matrix"));
    }
    let column = |k: usize| Vector::new(m[4 * k], m[4 * k + 1], m[4 * k + 2]);
    Ok(Transform { columns: [column(0), column(1), column(2)], translation: column(3) })
}

fn from_parts(node: &Node) -> Result<Transform, Flaw> {
    let translation = node.translation.unwrap_or([0.0; 3]).map(f64::from);
    let scale = node.scale.unwrap_or([1.0; 3]).map(f64::from);
    for (name, values) in [("translation", translation), ("scale", scale)] {
        if !values.iter().all(|c| c.is_finite()) {
            return Err(not_finite(name));
        }
    }
    let rotation = unit_quaternion(node.rotation.unwrap_or_default().0.map(f64::from))
        .map_err(|flaw| flaw.at("rotation"))?;
    Ok(Transform::translation(translation.into())
        .then_from(&Transform::rotation(rotation))
        .then_from(&Transform::scale(scale[0], scale[1], scale[2])))
}

/// Files store quaternions rounded to `f32`; the length is made one again.
pub(super) fn unit_quaternion(q: [f64; 4]) -> Result<[f64; 4], Flaw> {
    let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    if !length.is_finite() {
        return Err(not_finite(""));
    }
    if length == 0.0 {
        let what = "a quaternion of length zero";
        return Err(Flaw::new(what, "no rotation is 0 0 0 1"));
    }
    Ok(q.map(|c| c / length))
}

fn not_finite(place: &str) -> Flaw {
    Flaw::new("a number beyond the range of floats", "mend the transform").at(place)
}
