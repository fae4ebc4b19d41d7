//! The binary hierarchy: split where the surface area heuristic costs least.
//!
//! After Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies": over bins where
//! triangles are many, over all places where they are few. A subtree over `n` triangles fills exactly
//! `2 n - 1` consecutive nodes, so halves are built in parallel in place and the result does not
//! depend on the number of threads.

use super::bounds::Bounds;
use super::extent::Extent;
use std::ops::Range;

/// How much work to put into a hierarchy. The answers are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// Half the time and memory for building, rays about a quarter slower.
    Fast,
    /// For all but very large scenes.
    Medium,
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Fast, Self::Medium];

    /// From this many triangles on building takes longer than most scenes are worth.
    const VERY_MANY: usize = 4_000_000;

    /// What suits so many triangles.
    pub fn for_triangles(count: usize) -> Self {
        if count < Self::VERY_MANY { Self::Medium } else { Self::Fast }
    }

    /// Along which axes to look for the cheapest plane.
    fn axes(self, centres: &Extent) -> Range<usize> {
        match self {
            Self::Fast => {
                let axis = longest(centres);
                axis..axis + 1
            }
            Self::Medium => 0..3,
        }
    }
}

/// Bins along each axis.
const BINS: usize = 32;

/// Up to so many triangles, every place to split is tried.
const FEW: usize = 12;

/// From this many triangles on, both halves are built at the same time.
pub(super) const PARALLEL: usize = 4096;

/// Greatest number of nodes on a path from the root to a leaf, less one: bounds all recursion.
pub(super) const MAX_DEPTH: u32 = 34;

/// Greatest number of triangles: more could not keep to [`MAX_DEPTH`] and to the bits of a
/// reference in the wide tree.
pub(super) const MAX_TRIANGLES: usize = 1 << 28;

/// A triangle to build over: its box, and its index in the fourth lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Primitive(Extent);

impl Primitive {
    /// Makes an index a normal number: some processors are slow with those next to zero.
    const NORMAL: u32 = 1 << 30;

    pub(super) fn new(bounds: &Bounds, triangle: u32) -> Self {
        debug_assert!((triangle as usize) < MAX_TRIANGLES);
        Self(Extent::of(bounds, f32::from_bits(triangle | Self::NORMAL)))
    }

    fn triangle(&self) -> u32 {
        self.0.fourth().to_bits() & !Self::NORMAL
    }
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
pub(super) fn build(preset: Preset, mut primitives: Vec<Primitive>) -> Vec<BinaryNode> {
    let mut nodes = vec![BinaryNode::UNBUILT; (2 * primitives.len()).saturating_sub(1)];
    if !nodes.is_empty() {
        let around = Around::of(&primitives);
        fill(preset, &mut nodes, &mut primitives, around, 0);
    }
    nodes
}

/// The box around primitives, and that around their centres, doubled.
#[derive(Clone, Copy)]
struct Around {
    bounds: Extent,
    centres: Extent,
}

impl Around {
    const NOTHING: Self = Self { bounds: Extent::EMPTY, centres: Extent::EMPTY };

    #[inline(always)]
    fn add(&mut self, primitive: &Primitive) {
        self.bounds = self.bounds.union(&primitive.0);
        self.centres = self.centres.with(primitive.0.centre_doubled());
    }

    fn of(primitives: &[Primitive]) -> Self {
        let mut around = Self::NOTHING;
        primitives.iter().for_each(|primitive| around.add(primitive));
        around
    }
}

fn fill(
    preset: Preset,
    nodes: &mut [BinaryNode],
    primitives: &mut [Primitive],
    around: Around,
    depth: u32,
) {
    let count = primitives.len();
    let Some((node, below)) = nodes.split_first_mut() else { return };
    node.bounds = around.bounds.bounds();
    node.count = count as u32;
    if let [only] = primitives {
        node.link = only.triangle();
        return;
    }
    let (middle, halves) = split(preset, primitives, &around.centres, MAX_DEPTH - depth);
    node.link = 2 * middle as u32;
    let (first, second) = primitives.split_at_mut(middle);
    let (first_nodes, second_nodes) = below.split_at_mut(2 * middle - 1);
    let mut fill_first = || fill(preset, first_nodes, first, halves[0], depth + 1);
    let mut fill_second = || fill(preset, second_nodes, second, halves[1], depth + 1);
    if count < PARALLEL {
        fill_first();
        fill_second();
    } else {
        rayon::join(fill_first, fill_second);
    }
}

/// Orders two or more primitives so that those of the first child come before the place returned,
/// with what is around both halves.
fn split(
    preset: Preset,
    primitives: &mut [Primitive],
    centres: &Extent,
    levels_left: u32,
) -> (usize, [Around; 2]) {
    let count = primitives.len();
    // Once a level is lost to an uneven split, halving must still end in time.
    if ceil_log2(count) >= levels_left {
        let middle = halve(primitives, centres);
        return around_halves(primitives, middle);
    }
    if count <= FEW {
        let middle = few::cheapest_order(primitives);
        return around_halves(primitives, middle);
    }
    match Grid::new(centres).cheapest_plane(primitives, preset.axes(centres)) {
        Some(plane) => partition(primitives, |p| plane.is_first(p)),
        None => around_halves(primitives, count / 2),
    }
}

fn around_halves(primitives: &[Primitive], middle: usize) -> (usize, [Around; 2]) {
    (middle, [Around::of(&primitives[..middle]), Around::of(&primitives[middle..])])
}

fn ceil_log2(count: usize) -> u32 {
    usize::BITS - (count - 1).leading_zeros()
}

fn longest(centres: &Extent) -> usize {
    let size = centres.size();
    (1..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best })
}

/// Halves by number across the longest axis of the centres.
fn halve(primitives: &mut [Primitive], centres: &Extent) -> usize {
    let axis = longest(centres);
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| {
        let key = |p: &Primitive| p.0.centre_doubled()[axis];
        key(a).total_cmp(&key(b)).then(a.triangle().cmp(&b.triangle()))
    });
    middle
}

/// Moves those of the first kind to the front.
fn partition(
    primitives: &mut [Primitive],
    is_first: impl Fn(&Primitive) -> bool,
) -> (usize, [Around; 2]) {
    let (mut middle, mut first, mut second) = (0, Around::NOTHING, Around::NOTHING);
    for i in 0..primitives.len() {
        let primitive = primitives[i];
        if is_first(&primitive) {
            first.add(&primitive);
            primitives.swap(i, middle);
            middle += 1;
        } else {
            second.add(&primitive);
        }
    }
    (middle, [first, second])
}

/// How centres are sorted into bins along all axes.
#[derive(Clone, Copy)]
struct Grid {
    low: [f32; 4],
    /// Zero along an axis where all centres coincide.
    bins_per_metre: [f32; 4],
}

impl Grid {
    fn new(centres: &Extent) -> Self {
        // Short of the whole number of bins by more than the roundings of `bins`.
        let per_metre = centres.size().map(|size| BINS as f32 * (1.0 - 8.0 * f32::EPSILON) / size);
        let bins_per_metre = per_metre.map(|x| if x.is_finite() && x > 0.0 { x } else { 0.0 });
        Self { low: centres.low(), bins_per_metre }
    }

    #[inline(always)]
    fn bins(&self, primitive: &Primitive) -> [usize; 4] {
        let centre = primitive.0.centre_doubled();
        std::array::from_fn(|k| {
            (((centre[k] - self.low[k]) * self.bins_per_metre[k]) as i32 as usize).min(BINS - 1)
        })
    }

    /// The plane across one of the axes with the least sum of area times number on both sides; `None`
    /// where all centres coincide.
    fn cheapest_plane(&self, primitives: &[Primitive], axes: Range<usize>) -> Option<Plane> {
        let mut bins = [[(Extent::EMPTY, 0_u32); BINS]; 3];
        for primitive in primitives {
            let places = self.bins(primitive);
            for axis in axes.clone() {
                let (extent, count) = &mut bins[axis][places[axis]];
                *extent = extent.union(&primitive.0);
                *count += 1;
            }
        }
        let mut cheapest: Option<Plane> = None;
        for axis in axes.filter(|&axis| self.bins_per_metre[axis] > 0.0) {
            for (first_bins, cost) in costs(&bins[axis]) {
                if cheapest.as_ref().is_none_or(|best| cost < best.cost) {
                    cheapest = Some(Plane { grid: *self, axis, first_bins, cost });
                }
            }
        }
        cheapest
    }
}

/// A plane between two bins.
struct Plane {
    grid: Grid,
    axis: usize,
    first_bins: usize,
    cost: f32,
}

impl Plane {
    #[inline(always)]
    fn is_first(&self, primitive: &Primitive) -> bool {
        self.grid.bins(primitive)[self.axis] < self.first_bins
    }
}

/// For each plane with something on both sides, how many bins lie before it and what it costs.
fn costs(bins: &[(Extent, u32); BINS]) -> impl Iterator<Item = (usize, f32)> {
    let mut second = [(0.0_f32, 0_u32); BINS];
    let (mut count, mut extent) = (0, Extent::EMPTY);
    for bin in (1..BINS).rev() {
        count += bins[bin].1;
        extent = extent.union(&bins[bin].0);
        second[bin] = (extent.half_area() * count as f32, count);
    }
    let (mut count, mut extent) = (0, Extent::EMPTY);
    (1..BINS).filter_map(move |bin| {
        count += bins[bin - 1].1;
        extent = extent.union(&bins[bin - 1].0);
        let (second_cost, second_count) = second[bin];
        let is_split = count > 0 && second_count > 0;
        is_split.then(|| (bin, extent.half_area() * count as f32 + second_cost))
    })
}

/// Splits of a few primitives.
mod few {
    use super::{Extent, FEW, Primitive};

    /// Sorts two or more primitives along the axis, and returns the place, that cost least.
    pub(super) fn cheapest_order(primitives: &mut [Primitive]) -> usize {
        let mut cheapest = (f32::INFINITY, 0, primitives.len() / 2);
        for axis in 0..3 {
            sort(primitives, axis);
            for (place, cost) in costs(primitives) {
                if cost < cheapest.0 {
                    cheapest = (cost, axis, place);
                }
            }
        }
        let (_, axis, place) = cheapest;
        if axis != 2 {
            sort(primitives, axis);
        }
        place
    }

    /// By insertion; equal centres by index, so that the order before does not matter.
    fn sort(primitives: &mut [Primitive], axis: usize) {
        let key = |p: &Primitive| (p.0.centre_doubled()[axis], p.triangle());
        for i in 1..primitives.len() {
            let (primitive, mut place) = (primitives[i], i);
            while place > 0 && key(&primitives[place - 1]) > key(&primitive) {
                primitives[place] = primitives[place - 1];
                place -= 1;
            }
            primitives[place] = primitive;
        }
    }

    fn costs(primitives: &[Primitive]) -> impl Iterator<Item = (usize, f32)> {
        let count = primitives.len();
        let mut second = [0.0_f32; FEW];
        let mut extent = Extent::EMPTY;
        for place in (1..count).rev() {
            extent = extent.union(&primitives[place].0);
            second[place] = extent.half_area() * (count - place) as f32;
        }
        let mut extent = Extent::EMPTY;
        (1..count).map(move |place| {
            extent = extent.union(&primitives[place - 1].0);
            (place, extent.half_area() * place as f32 + second[place])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{BinaryNode, Bounds, MAX_DEPTH, Preset, Primitive, build};

    /// Boxes along a spiral, of sizes that differ by orders of magnitude.
    fn primitives(count: u32, growth: f32) -> Vec<Primitive> {
        let primitive = |triangle: u32| {
            let k = triangle as f32;
            let size = growth.powf(k);
            let low = [size * (0.1 * k).cos(), size * (0.1 * k).sin(), k % 7.0];
            let bounds = Bounds { low, high: low.map(|x| x + 0.1 * size) };
            Primitive::new(&bounds, triangle)
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
            pool.install(|| build(Preset::Medium, primitives(20_000, 1.0001)))
        };
        let one = with_threads(1);
        assert_eq!(one.len(), 39_999);
        assert_eq!(one, with_threads(4));
    }

    #[test]
    fn every_triangle_has_one_leaf_and_the_depth_is_bounded() {
        let cases = [(1, 1.0), (2, 1.0), (1000, 1.0), (2000, 1.01), (6000, 0.99)];
        for (preset, (count, growth)) in Preset::ALL.into_iter().flat_map(|p| cases.map(|c| (p, c)))
        {
            let nodes = build(preset, primitives(count, growth));
            let leaves = nodes.iter().filter(|node| node.count == 1);
            let mut triangles: Vec<u32> = leaves.map(BinaryNode::triangle).collect();
            triangles.sort_unstable();
            assert!(triangles.into_iter().eq(0..count));
            assert!(depth(&nodes, 0) <= MAX_DEPTH, "{preset:?} {count} {growth}");
        }
        assert!(build(Preset::Medium, Vec::new()).is_empty());
    }
}
