//! The results of a run, for its caller and its watchers.

use super::super::part::RunPart;
use super::super::request::{Progress, SolveError, Watch};
use super::super::state::{PilotState, RunState};
use crate::engine::method::IrradianceCache;
use crate::map::IlluminationMap;

/// A map, and the state from which its run continues.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The map.
    pub map: IlluminationMap,
    /// The state of the run when the map was made.
    pub state: RunState,
    /// The samples that the `cache` method has made, without those that it started from. It is empty if the run was
    /// stopped before they had all their replicates.
    pub cache: IrradianceCache,
    /// The duration of the run, s, as wall-clock time. It is not part of the map, whose bits do not depend on the
    /// machine.
    pub time_s: f64,
    /// Whether only the time limit has kept the run from fine enough elements.
    pub lacked_time: bool,
}

impl Solution {
    /// The solution, or an earlier one if this one misses its goal and the earlier map has a smaller error.
    pub(super) fn or_better(self, before: Option<Self>) -> Self {
        let is_better = |before: &Self| before.map.knows_more_than(&self.map);
        let before = before.filter(|before| !self.map.provenance.complete && is_better(before));
        // The time is that of the whole run.
        let Self { time_s, lacked_time, .. } = self;
        before.map_or(self, |before| Self { time_s, lacked_time, ..before })
    }
}

/// The results of a run so far, made on request.
pub struct SoFar<'a> {
    pub(super) map: &'a dyn Fn() -> Option<IlluminationMap>,
    pub(super) state: &'a dyn Fn() -> Option<RunState>,
}

impl SoFar<'_> {
    /// The results while there are none.
    pub(super) const NOTHING: Self = Self { map: &|| None, state: &|| None };

    /// The present map; `None` while elements are being made.
    pub fn map(&self) -> Option<IlluminationMap> {
        (self.map)()
    }

    /// The present state; `None` if there is nothing to continue from, as in a run that ends here. A run with the same
    /// request continues from it to the same bits.
    pub fn state(&self) -> Option<RunState> {
        (self.state)()
    }
}

/// The watcher of a run. It receives the progress, may ask for results so far, and answers how the run continues.
pub type Watcher<'w> = dyn FnMut(&Progress, &SoFar<'_>) -> Watch + 'w;

/// Increments that are made elsewhere: the part of a run that begins with the increment of this number, on the mesh of
/// this pilot. A part with one increment gives the same bits as a run that makes all increments itself. `None` stops
/// the run.
pub type Elsewhere<'e> = dyn FnMut(&PilotState, u64) -> Result<Option<RunPart>, SolveError> + 'e;
