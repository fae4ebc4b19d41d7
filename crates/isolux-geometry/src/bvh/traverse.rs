//! How a ray walks the wide tree: near children first, what lies behind the closest hit never.

use super::slabs::Slabs;
use super::triangle_test::{Shear, comes_before};
use super::wide::{Block, Node, Reference, WIDTH, WideTree};
use crate::{Hit, Ray};

/// The tests of eight boxes and eight triangles at once. They only sift: what is hit is decided by
/// [`Shear::meet`], hence the same bits for every implementation.
pub(super) trait Lanes {
    /// Where the ray enters eight boxes.
    type Distances: Copy;

    /// What the tests need to know about the ray.
    fn new(shear: &Shear, slabs: &Slabs) -> Self;

    /// Where the ray enters the children, and a bit for each that it meets up to `t_far`.
    fn children_met(&self, node: &Node, t_far: f32) -> (Self::Distances, u32);

    /// Writes an entry for each child `met`, in the order of the lanes. What follows them in
    /// `entries` may be overwritten.
    fn write_met(node: &Node, t: Self::Distances, met: u32, entries: &mut [Entry; WIDTH]);

    /// A bit for each triangle that the line of the ray may meet.
    fn candidates(&self, block: &Block) -> u32;
}

/// A reference (low half) and the distance at which the ray enters it (high half: distances are not
/// negative, so that their bits order as they do).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(transparent)]
pub(super) struct Entry(u64);

impl Entry {
    #[inline(always)]
    pub(super) fn new(t: f32, child: Reference) -> Self {
        Self(u64::from(t.to_bits()) << 32 | u64::from(child.0))
    }

    #[inline(always)]
    fn t(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    fn reference(self) -> Reference {
        Reference(self.0 as u32)
    }
}

/// What a walk looks for.
trait Query {
    /// Whether nearer children come first.
    const ORDERED: bool;

    /// Nothing beyond is of interest.
    fn t_far(&self) -> f32;

    /// Looks at some triangles of a block; true when nothing more can be learned.
    fn look_at(&mut self, block: &Block, candidates: u32) -> bool;
}

/// See [`Bvh::closest_hit`](super::Bvh::closest_hit).
#[inline(always)]
pub(super) fn closest_hit<L: Lanes>(tree: &WideTree, ray: &Ray) -> Option<Hit> {
    let shear = Shear::new(ray)?;
    let lanes = L::new(&shear, &Slabs::new(ray, tree.reach));
    let mut query = Closest { t_far: shear.t_max, shear, skip: skipped(ray), closest: None };
    walk(tree, &lanes, &mut query);
    query.closest
}

/// See [`Bvh::any_hit`](super::Bvh::any_hit).
#[inline(always)]
pub(super) fn any_hit<L: Lanes>(tree: &WideTree, ray: &Ray) -> bool {
    let Some(shear) = Shear::new(ray) else { return false };
    let lanes = L::new(&shear, &Slabs::new(ray, tree.reach));
    walk(tree, &lanes, &mut Any { shear, skip: skipped(ray) })
}

/// The label of no triangle where none is skipped.
#[inline(always)]
fn skipped(ray: &Ray) -> u32 {
    ray.skip.unwrap_or(u32::MAX)
}

struct Closest {
    shear: Shear,
    skip: u32,
    t_far: f32,
    closest: Option<Hit>,
}

impl Query for Closest {
    const ORDERED: bool = true;

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn look_at(&mut self, block: &Block, mut candidates: u32) -> bool {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let triangle = block.labels[lane] & !Block::TRANSPARENT;
            if triangle == self.skip {
                continue;
            }
            let corner = |corner: usize, axis: usize| block.corners[corner][axis][lane];
            let Some(meeting) = self.shear.meet(corner) else { continue };
            if meeting.t > self.t_far {
                continue;
            }
            let hit = meeting.of(triangle);
            if self.closest.as_ref().is_none_or(|closest| comes_before(&hit, closest)) {
                self.t_far = hit.t;
                self.closest = Some(hit);
            }
        }
        false
    }
}

struct Any {
    shear: Shear,
    skip: u32,
}

impl Query for Any {
    const ORDERED: bool = false;

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.shear.t_max
    }

    #[inline(always)]
    fn look_at(&mut self, block: &Block, mut candidates: u32) -> bool {
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize;
            candidates &= candidates - 1;
            let label = block.labels[lane];
            let is_seen = label < Block::TRANSPARENT && label != self.skip;
            let corner = |corner: usize, axis: usize| block.corners[corner][axis][lane];
            if is_seen && self.shear.meet(corner).is_some() {
                return true;
            }
        }
        false
    }
}

/// Visits what the ray meets until nothing is left or the query has its answer; whether it has.
#[inline(always)]
fn walk<L: Lanes, Q: Query>(tree: &WideTree, lanes: &L, query: &mut Q) -> bool {
    let Some(mut current) = tree.root else { return false };
    let mut stack = Stack::new();
    loop {
        match current.target() {
            Ok(node) => {
                let node = &tree.nodes[node];
                let (t, met) = lanes.children_met(node, query.t_far());
                if met != 0 {
                    current = if met.is_power_of_two() {
                        node.children[met.trailing_zeros() as usize % WIDTH]
                    } else {
                        stack.push::<L, Q>(node, t, met)
                    };
                    continue;
                }
            }
            Err((first, count)) => {
                for block in &tree.blocks[first..first + count] {
                    if query.look_at(block, lanes.candidates(block)) {
                        return true;
                    }
                }
            }
        }
        current = loop {
            let Some(entry) = stack.pop() else { return false };
            if entry.t() <= query.t_far() {
                break entry.reference();
            }
        };
    }
}

/// What is still to be visited, next on top.
struct Stack {
    entries: [Entry; Self::SIZE],
    len: usize,
    /// What lies below `entries`; only deep trees get here.
    deeper: Vec<Entry>,
}

impl Stack {
    /// Few, because all are written for every ray.
    const SIZE: usize = 32;

    #[inline(always)]
    fn new() -> Self {
        Self { entries: [Entry(0); Self::SIZE], len: 0, deeper: Vec::new() }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Entry> {
        if self.len == 0 {
            return self.deeper.pop();
        }
        self.len -= 1;
        Some(self.entries[self.len % Self::SIZE])
    }

    /// Pushes the children met, two or more, but for the one to visit next, which is returned.
    #[inline(always)]
    fn push<L: Lanes, Q: Query>(&mut self, node: &Node, t: L::Distances, met: u32) -> Reference {
        if self.len > Self::SIZE - WIDTH {
            make_room(&self.entries[..self.len % (Self::SIZE + 1)], &mut self.deeper);
            self.len = 0;
        }
        let Some(free) = self.entries[self.len..].first_chunk_mut::<WIDTH>() else {
            unreachable!("there is room")
        };
        L::write_met(node, t, met, free);
        let last = met.count_ones() as usize - 1;
        self.len += last;
        if last == 1 {
            (free[0], free[1]) = (free[0].max(free[1]), free[0].min(free[1]));
        } else if Q::ORDERED {
            sort_nearest_last(&mut free[..=last]);
        }
        free[last % WIDTH].reference()
    }
}

#[cold]
#[inline(never)]
fn make_room(entries: &[Entry], deeper: &mut Vec<Entry>) {
    deeper.extend_from_slice(entries);
}

/// By insertion: there are few.
#[inline(always)]
fn sort_nearest_last(entries: &mut [Entry]) {
    for i in 1..entries.len() {
        let entry = entries[i];
        let mut place = i;
        while place > 0 && entries[place - 1] < entry {
            entries[place] = entries[place - 1];
            place -= 1;
        }
        entries[place] = entry;
    }
}
