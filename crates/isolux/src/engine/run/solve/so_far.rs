//! What a run has come to, for its caller and for those who watch it.

use super::super::request::{Progress, Watch};
use super::super::state::RunState;
use crate::engine::method::IrradianceCache;
use crate::map::IlluminationMap;

/// A map, and what it takes to go on with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The map.
    pub map: IlluminationMap,
    /// The run as it was when the map was made.
    pub state: RunState,
    /// The samples that the `cache` method has made, those that it started from left out; none if the run was
    /// stopped before they had all their replicates.
    pub cache: IrradianceCache,
    /// Wall-clock time it took, s. Not part of the map, whose bits do not depend on the machine.
    pub time_s: f64,
    /// Whether it was the time allowed that kept it from elements fine enough.
    pub lacked_time: bool,
}

impl Solution {
    /// Itself, unless it has not reached its goal and an earlier one is known to be nearer to the truth.
    pub(super) fn or_better(self, before: Option<Self>) -> Self {
        let is_better = |before: &Self| before.map.knows_more_than(&self.map);
        let before = before.filter(|before| !self.map.provenance.complete && is_better(before));
        // The clock went on.
        let Self { time_s, lacked_time, .. } = self;
        before.map_or(self, |before| Self { time_s, lacked_time, ..before })
    }
}

/// What a run has come to, made for who asks.
pub struct SoFar<'a> {
    pub(super) map: &'a dyn Fn() -> Option<IlluminationMap>,
    pub(super) state: &'a dyn Fn() -> Option<RunState>,
}

impl SoFar<'_> {
    pub(super) const NOTHING: Self = Self { map: &|| None, state: &|| None };

    /// The map as it is now; none while elements are being made.
    pub fn map(&self) -> Option<IlluminationMap> {
        (self.map)()
    }

    /// What it takes to go on from here, with the same flags to the same bits; none while there is nothing to go on from.
    pub fn state(&self) -> Option<RunState> {
        (self.state)()
    }
}

/// Who watches a run: sees its progress, may have what it has come to, and says how to go on.
pub type Watcher<'w> = dyn FnMut(&Progress, &SoFar<'_>) -> Watch + 'w;
