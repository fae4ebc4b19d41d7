//! Longest-edge bisection of the surfaces of a scene.
//!
//! An element is bisected only at its longest edge, together with all elements on that edge, after
//! those of them that have a longer one (the longest-edge propagation path of Rivara 1997). So no
//! T-vertex appears, angles never fall below half the smallest of the input, and the tree over each
//! triangle of the scene locates any point of it.

use super::hash::FewNumbers;
use super::{ElementArrays, Elements, Node, Split, TOGETHER, Vertex};
use crate::scene::{Finish, Scene};
use isolux_geometry::{Normal, Point, Triangle};
use rayon::prelude::*;
use serde::{Deserialize, Serialize, Serializer};
use smallvec::SmallVec;
use std::collections::HashMap;

/// Vertices at one place are one where their normals agree within one degree: coplanar or smoothly
/// joined neighbours; anything else is a crease.
const CREASE_COS: f64 = 0.999_847_7;

/// The nodes of a closed surface by vertex, at most: two elements, and the nodes that were split into them.
const NODES_A_VERTEX: usize = 4;

/// Vertices at one place, elements on one edge: mostly one or two.
type Few = SmallVec<[u32; 2]>;

/// Elements that can still be bisected.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "Elements")]
pub struct Subdivision {
    vertices: Vec<Vertex>,
    nodes: Vec<Node>,
    origins: Vec<Origin>,
    /// Of every node the longest edge: its squared length, m2, and which it is.
    longest: Vec<(f64, u8)>,
    roots: Vec<[Option<u32>; 2]>,
    /// The elements on every edge, by its ends, the lower first.
    edges: HashMap<[u32; 2], Few, FewNumbers>,
    /// Of every vertex, whether it lies on an edge with elements on one side only: bisection changes that of none.
    on_border: Vec<bool>,
}

impl Serialize for Subdivision {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        ElementArrays::of(&self.vertices, &self.nodes, &self.roots).serialize(serializer)
    }
}

impl From<Elements> for Subdivision {
    /// The subdivision with these elements. All else follows from them.
    fn from(elements: Elements) -> Self {
        let Elements { mut vertices, nodes, roots, .. } = elements;
        vertices.iter_mut().for_each(|vertex| vertex.area_m2 = 0.0);
        let mut origins = vec![Origin { triangle: 0, back: false, depth: 0 }; nodes.len()];
        for (triangle, sides) in (0..).zip(&roots) {
            for (root, back) in sides.iter().zip([false, true]) {
                if let Some(root) = root {
                    origins[*root as usize] = Origin { triangle, back, depth: 0 };
                }
            }
        }
        // Children come after their parents.
        for node in 0..nodes.len() {
            let Some(Split { first_child, .. }) = nodes[node].split else { continue };
            let origin = Origin { depth: origins[node].depth + 1, ..origins[node] };
            origins[first_child as usize..][..2].fill(origin);
        }
        let (longest, edges, on_border) = (Vec::new(), HashMap::default(), Vec::new());
        let mut made = Self { vertices, nodes, origins, longest, roots, edges, on_border };
        made.longest = made.nodes.iter().map(|node| made.longest_of(node.vertices)).collect();
        for leaf in made.leaves().collect::<Vec<_>>() {
            made.list_at_edges(leaf);
        }
        made.find_border();
        made
    }
}

/// Which side of which triangle a node is part of, and its depth in the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Triangle of the scene.
    pub triangle: u32,
    /// Whether it is on the back.
    pub back: bool,
    /// Bisections above it.
    pub depth: u32,
}

impl Subdivision {
    /// The triangles of the scene that carry a map, as they are.
    pub fn new(scene: &Scene) -> Self {
        let (vertices, roots) = welded(scene);
        let mut subdivision = Self {
            vertices,
            nodes: Vec::with_capacity(roots.len()),
            origins: Vec::with_capacity(roots.len()),
            longest: Vec::with_capacity(roots.len()),
            roots: vec![[None; 2]; scene.triangle_count() as usize],
            edges: HashMap::with_capacity_and_hasher(3 * roots.len() / 2, FewNumbers::default()),
            on_border: Vec::new(),
        };
        for (corners, origin) in roots {
            let root = subdivision.push(corners, origin);
            subdivision.roots[origin.triangle as usize][usize::from(origin.back)] = Some(root);
        }
        subdivision.find_border();
        subdivision
    }

    fn find_border(&mut self) {
        let mut on_border = vec![false; self.vertices.len()];
        self.border_edges().iter().flatten().for_each(|&end| on_border[end as usize] = true);
        self.on_border = on_border;
    }

    fn push(&mut self, vertices: [u32; 3], origin: Origin) -> u32 {
        let node = self.nodes.len() as u32;
        self.nodes.push(Node { vertices, split: None });
        self.origins.push(origin);
        self.longest.push(self.longest_of(vertices));
        self.list_at_edges(node);
        node
    }

    fn list_at_edges(&mut self, node: u32) {
        let vertices = self.nodes[node as usize].vertices;
        for k in 0..3 {
            let edge = edge_key(vertices[k], vertices[(k + 1) % 3]);
            self.edges.entry(edge).or_default().push(node);
        }
    }

    /// The vertices, without areas.
    pub(crate) fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// How large the subdivision is, in vertices. A surface has two elements a vertex, and as many that were split. Where many surfaces
    /// lie upon each other, their elements share vertices, and count instead.
    pub(crate) fn size(&self) -> usize {
        self.vertices.len().max(self.nodes.len() / NODES_A_VERTEX)
    }

    /// The roots of front and back of every triangle of the scene.
    pub(crate) fn roots(&self) -> &[[Option<u32>; 2]] {
        &self.roots
    }

    /// Number of nodes of all trees.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The nodes that are not split, in the order they were made.
    pub fn leaves(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.nodes.len() as u32).filter(|&n| self.nodes[n as usize].split.is_none())
    }

    /// A node and where it comes from.
    pub fn node(&self, node: u32) -> (Node, Origin) {
        (self.nodes[node as usize], self.origins[node as usize])
    }

    /// The corners of a node.
    pub fn triangle(&self, node: u32) -> Triangle {
        let corners = self.nodes[node as usize].vertices;
        Triangle { corners: corners.map(|v| self.vertices[v as usize].position) }
    }

    /// Length of the longest edge of a node, m.
    pub fn longest_edge_m(&self, node: u32) -> f64 {
        self.longest[node as usize].0.sqrt()
    }

    /// Bisects until no edge is longer than `edge_m` or the subdivision is as large as one of `max_vertices`.
    pub fn bisect_to(&mut self, edge_m: f64, max_vertices: usize) {
        let mut node = 0;
        // Children are appended, so one pass over the growing list sees them all.
        while node < self.nodes.len() as u32 && self.size() < max_vertices {
            if self.nodes[node as usize].split.is_none() && self.longest_edge_m(node) > edge_m {
                self.bisect(node);
            }
            node += 1;
        }
    }

    /// Bisects an element, and before it whatever must be bisected so that no T-vertex appears.
    pub fn bisect(&mut self, node: u32) {
        while self.nodes[node as usize].split.is_none() {
            let edge = self.end_of_longest_edge_path(node);
            self.bisect_edge(edge);
        }
    }

    /// Bisects an element and its children.
    pub(crate) fn bisect_twice(&mut self, node: u32) {
        self.bisect(node);
        if let Some(split) = self.nodes[node as usize].split {
            self.bisect(split.first_child);
            self.bisect(split.first_child + 1);
        }
    }

    /// From element to element over longest edges, until an edge is the longest of all elements on
    /// it. The edges grow strictly in [`Self::longest_of`]'s order, so the path ends.
    fn end_of_longest_edge_path(&self, node: u32) -> [u32; 2] {
        let mut edge = self.longest_edge(node);
        loop {
            let longer = self.edges[&edge].iter().map(|&n| self.longest_edge(n));
            match longer.into_iter().find(|&other| other != edge) {
                Some(other) => edge = other,
                None => return edge,
            }
        }
    }

    fn bisect_edge(&mut self, edge: [u32; 2]) {
        let elements = self.edges.remove(&edge).unwrap_or_default();
        let middle = self.middle(edge);
        self.on_border.push(self.is_border(edge, &elements));
        self.unlist(&elements, edge);
        for node in elements {
            self.split(node, edge, middle);
        }
    }

    /// Takes the elements on an edge off the lists of their other edges. Every list is gone through once, however many of them are on it.
    fn unlist(&mut self, elements: &[u32], edge: [u32; 2]) {
        let others = |&node: &u32| {
            let vertices = self.nodes[node as usize].vertices;
            (0..3).map(move |k| edge_key(vertices[k], vertices[(k + 1) % 3]))
        };
        let mut others: SmallVec<[[u32; 2]; 8]> = elements.iter().flat_map(others).collect();
        others.sort_unstable();
        others.dedup();
        for other in others {
            if let Some(list) = self.edges.get_mut(&other) {
                let is_on = |node: u32| {
                    edge.iter().all(|end| self.nodes[node as usize].vertices.contains(end))
                };
                list.retain(|node| !is_on(*node));
            }
        }
    }

    fn middle(&mut self, [a, b]: [u32; 2]) -> u32 {
        let (va, vb) = (self.vertices[a as usize], self.vertices[b as usize]);
        let sum = va.normal.to_vector() + vb.normal.to_vector();
        self.vertices.push(Vertex {
            position: va.position.lerp(vb.position, 0.5),
            normal: sum.normal().unwrap_or(va.normal),
            parents: Some([a, b]),
            area_m2: 0.0,
        });
        self.vertices.len() as u32 - 1
    }

    fn split(&mut self, node: u32, edge: [u32; 2], middle: u32) {
        let (Node { vertices, .. }, origin) = self.node(node);
        let on = |k: usize| edge_key(vertices[k], vertices[(k + 1) % 3]);
        let k = (0..3).find(|&k| on(k) == edge).expect("an element is listed at its own edges");
        let (mut first, mut second) = (vertices, vertices);
        first[(k + 1) % 3] = middle;
        second[k] = middle;
        let origin = Origin { depth: origin.depth + 1, ..origin };
        let first_child = self.push(first, origin);
        self.push(second, origin);
        self.nodes[node as usize].split = Some(Split { edge: k as u8, first_child });
    }

    /// The ends of the longest edge.
    fn longest_edge(&self, node: u32) -> [u32; 2] {
        let vertices = self.nodes[node as usize].vertices;
        let k = usize::from(self.longest[node as usize].1);
        edge_key(vertices[k], vertices[(k + 1) % 3])
    }

    /// The longest edge: its squared length and its number; of equal ones the one whose ends come
    /// last, so that every element on an edge agrees.
    fn longest_of(&self, vertices: [u32; 3]) -> (f64, u8) {
        let edge = |k: usize| {
            let key = edge_key(vertices[k], vertices[(k + 1) % 3]);
            let [a, b] = key.map(|v| self.vertices[v as usize].position);
            ((b - a).length_squared(), key, k as u8)
        };
        let longer = |a: (f64, [u32; 2], u8), b: (f64, [u32; 2], u8)| {
            if a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).is_ge() { a } else { b }
        };
        let (square, _, k) = longer(longer(edge(0), edge(1)), edge(2));
        (square, k)
    }

    /// The elements as they are now.
    pub fn elements(&self) -> Elements {
        let mut vertices = self.vertices.clone();
        for leaf in self.leaves() {
            let third = self.triangle(leaf).area() / 3.0;
            for v in self.nodes[leaf as usize].vertices {
                vertices[v as usize].area_m2 += third;
            }
        }
        Elements::new(vertices, self.nodes.clone(), self.roots.clone())
    }

    /// Where to sample the light of every vertex: at the vertex, or, where elements do not surround
    /// it, pulled in by `share` of the way to the middle of its widest element. (At the very edge a
    /// receiver would see the neighbouring wall from distance zero.) The element is named, too.
    pub fn receivers(&self, share: f64) -> Vec<Receiver> {
        let on_border = self.border_vertices();
        let mut widest: Vec<Option<(f64, u32)>> = vec![None; self.vertices.len()];
        let leaves: Vec<u32> = self.leaves().collect();
        let angles = |&leaf: &u32| [0, 1, 2].map(|k| self.angle(leaf, k));
        let angles: Vec<[f64; 3]> = leaves.par_iter().with_min_len(TOGETHER).map(angles).collect();
        for (leaf, angles) in leaves.into_iter().zip(angles) {
            for (v, angle) in self.nodes[leaf as usize].vertices.into_iter().zip(angles) {
                let best = &mut widest[v as usize];
                if best.is_none_or(|(widest, _)| angle > widest) {
                    *best = Some((angle, leaf));
                }
            }
        }
        let receiver = |vertex: usize| {
            let (_, node) = widest[vertex].expect("every vertex is a corner of an element");
            self.receiver(vertex as u32, node, if on_border[vertex] { share } else { 0.0 })
        };
        (0..self.vertices.len()).into_par_iter().with_min_len(TOGETHER).map(receiver).collect()
    }

    fn receiver(&self, vertex: u32, node: u32, share: f64) -> Receiver {
        let (Node { vertices, .. }, Origin { triangle, back, .. }) = self.node(node);
        let at = self.vertices[vertex as usize];
        let centroid = self.triangle(node).centroid();
        debug_assert!(vertices.contains(&vertex), "a receiver lies in an element at its vertex");
        Receiver { point: at.position.lerp(centroid, share), normal: at.normal, triangle, back }
    }

    fn angle(&self, node: u32, corner: usize) -> f64 {
        let p = self.triangle(node).corners;
        let (a, b) = (p[(corner + 1) % 3] - p[corner], p[(corner + 2) % 3] - p[corner]);
        libm::atan2(a.cross(b).length(), a.dot(b))
    }

    /// Of every vertex, the least that edges connect it to.
    pub(crate) fn least_connected(&self) -> Vec<u32> {
        fn root(of: &mut [u32], mut v: u32) -> u32 {
            while of[v as usize] != v {
                of[v as usize] = of[of[v as usize] as usize];
                v = of[v as usize];
            }
            v
        }
        let mut of: Vec<u32> = (0..self.vertex_count() as u32).collect();
        for leaf in self.leaves() {
            let roots = self.nodes[leaf as usize].vertices.map(|v| root(&mut of, v));
            let least = roots.into_iter().min().unwrap_or(0);
            roots.iter().for_each(|&v| of[v as usize] = least);
        }
        (0..of.len() as u32).map(|v| root(&mut of, v)).collect()
    }

    /// Of every vertex, the longest edge of the elements at it, m.
    pub(crate) fn longest_edges_m(&self) -> Vec<f64> {
        let mut longest = vec![0.0_f64; self.vertices.len()];
        for leaf in self.leaves() {
            let edge_m = self.longest_edge_m(leaf);
            for v in self.nodes[leaf as usize].vertices {
                longest[v as usize] = longest[v as usize].max(edge_m);
            }
        }
        longest
    }

    /// Which vertices elements do not surround.
    pub(crate) fn border_vertices(&self) -> &[bool] {
        &self.on_border
    }

    /// Edges with elements on one side only, in any order. (Where solids touch, elements of both may lie upon each other.)
    pub(crate) fn border_edges(&self) -> Vec<[u32; 2]> {
        let is_border = |(ends, elements): &(&[u32; 2], &Few)| self.is_border(**ends, elements);
        self.edges.par_iter().filter(is_border).map(|(&ends, _)| ends).collect()
    }

    /// Whether these elements on an edge are on one side of it only.
    fn is_border(&self, ends: [u32; 2], elements: &[u32]) -> bool {
        let is_left = |node: &&u32| {
            let (Node { vertices, .. }, Origin { back, .. }) = self.node(**node);
            let runs_along = (0..3).any(|k| [vertices[k], vertices[(k + 1) % 3]] == ends);
            runs_along != back
        };
        let left = elements.iter().filter(is_left).count();
        !elements.is_empty() && (left == 0 || left == elements.len())
    }
}

/// A place that receives light for a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where, on the surface.
    pub point: Point,
    /// Shading normal of the side.
    pub normal: Normal,
    /// The triangle of the scene it lies on.
    pub triangle: u32,
    /// On its back.
    pub back: bool,
}

/// Vertices of the triangles that carry a map, one for all that meet smoothly, and the sides of triangles between them.
fn welded(scene: &Scene) -> (Vec<Vertex>, Vec<([u32; 3], Origin)>) {
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut at: HashMap<[u64; 3], Few, FewNumbers> = HashMap::default();
    let mut weld = |position: Point, normal: Normal| {
        // Adding zero makes one zero of the two.
        let key = [position.x, position.y, position.z].map(|c| (c + 0.0).to_bits());
        let here = at.entry(key).or_default();
        let same = |&&v: &&u32| vertices[v as usize].normal.dot(normal) >= CREASE_COS;
        if let Some(&vertex) = here.iter().find(same) {
            return vertex;
        }
        let vertex = vertices.len() as u32;
        here.push(vertex);
        vertices.push(Vertex { position, normal, parents: None, area_m2: 0.0 });
        vertex
    };
    let mut roots = Vec::new();
    for triangle in 0..scene.triangle_count() {
        for back in [false, true].into_iter().filter(|&back| carries_map(scene, triangle, back)) {
            let corners = corners(scene, triangle, back).map(|(point, normal)| weld(point, normal));
            roots.push((corners, Origin { triangle, back, depth: 0 }));
        }
    }
    (vertices, roots)
}

/// How many corners the sides of triangles have that carry a map: no fewer than vertices.
pub(crate) fn first_corner_count(scene: &Scene) -> usize {
    let sides = (0..scene.triangle_count()).flat_map(|t| [(t, false), (t, true)]);
    3 * sides.filter(|&(triangle, back)| carries_map(scene, triangle, back)).count()
}

/// How many vertices a subdivision has before anything is bisected.
pub(crate) fn first_vertex_count(scene: &Scene) -> usize {
    welded(scene).0.len()
}

/// The ends of an edge, the lower first.
pub(crate) const fn edge_key(a: u32, b: u32) -> [u32; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// Whether a side of a triangle carries a map: opaque, neither a pure mirror nor a pure emitter, not the black back of a
/// one-sided material.
pub fn carries_map(scene: &Scene, triangle: u32, back: bool) -> bool {
    scene.material(triangle).finish(back).is_some_and(|finish| {
        let shows_none = finish.is_pure_mirror() || finish.is_pure_emitter();
        !(shows_none || back && *finish == Finish::BLACK)
    })
}

fn corners(scene: &Scene, triangle: u32, back: bool) -> [(Point, Normal); 3] {
    let points = scene.triangle(triangle).corners;
    let flat = scene.geometric_normal(triangle);
    let normals = scene.corner_normals(triangle).unwrap_or([flat; 3]);
    [0, 1, 2].map(|k| (points[k], if back { -normals[k] } else { normals[k] }))
}
