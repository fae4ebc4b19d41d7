//! The binary hierarchy: split where the surface area heuristic, over bins, costs least.
//!
//! After Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies". A subtree over
//! `n` triangles fills exactly `2 n - 1` consecutive nodes, so halves are built in parallel in
//! place and the result does not depend on the number of threads.

use super::bounds::Bounds;

/// Bins along each axis.
const BINS: usize = 32;

/// From this many triangles on, both halves are built at the same time.
const PARALLEL: usize = 4096;

/// Greatest number of nodes on a path from the root to a leaf, less one: bounds all recursion.
pub(super) const MAX_DEPTH: u32 = 34;

/// Greatest number of triangles: more could not keep to [`MAX_DEPTH`] and to the bits of a
/// reference in the wide tree.
pub(super) const MAX_TRIANGLES: usize = 1 << 28;

/// A triangle to build over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Primitive {
    pub(super) bounds: Bounds,
    pub(super) triangle: u32,
}

/// A node of the binary hierarchy. The first child of an inner node follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BinaryNode {
    pub(super) bounds: Bounds,
    /// Number of triangles below; one for a leaf.
    pub(super) count: u32,
    /// Leaf: its triangle. Inner node: how far behind it its second child lies.
    link: u32,
}

impl BinaryNode {
    const UNBUILT: Self = Self { bounds: Bounds::EMPTY, count: 0, link: 0 };

    /// The children of the inner node that stands at `index`; `None` for a leaf.
    #[inline]
    pub(super) fn children(&self, index: usize) -> Option<[usize; 2]> {
        (self.count > 1).then(|| [index + 1, index + self.link as usize])
    }

    /// The triangle of a leaf.
    #[inline]
    pub(super) fn triangle(&self) -> u32 {
        self.link
    }
}

/// The hierarchy over the primitives, root first; empty for none of them.
pub(super) fn build(mut primitives: Vec<Primitive>) -> Vec<BinaryNode> {
    let mut nodes = vec![BinaryNode::UNBUILT; (2 * primitives.len()).saturating_sub(1)];
    if !nodes.is_empty() {
        fill(&mut nodes, &mut primitives, 0);
    }
    nodes
}

fn fill(nodes: &mut [BinaryNode], primitives: &mut [Primitive], depth: u32) {
    let count = primitives.len();
    let Some((node, below)) = nodes.split_first_mut() else { return };
    node.count = count as u32;
    if let [only] = primitives {
        node.bounds = only.bounds;
        node.link = only.triangle;
        return;
    }
    let (bounds, middle) = split(primitives, MAX_DEPTH - depth);
    node.bounds = bounds;
    node.link = 2 * middle as u32;
    let (first, second) = primitives.split_at_mut(middle);
    let (first_nodes, second_nodes) = below.split_at_mut(2 * middle - 1);
    let mut fill_first = || fill(first_nodes, first, depth + 1);
    let mut fill_second = || fill(second_nodes, second, depth + 1);
    if count < PARALLEL {
        fill_first();
        fill_second();
    } else {
        rayon::join(fill_first, fill_second);
    }
}

/// Orders the primitives so that those of the first child come before `middle`, which is returned
/// with the bounds of all.
fn split(primitives: &mut [Primitive], levels_left: u32) -> (Bounds, usize) {
    let (mut bounds, mut centres) = (Bounds::EMPTY, Bounds::EMPTY);
    for primitive in primitives.iter() {
        bounds = bounds.union(primitive.bounds);
        let centre = primitive.bounds.centre_doubled();
        centres = centres.union(Bounds { low: centre, high: centre });
    }
    let count = primitives.len();
    // Once a level is lost to an uneven split, halving must still end in time.
    let must_halve = ceil_log2(count) >= levels_left;
    let middle = if must_halve {
        halve(primitives, &centres)
    } else {
        match cheapest_plane(primitives, &centres) {
            Some(plane) => partition(primitives, |p| plane.is_first(p)),
            None => count / 2,
        }
    };
    (bounds, middle)
}

fn ceil_log2(count: usize) -> u32 {
    usize::BITS - (count - 1).leading_zeros()
}

/// Halves by number across the longest axis of the centres.
fn halve(primitives: &mut [Primitive], centres: &Bounds) -> usize {
    let extent = |axis: usize| centres.high[axis] - centres.low[axis];
    let axis = (1..3).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best });
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| {
        let key = |p: &Primitive| p.bounds.centre_doubled()[axis];
        key(a).total_cmp(&key(b)).then(a.triangle.cmp(&b.triangle))
    });
    middle
}

/// Moves those of the first kind to the front and returns their number.
fn partition(primitives: &mut [Primitive], is_first: impl Fn(&Primitive) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..primitives.len() {
        if is_first(&primitives[i]) {
            primitives.swap(i, middle);
            middle += 1;
        }
    }
    middle
}

/// How centres are sorted into bins along one axis.
#[derive(Clone, Copy)]
struct Axis {
    axis: usize,
    low: f32,
    bins_per_metre: f32,
}

impl Axis {
    /// `None` where all centres coincide along the axis.
    fn new(axis: usize, centres: &Bounds) -> Option<Self> {
        let (low, high) = (centres.low[axis], centres.high[axis]);
        // Short of the whole number of bins by more than the roundings of `bin`.
        let bins_per_metre = BINS as f32 * (1.0 - 8.0 * f32::EPSILON) / (high - low);
        (high > low && bins_per_metre.is_finite()).then_some(Self { axis, low, bins_per_metre })
    }

    #[inline(always)]
    fn bin(&self, primitive: &Primitive) -> usize {
        let centre = primitive.bounds.low[self.axis] + primitive.bounds.high[self.axis];
        (((centre - self.low) * self.bins_per_metre) as usize).min(BINS - 1)
    }
}

/// A plane between two bins.
struct Plane {
    axis: Axis,
    first_bins: usize,
    cost: f32,
}

impl Plane {
    #[inline(always)]
    fn is_first(&self, primitive: &Primitive) -> bool {
        self.axis.bin(primitive) < self.first_bins
    }
}

/// The plane with the least sum of area times number on both sides; `None` where all centres
/// coincide.
fn cheapest_plane(primitives: &[Primitive], centres: &Bounds) -> Option<Plane> {
    let mut cheapest: Option<Plane> = None;
    for axis in (0..3).filter_map(|axis| Axis::new(axis, centres)) {
        let bins = Bins::of(primitives, &axis);
        for (first_bins, cost) in bins.costs() {
            if cheapest.as_ref().is_none_or(|best| cost < best.cost) {
                cheapest = Some(Plane { axis, first_bins, cost });
            }
        }
    }
    cheapest
}

struct Bins([(u32, Bounds); BINS]);

impl Bins {
    fn of(primitives: &[Primitive], axis: &Axis) -> Self {
        let mut bins = [(0, Bounds::EMPTY); BINS];
        for primitive in primitives {
            let (count, bounds) = &mut bins[axis.bin(primitive)];
            *count += 1;
            *bounds = bounds.union(primitive.bounds);
        }
        Self(bins)
    }

    /// For each plane with something on both sides, how many bins lie before it and what it costs.
    fn costs(&self) -> impl Iterator<Item = (usize, f32)> {
        let mut second = [(0.0_f32, 0_u32); BINS];
        let (mut count, mut bounds) = (0, Bounds::EMPTY);
        for bin in (1..BINS).rev() {
            count += self.0[bin].0;
            bounds = bounds.union(self.0[bin].1);
            second[bin] = (bounds.half_area() * count as f32, count);
        }
        let (mut count, mut bounds) = (0, Bounds::EMPTY);
        (1..BINS).filter_map(move |bin| {
            count += self.0[bin - 1].0;
            bounds = bounds.union(self.0[bin - 1].1);
            let (second_cost, second_count) = second[bin];
            (count > 0 && second_count > 0)
                .then(|| (bin, bounds.half_area() * count as f32 + second_cost))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{BinaryNode, Bounds, MAX_DEPTH, Primitive, build};

    /// Boxes along a spiral, of sizes that differ by orders of magnitude.
    fn primitives(count: u32, growth: f32) -> Vec<Primitive> {
        let primitive = |triangle: u32| {
            let k = triangle as f32;
            let size = growth.powf(k);
            let low = [size * (0.1 * k).cos(), size * (0.1 * k).sin(), k % 7.0];
            let bounds = Bounds { low, high: low.map(|x| x + 0.1 * size) };
            Primitive { bounds, triangle }
        };
        (0..count).map(primitive).collect()
    }

    fn depth(nodes: &[BinaryNode], index: usize) -> u32 {
        let below = nodes[index].children(index);
        below.map_or(0, |children| {
            1 + children.map(|child| depth(nodes, child)).into_iter().max().unwrap()
        })
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let with_threads = |count: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
            pool.install(|| build(primitives(20_000, 1.0001)))
        };
        let one = with_threads(1);
        assert_eq!(one.len(), 39_999);
        assert_eq!(one, with_threads(4));
    }

    #[test]
    fn every_triangle_has_one_leaf_and_the_depth_is_bounded() {
        for (count, growth) in [(1, 1.0), (2, 1.0), (1000, 1.0), (2000, 1.01), (6000, 0.99)] {
            let nodes = build(primitives(count, growth));
            let leaves = nodes.iter().filter(|node| node.count == 1);
            let mut triangles: Vec<u32> = leaves.map(BinaryNode::triangle).collect();
            triangles.sort_unstable();
            assert!(triangles.into_iter().eq(0..count));
            assert!(depth(&nodes, 0) <= MAX_DEPTH, "{count} {growth}");
        }
        assert!(build(Vec::new()).is_empty());
    }
}
