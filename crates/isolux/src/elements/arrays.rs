//! Elements as plain arrays, for files.

use super::walk::MOST_NODES;
use super::{Elements, Node, Split, Vertex};
use isolux_geometry::{Point, Vector};
use serde::{Deserialize, Serialize, Serializer};

/// The index that stands for none.
const NONE: u32 = u32::MAX;

/// Bisections below one another: halving an area so often leaves nothing of it.
const MAX_DEPTH: u8 = 64;

/// [`Elements`] as arrays of numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ElementArrays {
    /// Vertex positions, m.
    pub positions: Vec<[f64; 3]>,
    /// Vertex normals.
    pub normals: Vec<[f64; 3]>,
    /// Ends of the edge each vertex is the middle of, `u32::MAX` twice for vertices of the scene.
    pub parents: Vec<[u32; 2]>,
    /// Integrals of the hat functions, m2.
    pub areas_m2: Vec<f64>,
    /// Vertices of the nodes.
    pub nodes: Vec<[u32; 3]>,
    /// Per node the edge bisected and the first child, `u32::MAX` twice for elements.
    pub splits: Vec<[u32; 2]>,
    /// Per triangle of the scene the root of front and back, `u32::MAX` for none.
    pub roots: Vec<[u32; 2]>,
}

/// Why arrays are not elements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ElementArraysError {
    /// Arrays over the same things have different lengths.
    #[error("arrays of {0} have different lengths")]
    Lengths(&'static str),
    /// More nodes than can be counted.
    #[error("{0} nodes are more than can be read")]
    TooMany(usize),
    /// An index points nowhere, or a tree is not a tree.
    #[error("{0} refers to something that does not exist")]
    Index(&'static str),
    /// A number is not finite, an area negative, or a normal has no direction.
    #[error("vertex {0} has no position, no normal or no area")]
    Vertex(usize),
}

impl ElementArrays {
    /// The arrays of vertices, nodes and roots.
    pub(super) fn of(vertices: &[Vertex], nodes: &[Node], roots: &[[Option<u32>; 2]]) -> Self {
        let split = |split: Split| [u32::from(split.edge), split.first_child];
        Self {
            positions: vertices.iter().map(|v| v.position.into()).collect(),
            normals: vertices.iter().map(|v| v.normal.to_vector().into()).collect(),
            parents: vertices.iter().map(|v| v.parents.unwrap_or([NONE; 2])).collect(),
            areas_m2: vertices.iter().map(|v| v.area_m2).collect(),
            nodes: nodes.iter().map(|n| n.vertices).collect(),
            splits: nodes.iter().map(|n| n.split.map_or([NONE; 2], split)).collect(),
            roots: roots.iter().map(|r| r.map(|root| root.unwrap_or(NONE))).collect(),
        }
    }
}

impl Serialize for Elements {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_arrays().serialize(serializer)
    }
}

impl Elements {
    /// As plain arrays.
    pub fn to_arrays(&self) -> ElementArrays {
        ElementArrays::of(&self.vertices, &self.nodes, &self.roots)
    }

    /// From plain arrays, of any origin: every index is checked, and so is that the nodes are trees,
    /// not too deep, which bounds every walk.
    pub fn from_arrays(arrays: &ElementArrays) -> Result<Self, ElementArraysError> {
        let (vertices, nodes) = (arrays.positions.len(), arrays.nodes.len());
        if [arrays.normals.len(), arrays.parents.len(), arrays.areas_m2.len()] != [vertices; 3] {
            return Err(ElementArraysError::Lengths("vertices"));
        }
        if arrays.splits.len() != nodes {
            return Err(ElementArraysError::Lengths("nodes"));
        }
        if nodes >= MOST_NODES {
            return Err(ElementArraysError::TooMany(nodes));
        }
        let elements = Self::new(
            (0..vertices).map(|k| vertex(arrays, k)).collect::<Result<_, _>>()?,
            (0..nodes).map(|k| node(arrays, k)).collect::<Result<_, _>>()?,
            arrays.roots.iter().map(|r| roots(*r, nodes)).collect::<Result<_, _>>()?,
        );
        if !are_trees(&elements) {
            return Err(ElementArraysError::Index("a tree of bisections"));
        }
        Ok(elements)
    }
}

impl TryFrom<ElementArrays> for Elements {
    type Error = ElementArraysError;

    fn try_from(arrays: ElementArrays) -> Result<Self, ElementArraysError> {
        Self::from_arrays(&arrays)
    }
}

/// Whether every node is at most once a root or a child, no deeper than the bound. Children come
/// after their parent, so one pass in order knows the depth of each parent before its children.
fn are_trees(elements: &Elements) -> bool {
    let mut depth: Vec<Option<u8>> = vec![None; elements.nodes.len()];
    for &root in elements.roots.iter().flatten().flatten() {
        if depth[root as usize].replace(0).is_some() {
            return false;
        }
    }
    for (index, node) in elements.nodes.iter().enumerate() {
        let Some(Split { first_child, .. }) = node.split else { continue };
        let below = depth[index].unwrap_or(0) + 1;
        for child in [first_child, first_child + 1] {
            if below > MAX_DEPTH || depth[child as usize].replace(below).is_some() {
                return false;
            }
        }
    }
    true
}

fn vertex(arrays: &ElementArrays, index: usize) -> Result<Vertex, ElementArraysError> {
    let position = Point::from(arrays.positions[index]);
    let normal = Vector::from(arrays.normals[index]).normal();
    let area_m2 = arrays.areas_m2[index];
    let is_finite = position.is_finite() && area_m2.is_finite() && area_m2 >= 0.0;
    let (Some(normal), true) = (normal, is_finite) else {
        return Err(ElementArraysError::Vertex(index));
    };
    let parents = arrays.parents[index];
    let made = parents != [NONE; 2];
    if made && parents.iter().any(|&p| p as usize >= index) {
        return Err(ElementArraysError::Index("the parent of a vertex"));
    }
    Ok(Vertex { position, normal, parents: made.then_some(parents), area_m2 })
}

fn node(arrays: &ElementArrays, index: usize) -> Result<Node, ElementArraysError> {
    let vertices = arrays.nodes[index];
    if vertices.iter().any(|&v| v as usize >= arrays.positions.len()) {
        return Err(ElementArraysError::Index("the vertex of a node"));
    }
    let [edge, first_child] = arrays.splits[index];
    if [edge, first_child] == [NONE; 2] {
        return Ok(Node { vertices, split: None });
    }
    let after = first_child as usize > index && (first_child as usize + 1) < arrays.nodes.len();
    if edge > 2 || !after {
        return Err(ElementArraysError::Index("the split of a node"));
    }
    Ok(Node { vertices, split: Some(Split { edge: edge as u8, first_child }) })
}

fn roots(roots: [u32; 2], nodes: usize) -> Result<[Option<u32>; 2], ElementArraysError> {
    if roots.iter().any(|&r| r != NONE && r as usize >= nodes) {
        return Err(ElementArraysError::Index("the root of a triangle"));
    }
    Ok(roots.map(|r| (r != NONE).then_some(r)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One vertex, nodes that split as said, two sides of a triangle with the roots as said.
    fn nodes(splits: &[[u32; 2]], roots: [u32; 2]) -> ElementArrays {
        ElementArrays {
            positions: vec![[0.0; 3]],
            normals: vec![[0.0, 0.0, 1.0]],
            parents: vec![[NONE; 2]],
            areas_m2: vec![1.0],
            nodes: vec![[0; 3]; splits.len()],
            splits: splits.to_vec(),
            roots: vec![roots],
        }
    }

    #[test]
    fn nodes_that_are_no_trees_are_refused() {
        const LEAF: [u32; 2] = [NONE; 2];
        // Every second node is split into the two that follow it.
        let split = |k: u32, levels: u32| {
            if k.is_multiple_of(2) && k < 2 * levels { [0, k + 1] } else { LEAF }
        };
        let deep = |levels: u32| (0..=2 * levels).map(|k| split(k, levels)).collect();
        for (name, splits, roots, is_tree) in [
            ("one element", vec![LEAF], [0, NONE], true),
            ("one bisection", vec![[0, 1], LEAF, LEAF], [NONE, 0], true),
            ("two sides", vec![LEAF, LEAF], [0, 1], true),
            ("shared sides", vec![LEAF], [0, 0], false),
            ("a root that is a child", vec![[0, 1], LEAF, LEAF], [0, 1], false),
            ("overlapping children", vec![[0, 1], [0, 2], LEAF, LEAF], [0, NONE], false),
            ("a child before its parent", vec![LEAF, LEAF, [0, 0]], [2, NONE], false),
            ("an edge too many", vec![[3, 1], LEAF, LEAF], [0, NONE], false),
            ("a child too many", vec![[0, 1], LEAF], [0, NONE], false),
            ("as deep as allowed", deep(u32::from(MAX_DEPTH)), [0, NONE], true),
            ("too deep", deep(u32::from(MAX_DEPTH) + 1), [0, NONE], false),
        ] {
            let found = Elements::from_arrays(&nodes(&splits, roots));
            assert_eq!(found.is_ok(), is_tree, "{name}: {found:?}");
        }
    }
}
