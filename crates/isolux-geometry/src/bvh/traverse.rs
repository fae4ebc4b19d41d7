//! How a ray walks the wide tree: near children first, what lies behind the closest hit never.

use super::slabs::Slabs;
use super::triangle_test::{Shear, comes_before};
use super::wide::{Block, Node, Reference, WIDTH, WideTree};
use crate::{Hit, Ray};

/// The tests of eight boxes and eight triangles at once. They only sift: what is hit is decided by
/// [`Shear::meet`], hence the same bits for every implementation.
pub(super) trait Lanes {
    /// What the tests need to know about the ray.
    fn new(shear: &Shear, slabs: &Slabs) -> Self;

    /// Writes an entry for each child whose box the ray meets up to `t_far`, in any order, and
    /// returns their number. The other elements of `entries` may be overwritten.
    fn children_met(&self, node: &Node, t_far: f32, entries: &mut [Entry; WIDTH]) -> usize;

    /// A bit for each triangle that the line of the ray may meet.
    fn candidates(&self, block: &Block) -> u32;
}

/// A reference (low half) and the distance at which the ray enters it (high half: distances are not
/// negative, so that their bits order as they do).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[repr(transparent)]
pub(super) struct Entry(pub(super) u64);

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

/// What is still to be visited, next on top. Every level of the tree leaves at most seven entries
/// behind, and [`MAX_DEPTH`](super::build::MAX_DEPTH) bounds the levels.
struct Stack {
    entries: [Entry; Self::SIZE],
    len: usize,
}

impl Stack {
    const SIZE: usize = 256;

    #[inline(always)]
    fn new(root: Reference) -> Self {
        let mut entries = [Entry(0); Self::SIZE];
        entries[0] = Entry::new(0.0, root);
        Self { entries, len: 1 }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Entry> {
        self.len = self.len.checked_sub(1)?;
        Some(self.entries[self.len])
    }

    /// Pushes the children met and returns them.
    #[inline(always)]
    fn push<L: Lanes>(&mut self, lanes: &L, node: &Node, t_far: f32) -> &mut [Entry] {
        let Some(free) = self.entries[self.len..].first_chunk_mut::<WIDTH>() else {
            unreachable!("depth is bounded")
        };
        let count = lanes.children_met(node, t_far, free);
        self.len += count;
        &mut free[..count]
    }
}

const _: () = assert!(super::build::MAX_DEPTH as usize * (WIDTH - 1) + WIDTH <= Stack::SIZE);

/// See [`Bvh::closest_hit`](super::Bvh::closest_hit).
#[inline(always)]
pub(super) fn closest_hit<L: Lanes>(tree: &WideTree, ray: &Ray) -> Option<Hit> {
    let shear = Shear::new(ray)?;
    let lanes = L::new(&shear, &Slabs::new(ray, tree.reach));
    let skip = ray.skip.unwrap_or(u32::MAX);
    let mut stack = Stack::new(tree.root?);
    let mut closest: Option<Hit> = None;
    let mut t_far = shear.t_max;
    while let Some(entry) = stack.pop() {
        if entry.t() > t_far {
            continue;
        }
        match entry.reference().target() {
            Ok(node) => sort_nearest_last(stack.push(&lanes, &tree.nodes[node], t_far)),
            Err((first, count)) => {
                for block in &tree.blocks[first..first + count] {
                    let candidates = lanes.candidates(block);
                    for lane in set_bits(candidates) {
                        let triangle = block.labels[lane] & !Block::TRANSPARENT;
                        if triangle == skip {
                            continue;
                        }
                        let Some(hit) = shear.meet(block.triangle(lane), triangle) else {
                            continue;
                        };
                        if closest.as_ref().is_none_or(|best| comes_before(&hit, best)) {
                            t_far = hit.t;
                            closest = Some(hit);
                        }
                    }
                }
            }
        }
    }
    closest
}

/// See [`Bvh::any_hit`](super::Bvh::any_hit).
#[inline(always)]
pub(super) fn any_hit<L: Lanes>(tree: &WideTree, ray: &Ray) -> bool {
    let (Some(shear), Some(root)) = (Shear::new(ray), tree.root) else { return false };
    let lanes = L::new(&shear, &Slabs::new(ray, tree.reach));
    let skip = ray.skip.unwrap_or(u32::MAX);
    let mut stack = Stack::new(root);
    while let Some(entry) = stack.pop() {
        match entry.reference().target() {
            Ok(node) => {
                stack.push(&lanes, &tree.nodes[node], shear.t_max);
            }
            Err((first, count)) => {
                for block in &tree.blocks[first..first + count] {
                    let blocked = set_bits(lanes.candidates(block)).any(|lane| {
                        let label = block.labels[lane];
                        let is_seen = label < Block::TRANSPARENT && label != skip;
                        is_seen && shear.meet(block.triangle(lane), label).is_some()
                    });
                    if blocked {
                        return true;
                    }
                }
            }
        }
    }
    false
}

/// The places of the ones, from the lowest up.
#[inline(always)]
fn set_bits(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        let any = bits != 0;
        bits &= bits.wrapping_sub(1);
        any.then_some(lane)
    })
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
