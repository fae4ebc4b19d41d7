//! How a ray walks the wide tree: near children first, what lies behind the closest hit never.
#![allow(
    unsafe_code,
    reason = "a stack that is not cleared for every ray, and vector instructions"
)]

use super::bounds::Bounds;
use super::build::MAX_DEPTH;
use super::local::Local;
use super::slabs::Slabs;
use super::triangle_test::{Meeting, Shear, comes_before};
use super::wide::{Leaf, MAX_WIDTH, Node, Reference, TRANSPARENT, WideTree};
use crate::Hit;
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

    /// Where the ray enters `W` boxes.
    type Distances: Copy;

    /// Where the ray enters the children, and a bit for each that it meets up to `t_far`.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn children_met(node: &Node<W>, slabs: &Slabs, t_far: f32) -> (Self::Distances, u32);

    /// Writes an entry for each child `met`, in the order of the lanes. Entries behind them may be
    /// overwritten.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn push(
        node: &Node<W>,
        distances: Self::Distances,
        met: u32,
        free: &mut [MaybeUninit<Entry>; W],
    );

    /// Tries the triangles from `first` on, of which there are some in the `lanes` given.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn meet(
        leaf: &Leaf<'_>,
        first: usize,
        lanes: u32,
        shear: &Shear,
        t_far: f32,
    ) -> Option<Met<Self::Meetings>>;

    /// Of a lane: the weighted sum of the depths, the second and the third weight, and the sum of all
    /// weights.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn sums(meetings: &Self::Meetings, lane: usize) -> [f32; 4];

    /// Asks for the memory that a step at a reference will read.
    ///
    /// # Safety
    /// See [`Lanes`].
    unsafe fn prefetch(tree: &WideTree<W>, reference: Reference);
}

/// Which triangles a ray meets.
pub(super) struct Met<M> {
    /// A bit for each triangle met at `0 < t <= t_far`, and maybe for some met a little beyond.
    pub(super) likely: u32,
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
pub(super) trait Query: Copy {
    /// Whether nearer children come first.
    const ORDERED: bool;
    type Answer;
    /// About rays that can meet nothing.
    const NOTHING: Self::Answer;

    fn new(ray: &Local, shear: &Shear) -> Self;

    /// Nothing beyond is of interest.
    fn t_far(&self) -> f32;

    /// Boxes entered beyond hold nothing of interest.
    fn reach(&self) -> f32;

    /// Whether meetings with the triangle of this label are of no interest.
    fn is_blind_to(&self, label: u32) -> bool;

    /// Takes note of a meeting with a triangle, if it is one up to `t_far`.
    fn note(&mut self, label: u32, shear: &Shear, meeting: impl FnOnce() -> Meeting);

    /// Whether nothing more can be learned.
    fn is_done(&self) -> bool;

    fn answer(&self) -> Self::Answer;
}

/// The closest hit.
#[derive(Clone, Copy)]
pub(super) struct Closest {
    skip: u32,
    t_far: f32,
    reach: f32,
    closest: Option<(u32, Meeting)>,
}

impl Query for Closest {
    const ORDERED: bool = true;
    type Answer = Option<Hit>;
    const NOTHING: Option<Hit> = None;

    #[inline(always)]
    fn new(ray: &Local, shear: &Shear) -> Self {
        let t_far = shear.t_last;
        Self { skip: skipped(ray), t_far, reach: t_far, closest: None }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn reach(&self) -> f32 {
        self.reach
    }

    #[inline(always)]
    fn is_blind_to(&self, label: u32) -> bool {
        label & !TRANSPARENT == self.skip
    }

    #[inline(always)]
    fn note(&mut self, label: u32, shear: &Shear, meeting: impl FnOnce() -> Meeting) {
        if !self.is_blind_to(label) {
            let index = label & !TRANSPARENT;
            let meeting = meeting();
            let is_first =
                |best: (u32, Meeting)| comes_before((index, &meeting), (best.0, &best.1));
            if meeting.is_within(self.t_far) && self.closest.is_none_or(is_first) {
                self.t_far = meeting.t;
                self.reach = shear.reach(meeting.t);
                self.closest = Some((index, meeting));
            }
        }
    }

    #[inline(always)]
    fn is_done(&self) -> bool {
        false
    }

    #[inline(always)]
    fn answer(&self) -> Option<Hit> {
        self.closest.map(|(index, meeting)| meeting.of(index))
    }
}

/// Whether anything is hit.
#[derive(Clone, Copy)]
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
    fn new(ray: &Local, shear: &Shear) -> Self {
        let t_far = shear.t_last;
        Self { skip: skipped(ray), t_far, is_hit: false }
    }

    #[inline(always)]
    fn t_far(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn reach(&self) -> f32 {
        self.t_far
    }

    #[inline(always)]
    fn is_blind_to(&self, label: u32) -> bool {
        label >= TRANSPARENT || label == self.skip
    }

    #[inline(always)]
    fn note(&mut self, label: u32, _: &Shear, meeting: impl FnOnce() -> Meeting) {
        self.is_hit |= !self.is_blind_to(label) && meeting().is_within(self.t_far);
    }

    #[inline(always)]
    fn is_done(&self) -> bool {
        self.is_hit
    }

    #[inline(always)]
    fn answer(&self) -> bool {
        self.is_hit
    }
}

/// The label of no triangle where none is skipped.
#[inline(always)]
fn skipped(ray: &Local) -> u32 {
    ray.skip.unwrap_or(u32::MAX)
}

/// The answer about one ray.
///
/// # Safety
/// The processor has the instructions of `L`.
#[inline(always)]
pub(super) unsafe fn trace<const W: usize, L: Lanes<W>, Q: Query>(
    tree: &WideTree<W>,
    ray: &Local,
) -> Q::Answer {
    let Some((root, shear)) = tree.root.zip(Shear::new(ray)) else { return Q::NOTHING };
    let mut stack = Stack::<W>::new();
    let constants = Constants::new(ray, shear, &tree.bounds);
    let mut walk = Walk::<Q>::new(root, Q::new(ray, &shear));
    // SAFETY: as the caller says.
    while unsafe { walk.step::<W, L>(tree, &constants, &mut stack) } {}
    walk.answer()
}

/// What the tests need to know about a ray.
pub(super) struct Constants {
    shear: Shear,
    slabs: Slabs,
}

impl Constants {
    #[inline(always)]
    pub(super) fn new(ray: &Local, shear: Shear, scene: &Bounds) -> Self {
        Self { shear, slabs: Slabs::new(ray, scene) }
    }
}

/// A ray on its way.
pub(super) struct Walk<Q> {
    query: Q,
    /// What to look at next.
    current: Reference,
    /// Number of entries on the stack. Not kept with them: what lies beside an array that is indexed
    /// does not stay in a register.
    waiting: usize,
}

impl<Q: Query> Walk<Q> {
    #[inline(always)]
    pub(super) fn new(root: Reference, query: Q) -> Self {
        Self { query, current: root, waiting: 0 }
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
        constants: &Constants,
        stack: &mut Stack<W>,
    ) -> bool {
        if self.current.is_leaf() {
            // SAFETY: as the caller says.
            if unsafe { self.look_at::<W, L>(&tree.leaf(self.current), &constants.shear) } {
                return false;
            }
        } else {
            let node = tree.node(self.current);
            // SAFETY: as the caller says.
            let (distances, met) =
                unsafe { L::children_met(node, &constants.slabs, self.query.reach()) };
            if met.is_power_of_two() {
                self.current = node.child(met.trailing_zeros());
                return true;
            }
            if met != 0 {
                let free = stack.above(self.waiting);
                // SAFETY: as the caller says; `push` initializes as many as are met.
                let entries = unsafe {
                    L::push(node, distances, met, free);
                    free[..met.count_ones() as usize].assume_init_mut()
                };
                self.waiting += entries.len() - 1;
                self.current = nearest_last::<Q>(entries).reference();
                return true;
            }
        }
        while self.waiting > 0 {
            self.waiting -= 1;
            let entry = stack.entry(self.waiting);
            if entry.t() <= self.query.reach() {
                self.current = entry.reference();
                return true;
            }
        }
        false
    }
}

impl<Q: Query> Walk<Q> {
    /// Tries the triangles of a leaf; true when nothing more can be learned.
    ///
    /// # Safety
    /// The processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn look_at<const W: usize, L: Lanes<W>>(
        &mut self,
        leaf: &Leaf<'_>,
        shear: &Shear,
    ) -> bool {
        let mut first = 0;
        while first < leaf.count {
            let lanes = (2 << (leaf.count - first - 1)) - 1;
            let start = first;
            first += W;
            // SAFETY: as the caller says.
            let met = unsafe { L::meet(leaf, start, lanes, shear, self.query.t_far()) };
            let Some(met) = met else { continue };
            let mut likely = met.likely;
            while likely != 0 {
                let lane = likely.trailing_zeros() as usize;
                likely &= likely - 1;
                // SAFETY: as the caller says.
                let sums = unsafe { L::sums(&met.meetings, lane) };
                let corner = |corner, axis| leaf.coordinate(corner, axis, start + lane);
                self.query.note(leaf.label(start + lane), shear, || shear.meeting(corner, sums));
                if self.query.is_done() {
                    return true;
                }
            }
            let mut perhaps = met.perhaps;
            while perhaps != 0 {
                let triangle = start + perhaps.trailing_zeros() as usize;
                perhaps &= perhaps - 1;
                // Most often the triangle that the ray starts on.
                if !self.query.is_blind_to(leaf.label(triangle)) {
                    // A copy goes in and comes back: what is lent to a call does not stay in
                    // registers.
                    self.query = look_closely(self.query, *shear, *leaf, triangle);
                    if self.query.is_done() {
                        return true;
                    }
                }
            }
        }
        false
    }
}

/// Tries a triangle that is seen close to edge-on or met close to the origin.
#[cold]
#[inline(never)]
fn look_closely<Q: Query>(mut query: Q, shear: Shear, leaf: Leaf<'_>, triangle: usize) -> Q {
    let corner = |corner: usize, axis: usize| leaf.coordinate(corner, axis, triangle);
    if let Some(meeting) = shear.meet_exactly(corner) {
        query.note(leaf.label(triangle), &shear, || meeting);
    }
    query
}

/// Entries of a stack: what the nodes on the longest path may leave, and room for one node more.
const STACK: usize = MAX_DEPTH as usize * (MAX_WIDTH - 1) + MAX_WIDTH;

/// What is still to be visited, next on top.
pub(super) struct Stack<const W: usize>([MaybeUninit<Entry>; STACK]);

impl<const W: usize> Stack<W> {
    #[inline(always)]
    pub(super) const fn new() -> Self {
        Self([const { MaybeUninit::uninit() }; STACK])
    }

    /// Room for the children of a node above so many entries.
    #[inline(always)]
    fn above(&mut self, waiting: usize) -> &mut [MaybeUninit<Entry>; W] {
        debug_assert!(waiting + W <= STACK);
        // SAFETY: a node leaves at most `W - 1` entries when one of its children is taken, and no
        // path has more than `MAX_DEPTH` nodes: see `STACK`.
        unsafe { &mut *self.0.as_mut_ptr().add(waiting).cast() }
    }

    /// One of the entries written by `Lanes::push`.
    #[inline(always)]
    fn entry(&self, index: usize) -> Entry {
        debug_assert!(index < STACK);
        // SAFETY: only asked for entries below those that were counted when they were pushed.
        unsafe { self.0.get_unchecked(index).assume_init() }
    }
}

/// Sorts entries, two or more, by exchanges where there are few, and returns the last.
#[inline(always)]
fn nearest_last<Q: Query>(entries: &mut [Entry]) -> Entry {
    match entries {
        [a, b] => order(a, b),
        _ if !Q::ORDERED => entries[entries.len() - 1],
        [a, b, c] => {
            order(a, b);
            order(b, c);
            order(a, b);
            *c
        }
        [a, b, c, d] => {
            order(a, b);
            order(c, d);
            order(a, c);
            order(b, d);
            order(b, c);
            *d
        }
        _ => {
            sort_by_insertion(entries);
            entries[entries.len() - 1]
        }
    }
}

/// Exchanges two entries if need be, and returns the nearer.
#[inline(always)]
fn order(a: &mut Entry, b: &mut Entry) -> Entry {
    (*a, *b) = ((*a).max(*b), (*a).min(*b));
    *b
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
