//! How a ray walks the wide tree: near children first, what lies behind the closest hit never.
#![allow(unsafe_code, reason = "a stack that is not cleared for every ray, and vector instructions")]

use super::slabs::Slabs;
use super::triangle_test::{Meeting, Shear, comes_before};
use super::build::MAX_DEPTH;
use super::wide::{Leaf, MAX_WIDTH, Node, Reference, TRANSPARENT, WideTree};
use crate::{Hit, Ray};
use std::mem::MaybeUninit;

/// The tests of `W` boxes and `W` triangles at once. They only sift: what is hit is decided by
/// [`Shear::meet`], hence the same bits for every implementation.
///
/// # Safety
/// Implementations write only to the entries that they are given, and initialize as many as they
/// say. Callers see to it that the processor has the instructions of the implementation.
pub(super) unsafe trait Lanes<const W: usize> {
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

    /// A bit for each triangle, from `first` on, that the line of the ray may meet at
    /// `0 < t <= t_far`. Bits of lanes beyond the leaf have no meaning.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn candidates(leaf: &Leaf<'_>, first: usize, shear: &Shear, t_far: f32) -> u32;

    /// Asks for the memory that a step at a reference will read.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn prefetch(tree: &WideTree<W>, reference: Reference);
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

    fn new(ray: &Ray, shear: &Shear) -> Self;

    /// Nothing beyond is of interest.
    fn t_far(&self) -> f32;

    /// Looks at one triangle of a leaf; true when nothing more can be learned.
    fn look_at(&mut self, shear: &Shear, leaf: &Leaf<'_>, triangle: usize) -> bool;

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

    #[inline(always)]
    fn new(ray: &Ray, shear: &Shear) -> Self {
        Self { skip: skipped(ray), t_far: shear.t_max, closest: None }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn look_at(&mut self, shear: &Shear, leaf: &Leaf<'_>, triangle: usize) -> bool {
        let index = leaf.label(triangle) & !TRANSPARENT;
        let meeting = shear.meet(|corner, axis| leaf.coordinate(corner, axis, triangle));
        if let Some(meeting) = meeting.filter(|m| m.t <= self.t_far && index != self.skip)
            && self.closest.is_none_or(|best| comes_before((index, &meeting), (best.0, &best.1)))
        {
            self.t_far = meeting.t;
            self.closest = Some((index, meeting));
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
    t_max: f32,
    is_hit: bool,
}

impl Query for Any {
    const ORDERED: bool = false;
    type Answer = bool;

    #[inline(always)]
    fn new(ray: &Ray, shear: &Shear) -> Self {
        Self { skip: skipped(ray), t_max: shear.t_max, is_hit: false }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_max
    }

    #[inline(always)]
    fn look_at(&mut self, shear: &Shear, leaf: &Leaf<'_>, triangle: usize) -> bool {
        let label = leaf.label(triangle);
        let is_seen = label < TRANSPARENT && label != self.skip;
        let corner = |corner: usize, axis: usize| leaf.coordinate(corner, axis, triangle);
        self.is_hit = is_seen && shear.meet(corner).is_some();
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

/// The answer about one ray; `None` for rays that can meet nothing.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn trace<const W: usize, L: Lanes<W>, Q: Query>(
    tree: &WideTree<W>,
    ray: &Ray,
) -> Option<Q::Answer> {
    let (root, shear) = (tree.root?, Shear::new(ray)?);
    let mut stack = Stack::<W>::new();
    let mut walk = Walk::<Q>::new(root, ray, shear, tree.reach);
    // SAFETY: as the caller says.
    while unsafe { walk.step::<W, L>(tree, &mut stack) } {}
    Some(walk.answer())
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
            let met = unsafe {
                L::push_met(tree.node(reference), &self.slabs, self.query.t_far(), free)
            };
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
            let leaf = tree.leaf(reference);
            let mut first = 0;
            while first < leaf.count {
                // SAFETY: as the caller says.
                let lanes =
                    unsafe { L::candidates(&leaf, first, &self.shear, self.query.t_far()) };
                let mut candidates = lanes & ((2 << (leaf.count - first - 1)) - 1);
                while candidates != 0 {
                    let triangle = first + candidates.trailing_zeros() as usize;
                    candidates &= candidates - 1;
                    if self.query.look_at(&self.shear, &leaf, triangle) {
                        return false;
                    }
                }
                first += W;
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
