//! An octree of samples, in which the depth of a sample depends on its reach.
//!
//! The structure follows Ward, Rubinstein, Clear (1988, "A ray tracing solution for diffuse
//! interreflection"). A sample is stored in all cells that its reach touches, at the depth where cells are
//! about as large as the reach. So a place finds all samples that may reach it on one way down.

use isolux_geometry::Point;

/// The largest depth: cells of a millionth of the scene.
const MAX_DEPTH: u32 = 20;

/// A cube of space.
#[derive(Clone, Copy, Debug)]
struct Cell {
    centre: Point,
    half_m: f64,
}

#[derive(Clone, Debug, Default)]
struct Node {
    /// The numbers of the children; 0 for none, since the root is not a child.
    children: [u32; 8],
    /// The samples, in order of insertion.
    samples: Vec<u32>,
}

/// A sample with its reach.
#[derive(Clone, Copy, Debug)]
struct Reach {
    sample: u32,
    at: Point,
    /// The distance up to which it serves places, m.
    reach_m: f64,
}

/// An octree of samples.
#[derive(Clone, Debug)]
pub(super) struct Octree {
    root: Cell,
    nodes: Vec<Node>,
}

impl Octree {
    /// An empty octree over a box, slightly enlarged.
    pub(super) fn over((low, high): (Point, Point)) -> Self {
        let extent = high - low;
        let half_m = 0.51 * extent.x.max(extent.y).max(extent.z).max(f64::MIN_POSITIVE);
        let root = Cell { centre: low.lerp(high, 0.5), half_m };
        Self { root, nodes: vec![Node::default()] }
    }

    /// Adds a sample with its reach.
    pub(super) fn insert(&mut self, sample: u32, at: Point, reach_m: f64) {
        self.insert_below(0, self.root, Reach { sample, at, reach_m }, 0);
    }

    fn insert_below(&mut self, node: u32, cell: Cell, added: Reach, depth: u32) {
        if added.reach_m >= 0.5 * cell.half_m || depth >= MAX_DEPTH {
            self.nodes[node as usize].samples.push(added.sample);
            return;
        }
        for octant in 0..8 {
            let part = cell.octant(octant);
            if !part.is_touched(added.at, added.reach_m) {
                continue;
            }
            let mut child = self.nodes[node as usize].children[octant];
            if child == 0 {
                child = self.nodes.len() as u32;
                self.nodes.push(Node::default());
                self.nodes[node as usize].children[octant] = child;
            }
            self.insert_below(child, part, added, depth + 1);
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
