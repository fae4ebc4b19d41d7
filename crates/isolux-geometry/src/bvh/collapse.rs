//! From the binary hierarchy to the wide tree, at the least expected cost.
//!
//! Which descendants become the children of a wide node, and which subtrees become leaves, is
//! decided by dynamic programming over the binary nodes (Ylitie, Karras, Laine 2017, "Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3), over the least cost
//! of what lies below a binary node when at most so many wide children may stand for it. Where time
//! and memory count for more, the child with the largest box is opened until there are enough.

use super::bounds::Bounds;
use super::build::{BinaryNode, PARALLEL, Preset};
use super::wide::{Builder, Labelled, MAX_LEAF, Node, Reference, TooLarge, WideTree};

/// Cost of testing as many triangles as there are lanes, in tests of a node.
const TRIANGLES_COST: f32 = 1.0;

/// Collapses the binary hierarchy; `triangle` gives what a leaf holds.
pub(super) fn collapse<const W: usize>(
    preset: Preset,
    binary: &[BinaryNode],
    triangle: impl Fn(u32) -> Labelled,
) -> Result<WideTree<W>, TooLarge> {
    match preset {
        Preset::Fast => emit(binary, Largest::<W>(binary), triangle),
        Preset::Medium => emit(binary, Forests::<W>::new(binary), triangle),
    }
}

fn emit<const W: usize>(
    binary: &[BinaryNode],
    plan: impl Plan,
    triangle: impl Fn(u32) -> Labelled,
) -> Result<WideTree<W>, TooLarge> {
    let Some(top) = binary.first() else {
        return Ok(Builder::default().finish(None, Bounds::EMPTY));
    };
    let mut emit = Emit { binary, plan, triangle, builder: Builder::default() };
    let root = emit.subtree(0)?;
    Ok(emit.builder.finish(Some(root), top.bounds))
}

/// What becomes of binary nodes.
trait Plan {
    /// Whether node `index`, which has children, becomes a leaf.
    fn is_leaf(&self, index: usize) -> bool;

    /// The binary nodes that become the children of a wide node in place of one with the given
    /// children.
    fn wide_children(&self, children: [usize; 2]) -> Vec<usize>;
}

/// Opens the child with the largest box.
struct Largest<'a, const W: usize>(&'a [BinaryNode]);

impl<const W: usize> Plan for Largest<'_, W> {
    fn is_leaf(&self, index: usize) -> bool {
        self.0[index].count as usize <= W.min(MAX_LEAF)
    }

    fn wide_children(&self, children: [usize; 2]) -> Vec<usize> {
        let mut wide = children.to_vec();
        while wide.len() < W {
            let opened = wide.iter().enumerate().filter(|(_, node)| !self.is_leaf(**node));
            let area = |node: usize| self.0[node].bounds.half_area();
            let largest = opened.max_by(|a, b| area(*a.1).total_cmp(&area(*b.1)));
            let Some((place, below)) =
                largest.and_then(|(place, &node)| Some((place, self.0[node].children(node)?)))
            else {
                break;
            };
            wide[place] = below[0];
            wide.push(below[1]);
        }
        wide
    }
}

/// The least costs, and what attains them.
struct Forests<'a, const W: usize> {
    binary: &'a [BinaryNode],
    /// `cost[n][i]` for at most `i` wide children in place of node `n`; none for `i` = 0.
    cost: Vec<[f32; W]>,
}

impl<'a, const W: usize> Forests<'a, W> {
    fn new(binary: &'a [BinaryNode]) -> Self {
        let mut cost = vec![[0.0; W]; binary.len()];
        fill_costs(binary, &mut cost);
        Self { binary, cost }
    }

    /// How best to share `places` between two siblings: the cost and the places of the first.
    fn share(&self, [first, second]: [usize; 2], places: usize) -> (f32, usize) {
        let cost = |k: usize| self.cost[first][k] + self.cost[second][places - k];
        (1..places)
            .map(|k| (cost(k), k))
            .fold((f32::INFINITY, 1), |best, next| if next.0 < best.0 { next } else { best })
    }

    /// The binary nodes that take the place of node `index` among at most `places` wide children.
    fn roots(&self, index: usize, places: usize, roots: &mut Vec<usize>) {
        match self.binary[index].children(index) {
            Some(children) if places > 1 => {
                let (cost, first) = self.share(children, places);
                if cost < self.cost[index][places - 1] {
                    self.roots(children[0], first, roots);
                    self.roots(children[1], places - first, roots);
                } else {
                    self.roots(index, places - 1, roots);
                }
            }
            _ => roots.push(index),
        }
    }
}

impl<const W: usize> Plan for Forests<'_, W> {
    fn is_leaf(&self, index: usize) -> bool {
        self.binary[index].children(index).is_none_or(|children| {
            let node = self.binary[index].bounds.half_area() + self.share(children, W).0;
            leaf_cost::<W>(&self.binary[index]) <= node
        })
    }

    fn wide_children(&self, children: [usize; 2]) -> Vec<usize> {
        let (_, first) = self.share(children, W);
        let mut roots = Vec::with_capacity(W);
        self.roots(children[0], first, &mut roots);
        self.roots(children[1], W - first, &mut roots);
        roots
    }
}

/// Fills in the costs at a node and below; both are slices over its subtree.
fn fill_costs<const W: usize>(binary: &[BinaryNode], cost: &mut [[f32; W]]) {
    let (Some(node), Some((here, below))) = (binary.first(), cost.split_first_mut()) else {
        return;
    };
    let leaf = leaf_cost::<W>(node);
    let Some([first, second]) = node.children(0) else {
        *here = [leaf; W];
        return;
    };
    let (first_costs, second_costs) = below.split_at_mut(second - first);
    let mut fill_first = || fill_costs(&binary[first..second], first_costs);
    let mut fill_second = || fill_costs(&binary[second..], second_costs);
    if (node.count as usize) < PARALLEL {
        fill_first();
        fill_second();
    } else {
        rayon::join(fill_first, fill_second);
    }
    *here = costs_over(node.bounds.half_area(), leaf, &first_costs[0], &second_costs[0]);
}

/// The costs at an inner node of the given area, from the cost of a leaf in its place and the costs
/// at its children.
fn costs_over<const W: usize>(
    half_area: f32,
    leaf: f32,
    first: &[f32; W],
    second: &[f32; W],
) -> [f32; W] {
    // Of each number of places, shared in the best way; all of them are for a node of its own.
    let mut shared = [f32::INFINITY; W];
    let mut all_places = f32::INFINITY;
    for k in 1..W {
        for places in k + 1..W {
            shared[places] = shared[places].min(first[k] + second[places - k]);
        }
        all_places = all_places.min(first[k] + second[W - k]);
    }
    let mut least = leaf.min(half_area + all_places);
    shared[0] = least;
    for cost in &mut shared[1..] {
        least = least.min(*cost);
        *cost = least;
    }
    shared
}

fn leaf_cost<const W: usize>(node: &BinaryNode) -> f32 {
    if node.count as usize > MAX_LEAF {
        return f32::INFINITY;
    }
    let steps = node.count.div_ceil(W as u32);
    node.bounds.half_area() * steps as f32 * TRIANGLES_COST
}

/// Writes the wide tree, depth first, so that what a ray visits in turn lies close together.
struct Emit<'a, P, F, const W: usize> {
    binary: &'a [BinaryNode],
    plan: P,
    triangle: F,
    builder: Builder<W>,
}

impl<P: Plan, F: Fn(u32) -> Labelled, const W: usize> Emit<'_, P, F, W> {
    /// Recursion is bounded by the depth of the binary hierarchy.
    fn subtree(&mut self, index: usize) -> Result<Reference, TooLarge> {
        match self.binary[index].children(index) {
            Some(children) if !self.plan.is_leaf(index) => self.node(children),
            _ => self.leaf(index),
        }
    }

    fn node(&mut self, children: [usize; 2]) -> Result<Reference, TooLarge> {
        let reference = self.builder.add_node()?;
        let mut node = Node::EMPTY;
        for (lane, child) in self.plan.wide_children(children).into_iter().enumerate() {
            node.set_child(lane, &self.binary[child].bounds, self.subtree(child)?);
        }
        self.builder.set_node(reference, &node);
        Ok(reference)
    }

    fn leaf(&mut self, index: usize) -> Result<Reference, TooLarge> {
        // A subtree over n triangles fills 2 n - 1 consecutive nodes.
        let size = 2 * self.binary[index].count as usize - 1;
        let below = &self.binary[index..index + size];
        let mut triangles: Vec<u32> =
            below.iter().filter(|node| node.count == 1).map(BinaryNode::triangle).collect();
        triangles.sort_unstable();
        let triangles: Vec<Labelled> = triangles.into_iter().map(&self.triangle).collect();
        self.builder.add_leaf(&triangles)
    }
}

impl<const W: usize> Node<W> {
    fn set_child(&mut self, lane: usize, bounds: &Bounds, child: Reference) {
        for axis in 0..3 {
            self.planes[2 * axis][lane] = bounds.low[axis];
            self.planes[2 * axis + 1][lane] = bounds.high[axis];
        }
        self.children[lane] = child;
    }
}
