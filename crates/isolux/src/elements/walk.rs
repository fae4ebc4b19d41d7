//! The way down the trees of bisections, as short as it can be: every ray that ends on a surface takes it.

/// What stands for a node that is not split.
const LEAF: u32 = u32::MAX;

/// There are fewer nodes: first children have 30 bits, of which the greatest number is that of a leaf.
pub(super) const MOST_NODES: usize = (LEAF >> 2) as usize;

/// Weights are counted in this many parts of one: sums and differences of them are exact.
const ONE: i64 = 1 << 60;

/// How nodes are split, 4 bytes a node, so that many stay close to the processor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Walk {
    /// Of every node the first child, and in the two lowest bits the edge that is bisected.
    splits: Vec<u32>,
}

impl Walk {
    /// Of every node the edge that is bisected and the first child, none of leaves.
    pub(super) fn new(splits: impl ExactSizeIterator<Item = Option<(u8, u32)>>) -> Self {
        assert!(splits.len() < MOST_NODES, "more elements than can be counted");
        let packed = |split: Option<(u8, u32)>| {
            split.map_or(LEAF, |(edge, first_child)| first_child << 2 | u32::from(edge))
        };
        Self { splits: splits.map(packed).collect() }
    }

    /// From a place further down the tree, as if nodes from number `level` on did not exist. Without branches but for the end:
    /// nobody can foretell which child it is.
    #[inline]
    pub(super) fn down(&self, place: Place, level: u32) -> Place {
        let [mut x, mut y, mut z] = place.parts;
        let level = level.min(MOST_NODES as u32);
        let mut node = place.node;
        loop {
            let split = self.splits[node as usize];
            let first_child = split >> 2;
            // That of a leaf is above all levels.
            if first_child >= level {
                break;
            }
            let is_edge = |k: u32| -i64::from(split & 3 == k);
            let (xy, yz, zx) = (is_edge(0), is_edge(1), is_edge(2));
            let from = (x & xy) | (y & yz) | (z & zx);
            let to = (y & xy) | (z & yz) | (x & zx);
            // On the edge the middle has twice the smaller weight, and takes the place of that end.
            let difference = from - to;
            let is_second = difference >> 63;
            let smaller = to + (difference & is_second);
            let moved = (smaller ^ is_second) - is_second;
            x += (moved & zx) - (moved & xy);
            y += (moved & xy) - (moved & yz);
            z += (moved & yz) - (moved & zx);
            node = first_child + (is_second & 1) as u32;
        }
        Place { node, parts: [x, y, z] }
    }
}

/// A place in a node of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    node: u32,
    /// Weights of its vertices.
    parts: [i64; 3],
}

impl Place {
    /// In a root, at barycentric weights `(1 - u - v, u, v)`.
    #[inline]
    pub(super) fn in_root(root: u32, u: f64, v: f64) -> Self {
        // What rounding puts outside is on the border.
        let parts = |weight: f64, most: i64| ((weight * ONE as f64) as i64).clamp(0, most);
        let y = parts(u, ONE);
        let z = parts(v, ONE - y);
        Self { node: root, parts: [ONE - y - z, y, z] }
    }

    /// The node.
    pub(crate) const fn node(self) -> u32 {
        self.node
    }

    /// Weights of its vertices.
    #[inline]
    pub(super) fn weights(self) -> [f64; 3] {
        self.parts.map(|parts| parts as f64 / ONE as f64)
    }
}
