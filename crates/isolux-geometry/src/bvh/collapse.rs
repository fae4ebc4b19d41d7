//! From the binary hierarchy to the wide tree, at the least expected cost.
//!
//! Which descendants become the children of a wide node, and which subtrees become leaves, is
//! decided by dynamic programming over the binary nodes (Ylitie, Karras, Laine 2017, "Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3), over the least cost
//! of what lies below a binary node when at most so many wide children may stand for it.

use super::bounds::Bounds;
use super::build::BinaryNode;
use super::wide::{Block, Node, Reference, WIDTH, WideTree};

/// Cost of testing a block of triangles, in tests of a node.
const BLOCK_COST: f32 = 1.0;

/// Collapses the binary hierarchy. `block_of` fills a block from up to eight triangles.
pub(super) fn collapse(binary: &[BinaryNode], block_of: impl Fn(&[u32]) -> Block) -> WideTree {
    let Some(top) = binary.first() else { return WideTree::default() };
    let mut emit = Emit { forests: Forests::new(binary), block_of, tree: WideTree::default() };
    emit.tree.reach = top.bounds.reach();
    emit.tree.root = Some(emit.subtree(0));
    emit.tree
}

/// The least costs, and what attains them.
struct Forests<'a> {
    binary: &'a [BinaryNode],
    /// `cost[n][i - 1]` for at most `i` wide children in place of node `n`.
    cost: Vec<[f32; WIDTH - 1]>,
}

impl<'a> Forests<'a> {
    fn new(binary: &'a [BinaryNode]) -> Self {
        let mut forests = Self { binary, cost: vec![[0.0; WIDTH - 1]; binary.len()] };
        // Children stand behind their parents.
        for index in (0..binary.len()).rev() {
            forests.cost[index] = forests.costs_at(index);
        }
        forests
    }

    fn costs_at(&self, index: usize) -> [f32; WIDTH - 1] {
        let leaf = self.leaf_cost(index);
        let Some(children) = self.binary[index].children(index) else {
            return [leaf; WIDTH - 1];
        };
        let mut costs = [leaf.min(self.node_cost(index, children)); WIDTH - 1];
        for places in 2..WIDTH {
            costs[places - 1] = costs[places - 2].min(self.share(children, places).0);
        }
        costs
    }

    fn leaf_cost(&self, index: usize) -> f32 {
        let node = &self.binary[index];
        let blocks = node.count.div_ceil(WIDTH as u32);
        if blocks as usize > Reference::MAX_BLOCKS {
            return f32::INFINITY;
        }
        node.bounds.half_area() * blocks as f32 * BLOCK_COST
    }

    fn node_cost(&self, index: usize, children: [usize; 2]) -> f32 {
        self.binary[index].bounds.half_area() + self.share(children, WIDTH).0
    }

    /// How best to share `places` between two siblings: the cost and the places of the first.
    fn share(&self, [first, second]: [usize; 2], places: usize) -> (f32, usize) {
        let cost = |k: usize| self.cost[first][k - 1] + self.cost[second][places - k - 1];
        (1..places)
            .map(|k| (cost(k), k))
            .fold((f32::INFINITY, 1), |best, next| if next.0 < best.0 { next } else { best })
    }

    /// Whether a leaf is the cheapest for node `index`.
    fn is_leaf(&self, index: usize) -> bool {
        match self.binary[index].children(index) {
            Some(children) => self.leaf_cost(index) <= self.node_cost(index, children),
            None => true,
        }
    }

    /// The binary nodes that take the place of node `index` among at most `places` wide children.
    fn roots(&self, index: usize, places: usize, roots: &mut Vec<usize>) {
        match self.binary[index].children(index) {
            Some(children) if places > 1 => {
                let (cost, first) = self.share(children, places);
                if cost < self.cost[index][places - 2] {
                    self.roots(children[0], first, roots);
                    self.roots(children[1], places - first, roots);
                } else {
                    self.roots(index, places - 1, roots);
                }
            }
            _ => roots.push(index),
        }
    }

    /// The binary nodes that become the children of a wide node in place of `index`.
    fn wide_children(&self, children: [usize; 2]) -> Vec<usize> {
        let (_, first) = self.share(children, WIDTH);
        let mut roots = Vec::with_capacity(WIDTH);
        self.roots(children[0], first, &mut roots);
        self.roots(children[1], WIDTH - first, &mut roots);
        roots
    }
}

/// Writes the wide tree, depth first, so that what a ray visits in turn lies close together.
struct Emit<'a, F> {
    forests: Forests<'a>,
    block_of: F,
    tree: WideTree,
}

impl<F: Fn(&[u32]) -> Block> Emit<'_, F> {
    /// Recursion is bounded by the depth of the binary hierarchy.
    fn subtree(&mut self, index: usize) -> Reference {
        match self.forests.binary[index].children(index) {
            Some(children) if !self.forests.is_leaf(index) => self.node(children),
            _ => self.leaf(index),
        }
    }

    fn node(&mut self, children: [usize; 2]) -> Reference {
        let place = self.tree.nodes.len();
        self.tree.nodes.push(Node::EMPTY);
        for (lane, child) in self.forests.wide_children(children).into_iter().enumerate() {
            let reference = self.subtree(child);
            let bounds = self.forests.binary[child].bounds;
            self.tree.nodes[place].set_child(lane, &bounds, reference);
        }
        Reference::node(place)
    }

    fn leaf(&mut self, index: usize) -> Reference {
        // A subtree over n triangles fills 2 n - 1 consecutive nodes.
        let size = 2 * self.forests.binary[index].count as usize - 1;
        let below = &self.forests.binary[index..index + size];
        let mut triangles: Vec<u32> =
            below.iter().filter(|node| node.count == 1).map(BinaryNode::triangle).collect();
        triangles.sort_unstable();
        let first = self.tree.blocks.len();
        self.tree.blocks.extend(triangles.chunks(WIDTH).map(&self.block_of));
        Reference::leaf(first, self.tree.blocks.len() - first)
    }
}

impl Node {
    fn set_child(&mut self, lane: usize, bounds: &Bounds, child: Reference) {
        for axis in 0..3 {
            self.planes[2 * axis][lane] = bounds.low[axis];
            self.planes[2 * axis + 1][lane] = bounds.high[axis];
        }
        self.children[lane] = child;
    }
}
