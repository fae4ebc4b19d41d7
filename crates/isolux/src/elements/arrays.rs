//! Elements as plain arrays, for files.

use super::{Elements, Node, Split, Vertex};
use isolux_geometry::{Point, Vector};

/// The index that stands for none.
const NONE: u32 = u32::MAX;

/// [`Elements`] as arrays of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
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
    /// An index points nowhere, or a tree is not a tree.
    #[error("{0} refers to something that does not exist")]
    Index(&'static str),
    /// A number is not finite, or a normal has no direction.
    #[error("vertex {0} has no position or no normal")]
    Vertex(usize),
}

impl Elements {
    /// As plain arrays.
    pub fn to_arrays(&self) -> ElementArrays {
        ElementArrays {
            positions: self.vertices.iter().map(|v| v.position.into()).collect(),
            normals: self.vertices.iter().map(|v| v.normal.to_vector().into()).collect(),
            parents: self.vertices.iter().map(|v| v.parents.unwrap_or([NONE; 2])).collect(),
            areas_m2: self.vertices.iter().map(|v| v.area_m2).collect(),
            nodes: self.nodes.iter().map(|n| n.vertices).collect(),
            splits: self
                .nodes
                .iter()
                .map(|n| n.split.map_or([NONE; 2], |s| [u32::from(s.edge), s.first_child]))
                .collect(),
            roots: self.roots.iter().map(|r| r.map(|root| root.unwrap_or(NONE))).collect(),
        }
    }

    /// From plain arrays, of any origin: every index is checked, and so is that children come after
    /// their parent, which bounds every walk.
    pub fn from_arrays(arrays: &ElementArrays) -> Result<Self, ElementArraysError> {
        let (vertices, nodes) = (arrays.positions.len(), arrays.nodes.len());
        if [arrays.normals.len(), arrays.parents.len(), arrays.areas_m2.len()] != [vertices; 3] {
            return Err(ElementArraysError::Lengths("vertices"));
        }
        if arrays.splits.len() != nodes {
            return Err(ElementArraysError::Lengths("nodes"));
        }
        Ok(Self {
            vertices: (0..vertices).map(|k| vertex(arrays, k)).collect::<Result<_, _>>()?,
            nodes: (0..nodes).map(|k| node(arrays, k)).collect::<Result<_, _>>()?,
            roots: arrays.roots.iter().map(|r| roots(*r, nodes)).collect::<Result<_, _>>()?,
        })
    }
}

fn vertex(arrays: &ElementArrays, index: usize) -> Result<Vertex, ElementArraysError> {
    let position = Point::from(arrays.positions[index]);
    let normal = Vector::from(arrays.normals[index]).normal();
    let (Some(normal), true) = (normal, position.is_finite()) else {
        return Err(ElementArraysError::Vertex(index));
    };
    let parents = arrays.parents[index];
    let made = parents != [NONE; 2];
    if made && parents.iter().any(|&p| p as usize >= index) {
        return Err(ElementArraysError::Index("the parent of a vertex"));
    }
    let area_m2 = arrays.areas_m2[index];
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
