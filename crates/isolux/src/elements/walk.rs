//! The way down the trees of bisections, as short as it can be: every ray that ends on a surface takes it.

/// There are fewer nodes: first children have 30 bits, of which the greatest number stands for that of a leaf.
pub(super) const MOST_NODES: usize = (u32::MAX >> 2) as usize;

/// Weights are counted in this many parts of one: sums and differences of them are exact.
const ONE: i64 = 1 << 60;

/// How nodes are split, 4 bytes a node, so that many stay close to the processor.
///
/// Weights are kept in turned order: the edge that a node is bisected at leads from the first to the second. Mostly the next
/// edge is that opposite to the new vertex, and the turn from one order to the next always the same.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Walk {
    /// Of every node the first child, and in the two lowest bits by how much its order is turned from that of the node that it
    /// is a child of, or of its vertices if it is a root.
    splits: Vec<u32>,
}

impl Walk {
    /// Of every node the edge that is bisected and the first child, none of leaves.
    pub(super) fn new(splits: impl ExactSizeIterator<Item = Option<(u8, u32)>>) -> Self {
        assert!(splits.len() < MOST_NODES, "more elements than can be counted");
        let splits: Vec<Option<(u8, u32)>> = splits.collect();
        let edge = |node: usize| splits[node].map_or(0, |(edge, _)| u32::from(edge));
        let first_child = |node: usize| splits[node].map_or(MOST_NODES as u32, |(_, first)| first);
        let packed = |node: usize, turn: u32| first_child(node) << 2 | turn;
        let mut walk: Vec<u32> = (0..splits.len()).map(|node| packed(node, edge(node))).collect();
        for (node, split) in splits.iter().enumerate() {
            let Some((_, first)) = *split else { continue };
            for child in [first as usize, first as usize + 1] {
                walk[child] = packed(child, (edge(child) + 3 - edge(node)) % 3);
            }
        }
        Self { splits: walk }
    }

    /// The place in a root, at barycentric weights `(1 - u - v, u, v)`.
    #[inline]
    pub(super) fn in_root(&self, root: u32, u: f64, v: f64) -> Place {
        // What rounding puts outside is on the border.
        let parts = |weight: f64, most: i64| ((weight * ONE as f64) as i64).clamp(0, most);
        let y = parts(u, ONE);
        let z = parts(v, ONE - y);
        let turn = self.splits[root as usize] & 3;
        Place { node: root, parts: turned([ONE - y - z, y, z], turn) }
    }

    /// From a place further down the tree, as if nodes from number `level` on did not exist. Without branches but for the end
    /// and for unusual turns: nobody can foretell which child it is.
    #[inline]
    pub(super) fn down(&self, place: Place, level: u32) -> Place {
        let level = level.min(MOST_NODES as u32);
        let Place { mut node, mut parts } = place;
        let mut split = self.splits[node as usize];
        // First children of leaves are above all levels.
        while split >> 2 < level {
            let [from, to, apex] = parts;
            // On the edge the middle has twice the smaller weight, and takes the place of that end.
            let difference = from - to;
            let is_second = difference >> 63;
            let kept = difference.abs();
            let middle = from + to - kept;
            node = (split >> 2) + (is_second & 1) as u32;
            split = self.splits[node as usize];
            let turn = split & 3;
            parts = if i64::from(turn) == 2 + is_second {
                let other = (kept ^ apex) & is_second;
                [apex ^ other, kept ^ other, middle]
            } else {
                let other = (kept ^ middle) & is_second;
                turned([kept ^ other, middle ^ other, apex], turn)
            };
        }
        Place { node, parts }
    }
}

/// Weights in an order turned by so many.
const fn turned([x, y, z]: [i64; 3], turn: u32) -> [i64; 3] {
    match turn {
        0 => [x, y, z],
        1 => [y, z, x],
        _ => [z, x, y],
    }
}

/// A place in a node of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    node: u32,
    /// Weights of its vertices, from the first end of the edge that is bisected on.
    parts: [i64; 3],
}

impl Place {
    /// The node.
    pub(crate) const fn node(self) -> u32 {
        self.node
    }

    /// Weights of its vertices, if it is bisected at this edge; of a leaf, at the first.
    #[inline]
    pub(super) fn weights(self, edge: u8) -> [f64; 3] {
        turned(self.parts, (3 - u32::from(edge)) % 3).map(|parts| parts as f64 / ONE as f64)
    }
}
