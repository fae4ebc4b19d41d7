//! The kinds of error that elements are bisected for.
//!
//! A criterion tells the elements to bisect from the mesh and its light, and brings the light to the bisected mesh. It
//! knows neither the loop that calls it nor the other criteria.

mod batches;
mod caustics;
mod direct;
mod hidden;
mod indirect;

pub(super) use caustics::{CausticErrors, Caustics};
pub(super) use direct::DirectError;
pub(super) use hidden::Hidden;
pub(super) use indirect::IndirectError;

use super::forecast::{Excess, GoOn};
use super::look::{PilotRequest, Survey};
use super::state::{MOST_STALLS, Pilot};
use crate::engine::mesh::LeafError;

/// A kind of error that elements are bisected for.
pub(super) trait Criterion {
    /// The elements to bisect; `None` where the error meets its goal, bisection makes no progress, or rounds are used up.
    fn marked(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Option<Marked>;

    /// Brings the survey and the light of the pilot to the elements just bisected: by a survey, unless a criterion
    /// needs less. Some of the light may be left to
    /// [`Criterion::end`].
    fn follow(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        *look = pilot.look(request, go_on);
    }

    /// Completes the light after the last round.
    fn end(&mut self, _pilot: &mut Pilot<'_>, _look: &Survey, _request: &PilotRequest) {}
}

/// The rounds of a criterion, which end after too many, or after several in a row without progress.
pub(super) struct Rounds {
    left: usize,
    /// The number of successive rounds without progress.
    stalls: usize,
}

impl Rounds {
    pub(super) const fn at_most(left: usize) -> Self {
        Self { left, stalls: 0 }
    }

    /// Whether there is another round, after one that may have stalled.
    pub(super) const fn go_on(&mut self, has_stalled: bool) -> bool {
        self.stalls = if has_stalled { self.stalls + 1 } else { 0 };
        let goes_on = self.left > 0 && self.stalls <= MOST_STALLS;
        self.left = self.left.saturating_sub(1);
        goes_on
    }
}

/// The elements to bisect in a round.
pub(super) struct Marked {
    pub(super) which: Which,
    /// The ratio of the error to its goal, for the prediction of the remaining time; `None` where the criterion has
    /// asked for time itself.
    pub(super) excess: Option<Excess>,
    /// The number of vertices above which no element is bisected.
    pub(super) max_vertices: usize,
}

/// The choice of elements to bisect.
pub(super) enum Which {
    /// The elements with the worst of these errors: as many as bring the error down to `wanted` of its present size,
    /// but no more than a share of all. With `activates`, waiting vertices become carriers instead.
    Worst { errors: Vec<LeafError>, wanted: f64, activates: bool },
    /// All of these nodes, bisected once or twice, until the mesh is full.
    Nodes { once: Vec<u32>, twice: Vec<u32> },
}
