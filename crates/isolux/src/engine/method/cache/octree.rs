//! Samples by place: an octree in which each lies as deep as its reach allows.
//!
//! As of Ward, Rubinstein, Clear (1988, "A ray tracing solution for diffuse interreflection"): a sample
//! is kept in all cells that its reach touches, of the depth whose cells are about as large as it, so
//! that a place finds all that may reach it on the one way down to it.

use isolux_geometry::Point;

/// Halvings of the root at most: cells of a millionth of the scene.
const MAX_DEPTH: u32 = 20;

/// A cube of space.
#[derive(Clone, Copy, Debug)]
struct Cell {
    centre: Point,
    half_m: f64,
}

#[derive(Clone, Debug, Default)]
struct Node {
    /// Numbers of the children, 0 for none: the root is nobody's child.
    children: [u32; 8],
    /// Samples, in the order in which they came.
    samples: Vec<u32>,
}

/// Samples by place.
#[derive(Clone, Debug)]
pub(super) struct Octree {
    root: Cell,
    nodes: Vec<Node>,
}

impl Octree {
    /// Over a box, a little enlarged.
    pub(super) fn over((low, high): (Point, Point)) -> Self {
        let extent = high - low;
        let half_m = 0.51 * extent.x.max(extent.y).max(extent.z).max(f64::MIN_POSITIVE);
        let root = Cell { centre: low.lerp(high, 0.5), half_m };
        Self { root, nodes: vec![Node::default()] }
    }

    /// Adds a sample that reaches so far.
    pub(super) fn insert(&mut self, sample: u32, at: Point, reach_m: f64) {
        self.insert_below(0, self.root, (sample, at, reach_m), 0);
    }

    fn insert_below(
        &mut self,
        node: u32,
        cell: Cell,
        (sample, at, reach_m): (u32, Point, f64),
        depth: u32,
    ) {
        if reach_m >= 0.5 * cell.half_m || depth >= MAX_DEPTH {
            self.nodes[node as usize].samples.push(sample);
            return;
        }
        for octant in 0..8 {
            let part = cell.octant(octant);
            if !part.is_touched(at, reach_m) {
                continue;
            }
            let mut child = self.nodes[node as usize].children[octant];
            if child == 0 {
                child = self.nodes.len() as u32;
                self.nodes.push(Node::default());
                self.nodes[node as usize].children[octant] = child;
            }
            self.insert_below(child, part, (sample, at, reach_m), depth + 1);
        }
    }

    /// Visits all samples that may reach a place, always in the same order.
    pub(super) fn visit(&self, at: Point, mut visit: impl FnMut(u32)) {
        let (mut node, mut cell) = (&self.nodes[0], self.root);
        loop {
            node.samples.iter().for_each(|&sample| visit(sample));
            let octant = cell.octant_of(at);
            match node.children[octant] {
                0 => return,
                child => (node, cell) = (&self.nodes[child as usize], cell.octant(octant)),
            }
        }
    }
}

impl Cell {
    fn octant(&self, octant: usize) -> Self {
        let half_m = 0.5 * self.half_m;
        let shift = |bit: usize| if octant & bit == 0 { -half_m } else { half_m };
        let Point { x, y, z } = self.centre;
        Self { centre: Point::new(x + shift(1), y + shift(2), z + shift(4)), half_m }
    }

    fn octant_of(&self, at: Point) -> usize {
        let above = |a: f64, middle: f64, bit: usize| if a < middle { 0 } else { bit };
        above(at.x, self.centre.x, 1)
            | above(at.y, self.centre.y, 2)
            | above(at.z, self.centre.z, 4)
    }

    fn is_touched(&self, at: Point, reach_m: f64) -> bool {
        let near = |a: f64, middle: f64| (a - middle).abs() <= self.half_m + reach_m;
        near(at.x, self.centre.x) && near(at.y, self.centre.y) && near(at.z, self.centre.z)
    }
}
