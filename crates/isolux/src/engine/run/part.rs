//! Parts of a run: sums of some of its increments, which merge in any order and grouping.
//!
//! Sums are integers, so parts of disjoint ranges add up to the sums of one run. A map also tells the noise after each
//! number of increments that is a power of two. Sums are therefore kept apart at these numbers.

use super::state::RunIdentity;
use crate::engine::ray::{MAX_INCREMENTS, Sums};
use std::ops::Range;

/// The sums of some increments of a run on one mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct RunPart {
    /// The identity of the run.
    pub identity: RunIdentity,
    /// The number of the mesh, counted from one.
    pub stage: u32,
    /// The sums, in ascending order and disjoint.
    pub segments: Vec<Segment>,
}

/// The sums of successive increments, none of which but the first follows a number that is a power of two.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// The number of the first increment.
    pub first: u64,
    /// The number of increments, at least one.
    pub count: u64,
    /// The number of rays traced for them.
    pub rays: u64,
    /// The sums of the receivers.
    pub receivers: Vec<Sums>,
    /// The sums of the check points, then those of the checked parts of elements.
    pub checks: Vec<Sums>,
    /// The sum of the light on paths given up, one entry.
    pub given_up: Vec<Sums>,
}

/// The reason why parts do not merge.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MergeError {
    /// A part belongs to another run than the first one.
    #[error("it differs from the first part in {0}")]
    OtherRun(&'static str),
    /// Two parts contain the same increments.
    #[error("increments {}..{} are in an earlier part, too", .0.start, .0.end)]
    Overlap(Range<u64>),
}

/// The number of increments after `count` at which sums are kept apart: a power of two.
pub(super) const fn next_kept_apart(count: u64) -> u64 {
    (count + 1).next_power_of_two()
}

impl Segment {
    /// The numbers of the increments.
    pub const fn range(&self) -> Range<u64> {
        self.first..self.first + self.count
    }

    /// Whether another segment continues this one, with no power of two between them.
    fn goes_on_in(&self, next: &Self) -> bool {
        self.range().end == next.first && !next.first.is_power_of_two()
    }

    fn add(&mut self, next: &Self) {
        self.count += next.count;
        self.rays = self.rays.saturating_add(next.rays);
        let add = |into: &mut [Sums], from: &[Sums]| {
            into.iter_mut().zip(from).for_each(|(a, b)| *a = a.plus(b));
        };
        add(&mut self.receivers, &next.receivers);
        add(&mut self.checks, &next.checks);
        add(&mut self.given_up, &next.given_up);
    }

    fn sizes(&self) -> [usize; 3] {
        [&self.receivers, &self.checks, &self.given_up].map(Vec::len)
    }
}

impl RunPart {
    /// The ranges of increments that the part contains, ascending; ranges that touch are one.
    pub fn ranges(&self) -> Vec<Range<u64>> {
        let mut ranges: Vec<Range<u64>> = Vec::new();
        for segment in &self.segments {
            match ranges.last_mut() {
                Some(last) if last.end == segment.first => last.end = segment.range().end,
                _ => ranges.push(segment.range()),
            }
        }
        ranges
    }

    /// The number of increments.
    pub fn increments(&self) -> u64 {
        self.segments.iter().map(|segment| segment.count).sum()
    }

    /// The number of increments if they are the first ones of the run, without a gap.
    pub fn complete_until(&self) -> Option<u64> {
        match self.ranges().as_slice() {
            [Range { start: 0, end }] => Some(*end),
            _ => None,
        }
    }

    /// The first increments without a gap that both parts contain.
    fn overlap(&self, other: &Self) -> Option<Range<u64>> {
        let others = other.ranges();
        let with = |own: Range<u64>| {
            let both = |other: &Range<u64>| own.start.max(other.start)..own.end.min(other.end);
            others.iter().map(both).find(|both| !both.is_empty())
        };
        self.ranges().into_iter().find_map(with)
    }

    /// Adds the increments of another part. The result does not depend on the order or the grouping of parts.
    pub fn merge(&mut self, other: Self) -> Result<(), MergeError> {
        if let Some(what) = self.identity.difference(&other.identity) {
            return Err(MergeError::OtherRun(what));
        }
        if self.stage != other.stage {
            return Err(MergeError::OtherRun("the number of its mesh"));
        }
        let sizes = |part: &Self| part.segments.first().map(Segment::sizes);
        if let (Some(own), Some(others)) = (sizes(self), sizes(&other))
            && own != others
        {
            return Err(MergeError::OtherRun("the number of receivers"));
        }
        if let Some(both) = self.overlap(&other) {
            return Err(MergeError::Overlap(both));
        }
        let mut all = std::mem::take(&mut self.segments);
        all.extend(other.segments);
        all.sort_by_key(|segment| segment.first);
        for segment in all {
            match self.segments.last_mut() {
                Some(last) if last.goes_on_in(&segment) => last.add(&segment),
                _ => self.segments.push(segment),
            }
        }
        Ok(())
    }

    /// Whether the part is one that a run can have made: sizes agree, and segments ascend and are kept apart at powers
    /// of two. Parts from a file may hold anything.
    pub fn is_sound(&self) -> bool {
        let Some(first) = self.segments.first() else { return false };
        let is_whole = |segment: &Segment| {
            let end = segment.first.checked_add(segment.count).filter(|end| *end <= MAX_INCREMENTS);
            let is_within = |end| end <= next_kept_apart(segment.first);
            segment.count > 0 && end.is_some_and(is_within) && segment.sizes() == first.sizes()
        };
        self.segments.iter().all(is_whole)
            && self.segments.is_sorted_by(|a, b| a.range().end <= b.first)
    }
}
