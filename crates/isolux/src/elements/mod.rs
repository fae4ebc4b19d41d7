//! Elements: the surfaces of a scene, subdivided, with a piecewise linear function over them.
//!
//! Every side of every triangle that carries a map is the root of a tree of bisections. Vertices
//! are shared between coplanar (or smoothly joined) neighbours of one side and split at creases.

mod arrays;
mod hash;
mod subdivide;
mod walk;

#[cfg(test)]
mod tests;

pub use arrays::{ElementArrays, ElementArraysError};
pub use hash::FewNumbers;
pub(crate) use hash::{set_in_order, table_in_order};
pub(crate) use subdivide::edge_key;
pub use subdivide::{Origin, Receiver, Subdivision, carries_map};
pub(crate) use subdivide::{first_corner_count, first_vertex_count};
pub(crate) use walk::Place;

use isolux_geometry::{Normal, Point};
use serde::Deserialize;
use walk::Walk;

/// Elements or vertices of one task, where little is done for each.
pub(crate) const TOGETHER: usize = 4096;

/// A place on one side of a triangle of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceOnSide {
    /// Number of the triangle.
    pub triangle: u32,
    /// Whether it is on the back, from where corners run clockwise.
    pub back: bool,
    /// Barycentric weights of the second and the third corner.
    pub uv: [f64; 2],
}

/// The subdivided surfaces.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "ElementArrays")]
pub struct Elements {
    vertices: Vec<Vertex>,
    nodes: Vec<Node>,
    /// Per triangle of the scene: the root of its front and of its back.
    roots: Vec<[Option<u32>; 2]>,
    /// The splits of the nodes once more.
    walk: Walk,
}

/// A vertex of the elements: a receiver of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Place on the surface, m.
    pub position: Point,
    /// Shading normal of the side it is on.
    pub normal: Normal,
    /// The ends of the edge it is the middle of, for vertices made by bisection.
    pub parents: Option<[u32; 2]>,
    /// Integral of its hat function, m2.
    pub area_m2: f64,
}

/// A node of a tree of bisections: an element where it is not split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    /// Vertices, counter-clockwise seen from the front of the scene's triangle.
    pub vertices: [u32; 3],
    /// How it is bisected.
    pub split: Option<Split>,
}

/// A bisection at the middle of one edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Split {
    /// The edge from vertex `edge` to vertex `(edge + 1) % 3`.
    pub edge: u8,
    /// The child that keeps vertex `edge`; the other child follows it.
    pub first_child: u32,
}

/// An element that is not split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// The triangle of the scene it is part of.
    pub triangle: u32,
    /// Whether it is on the back of it.
    pub back: bool,
    /// Its vertices, counter-clockwise seen from the front of the scene's triangle.
    pub vertices: [u32; 3],
}

impl Elements {
    fn new(vertices: Vec<Vertex>, nodes: Vec<Node>, roots: Vec<[Option<u32>; 2]>) -> Self {
        let splits = nodes.iter().map(|node| node.split.map(|s| (s.edge, s.first_child)));
        let walk = Walk::new(splits);
        Self { vertices, nodes, roots, walk }
    }

    /// The vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// A node by its number.
    pub(crate) fn node(&self, node: u32) -> Node {
        self.nodes[node as usize]
    }

    /// How many nodes there are.
    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The roots of front and back of every triangle of the scene.
    pub(crate) fn roots(&self) -> &[[Option<u32>; 2]] {
        &self.roots
    }

    /// All elements, in the order of the triangles of the scene.
    pub fn elements(&self) -> Vec<Element> {
        let mut found = Vec::new();
        for (triangle, sides) in self.roots.iter().enumerate() {
            for (root, back) in sides.iter().zip([false, true]) {
                let Some(root) = *root else { continue };
                self.visit_below(root, &mut |vertices| {
                    found.push(Element { triangle: triangle as u32, back, vertices });
                });
            }
        }
        found
    }

    /// The node of every element, the triangle of the scene that it is part of, and whether it is on the back of that.
    pub(crate) fn leaves(&self) -> impl Iterator<Item = (u32, u32, bool)> + '_ {
        let sides = (0..).zip(&self.roots).flat_map(|(triangle, roots)| {
            let of_side = move |back: bool| Some((roots[usize::from(back)]?, triangle, back));
            [false, true].into_iter().filter_map(of_side)
        });
        sides.flat_map(move |(root, triangle, back)| {
            let mut waiting = vec![root];
            std::iter::from_fn(move || {
                loop {
                    let node = waiting.pop()?;
                    match self.nodes[node as usize].split {
                        None => return Some((node, triangle, back)),
                        Some(Split { first_child, .. }) => {
                            waiting.extend([first_child, first_child + 1]);
                        }
                    }
                }
            })
        })
    }

    /// Visits the vertices of all elements below a node.
    pub(crate) fn visit_below(&self, node: u32, visit: &mut impl FnMut([u32; 3])) {
        let node = self.nodes[node as usize];
        match node.split {
            None => visit(node.vertices),
            Some(Split { first_child, .. }) => {
                self.visit_below(first_child, visit);
                self.visit_below(first_child + 1, visit);
            }
        }
    }

    /// The element at barycentric weights `(1 - u - v, u, v)` of a triangle: its vertices and their
    /// weights there. `None` where the side carries no map.
    pub fn locate(&self, triangle: u32, back: bool, u: f64, v: f64) -> Option<[(u32, f64); 3]> {
        self.locate_above(u32::MAX, triangle, back, u, v)
    }

    /// The same on a coarser level: as if the nodes from number `level` on did not exist.
    pub fn locate_above(
        &self,
        level: u32,
        triangle: u32,
        back: bool,
        u: f64,
        v: f64,
    ) -> Option<[(u32, f64); 3]> {
        self.place(level, triangle, back, [u, v]).map(|place| self.corners(place))
    }

    /// The place that it is.
    #[inline]
    pub(crate) fn place(
        &self,
        level: u32,
        triangle: u32,
        back: bool,
        [u, v]: [f64; 2],
    ) -> Option<Place> {
        let root = self.roots.get(triangle as usize)?[usize::from(back)]?;
        Some(self.walk.down(self.walk.in_root(root, u, v), level))
    }

    /// A place on a finer level.
    pub(crate) fn below(&self, place: Place, level: u32) -> Place {
        self.walk.down(place, level)
    }

    /// Vertices and their weights at a place.
    #[inline]
    pub(crate) fn corners(&self, place: Place) -> [(u32, f64); 3] {
        let Node { vertices, split } = self.nodes[place.node() as usize];
        let weights = place.weights(split.map_or(0, |split| split.edge));
        [0, 1, 2].map(|k| (vertices[k], weights[k]))
    }
}
