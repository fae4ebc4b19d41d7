//! How a ray walks the wide tree: near children first, what lies behind the closest hit never.
#![allow(
    unsafe_code,
    reason = "a stack that is not cleared for every ray, and vector instructions"
)]

use super::build::MAX_DEPTH;
use super::slabs::Slabs;
use super::triangle_test::{Meeting, Shear, comes_before};
use super::wide::{Leaf, MAX_WIDTH, Node, Reference, TRANSPARENT, WideTree};
use crate::{Hit, Ray};
use std::mem::MaybeUninit;

/// The tests of `W` boxes and `W` triangles at once. Box tests only sift; triangle tests give the
/// bits of [`Shear::meet`].
///
/// # Safety
/// Implementations write only to the entries that they are given, and initialize as many as they
/// say. Callers see to it that the processor has the instructions of the implementation.
pub(super) unsafe trait Lanes<const W: usize> {
    /// What is known of `W` meetings.
    type Meetings;

    /// Writes an entry for each child that the ray meets up to `t_far`, and returns their number.
    /// Entries behind them may be overwritten.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn push_met(
        node: &Node<W>,
        slabs: &Slabs,
        t_far: f32,
        free: &mut [MaybeUninit<Entry>; W],
    ) -> usize;

    /// Tries `W` triangles from `first` on. Bits of lanes beyond the leaf have no meaning.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn meet(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32)
    -> Met<Self::Meetings>;

    /// The meeting of a lane.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn meeting(meetings: &Self::Meetings, lane: usize, shear: &Shear) -> Meeting;

    /// Asks for the memory that a step at a reference will read.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn prefetch(tree: &WideTree<W>, reference: Reference);
}

/// Which triangles a ray meets.
pub(super) struct Met<M> {
    /// A bit for each triangle met at `0 < t <= t_far`.
    pub(super) surely: u32,
    /// A bit for each that [`Shear::meet_exactly`] must decide.
    pub(super) perhaps: u32,
    pub(super) meetings: M,
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
pub(super) trait Query {
    /// Whether nearer children come first.
    const ORDERED: bool;
    type Answer;
    /// About rays that can meet nothing.
    const NOTHING: Self::Answer;

    fn new(ray: &Ray, shear: &Shear) -> Self;

    /// Nothing beyond is of interest.
    fn t_far(&self) -> f32;

    /// Takes note of a meeting with a triangle up to `t_far`; true when nothing more can be learned.
    fn note(&mut self, label: u32, meeting: impl FnOnce() -> Meeting) -> bool;

    fn answer(&self) -> Self::Answer;
}

/// The closest hit.
pub(super) struct Closest {
    skip: u32,
    t_far: f32,
    closest: Option<(u32, Meeting)>,
}

impl Query for Closest {
    const ORDERED: bool = true;
    type Answer = Option<Hit>;
    const NOTHING: Option<Hit> = None;

    #[inline(always)]
    fn new(ray: &Ray, shear: &Shear) -> Self {
        Self { skip: skipped(ray), t_far: shear.t_last, closest: None }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn note(&mut self, label: u32, meeting: impl FnOnce() -> Meeting) -> bool {
        let index = label & !TRANSPARENT;
        if index != self.skip {
            let meeting = meeting();
            let is_first =
                |best: (u32, Meeting)| comes_before((index, &meeting), (best.0, &best.1));
            if self.closest.is_none_or(is_first) {
                self.t_far = meeting.t;
                self.closest = Some((index, meeting));
            }
        }
        false
    }

    #[inline(always)]
    fn answer(&self) -> Option<Hit> {
        self.closest.map(|(index, meeting)| meeting.of(index))
    }
}

/// Whether anything is hit.
pub(super) struct Any {
    skip: u32,
    t_far: f32,
    is_hit: bool,
}

impl Query for Any {
    const ORDERED: bool = false;
    type Answer = bool;
    const NOTHING: bool = false;

    #[inline(always)]
    fn new(ray: &Ray, shear: &Shear) -> Self {
        Self { skip: skipped(ray), t_far: shear.t_last, is_hit: false }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn note(&mut self, label: u32, _: impl FnOnce() -> Meeting) -> bool {
        self.is_hit = label < TRANSPARENT && label != self.skip;
        self.is_hit
    }

    #[inline(always)]
    fn answer(&self) -> bool {
        self.is_hit
    }
}

/// The label of no triangle where none is skipped.
#[inline(always)]
fn skipped(ray: &Ray) -> u32 {
    ray.skip.unwrap_or(u32::MAX)
}

/// The answer about one ray.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn trace<const W: usize, L: Lanes<W>, Q: Query>(
    tree: &WideTree<W>,
    ray: &Ray,
) -> Q::Answer {
    let Some((root, shear)) = tree.root.zip(Shear::new(ray)) else { return Q::NOTHING };
    let mut stack = Stack::<W>::new();
    let mut walk = Walk::<Q>::new(root, ray, shear, tree.reach);
    // SAFETY: as the caller says.
    while unsafe { walk.step::<W, L>(tree, &mut stack) } {}
    walk.answer()
}

/// A ray on its way.
pub(super) struct Walk<Q> {
    shear: Shear,
    slabs: Slabs,
    query: Q,
    /// What to look at next.
    current: Reference,
}

impl<Q: Query> Walk<Q> {
    #[inline(always)]
    pub(super) fn new(root: Reference, ray: &Ray, shear: Shear, reach: f32) -> Self {
        let (slabs, query) = (Slabs::new(ray, reach), Q::new(ray, &shear));
        Self { shear, slabs, query, current: root }
    }

    /// What the next step looks at.
    #[inline(always)]
    pub(super) fn next(&self) -> Reference {
        self.current
    }

    #[inline(always)]
    pub(super) fn answer(&self) -> Q::Answer {
        self.query.answer()
    }

    /// Looks at one node or leaf; false when nothing is left or the query has its answer.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    pub(super) unsafe fn step<const W: usize, L: Lanes<W>>(
        &mut self,
        tree: &WideTree<W>,
        stack: &mut Stack<W>,
    ) -> bool {
        let reference = self.current;
        if !reference.is_leaf() {
            let free = stack.free();
            // SAFETY: as the caller says.
            let met =
                unsafe { L::push_met(tree.node(reference), &self.slabs, self.query.t_far(), free) };
            if met > 0 {
                if met == 2 || (Q::ORDERED && met > 2) {
                    // SAFETY: `push_met` initialized as many.
                    sort_nearest_last(unsafe { free[..met].assume_init_mut() });
                }
                stack.len += met;
                self.current = stack.pop_unchecked().reference();
                return true;
            }
        } else {
            // SAFETY: as the caller says.
            if unsafe { self.look_at::<W, L>(&tree.leaf(reference)) } {
                return false;
            }
        }
        loop {
            if stack.len == 0 {
                return false;
            }
            let entry = stack.pop_unchecked();
            if entry.t() <= self.query.t_far() {
                self.current = entry.reference();
                return true;
            }
        }
    }
}

impl<Q: Query> Walk<Q> {
    /// Tries the triangles of a leaf; true when nothing more can be learned.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn look_at<const W: usize, L: Lanes<W>>(&mut self, leaf: &Leaf<'_>) -> bool {
        let mut first = 0;
        while first < leaf.count {
            // SAFETY: as the caller says.
            let met = unsafe { L::meet(leaf, first, &self.shear, self.query.t_far()) };
            let lanes = (2 << (leaf.count - first - 1)) - 1;
            let mut surely = met.surely & lanes;
            while surely != 0 {
                let lane = surely.trailing_zeros() as usize;
                surely &= surely - 1;
                // SAFETY: as the caller says.
                let meeting = || unsafe { L::meeting(&met.meetings, lane, &self.shear) };
                if self.query.note(leaf.label(first + lane), meeting) {
                    return true;
                }
            }
            if met.perhaps & lanes != 0 && self.look_closely(leaf, first, met.perhaps & lanes) {
                return true;
            }
            first += W;
        }
        false
    }

    /// The same for triangles seen close to edge-on.
    #[cold]
    #[inline(never)]
    fn look_closely(&mut self, leaf: &Leaf<'_>, first: usize, mut lanes: u32) -> bool {
        while lanes != 0 {
            let triangle = first + lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let corner = |corner: usize, axis: usize| leaf.coordinate(corner, axis, triangle);
            let meeting = self.shear.meet_exactly(corner);
            if let Some(meeting) = meeting.filter(|m| m.t <= self.query.t_far())
                && self.query.note(leaf.label(triangle), || meeting)
            {
                return true;
            }
        }
        false
    }
}

/// Entries of a stack: what the nodes on the longest path may leave, and room for one node more.
const STACK: usize = MAX_DEPTH as usize * (MAX_WIDTH - 1) + MAX_WIDTH;

/// What is still to be visited, next on top.
pub(super) struct Stack<const W: usize> {
    entries: [MaybeUninit<Entry>; STACK],
    len: usize,
}

impl<const W: usize> Stack<W> {
    #[inline(always)]
    pub(super) const fn new() -> Self {
        Self { entries: [const { MaybeUninit::uninit() }; STACK], len: 0 }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.len = 0;
    }

    /// Room for the children of a node.
    #[inline(always)]
    fn free(&mut self) -> &mut [MaybeUninit<Entry>; W] {
        debug_assert!(self.len + W <= STACK);
        // SAFETY: a node leaves at most `W - 1` entries when one of its children is taken, and no
        // path has more than `MAX_DEPTH` nodes: see `STACK`.
        unsafe { &mut *self.entries.as_mut_ptr().add(self.len).cast() }
    }

    /// The top of a stack that is not empty.
    #[inline(always)]
    fn pop_unchecked(&mut self) -> Entry {
        debug_assert!(self.len > 0);
        self.len -= 1;
        // SAFETY: the caller saw an entry, and all up to `len` were written by `push_met`.
        unsafe { self.entries.get_unchecked(self.len).assume_init() }
    }
}

/// By exchanges where there are few, else by insertion.
#[inline(always)]
fn sort_nearest_last(entries: &mut [Entry]) {
    match entries {
        [a, b] => order(a, b),
        [a, b, c] => {
            order(a, b);
            order(b, c);
            order(a, b);
        }
        [a, b, c, d] => {
            order(a, b);
            order(c, d);
            order(a, c);
            order(b, d);
            order(b, c);
        }
        _ => sort_by_insertion(entries),
    }
}

#[inline(always)]
fn order(a: &mut Entry, b: &mut Entry) {
    (*a, *b) = ((*a).max(*b), (*a).min(*b));
}

#[inline(always)]
fn sort_by_insertion(entries: &mut [Entry]) {
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
