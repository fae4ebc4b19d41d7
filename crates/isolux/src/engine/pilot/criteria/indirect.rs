//! The interpolation error of indirect light for one kind of reading.

use super::{Criterion, Marked, Rounds, Which};
use crate::engine::pilot::forecast::GoOn;
use crate::engine::pilot::look::{PilotRequest, ReadFor, Survey};
use crate::engine::pilot::state::{MAX_ROUNDS, Pilot};

/// The least order of convergence, in the number of vertices, at which a round counts as progress. For smooth
/// functions the order is one. It is lower for some rounds where light enters through narrow places.
const LEAST_PROGRESS_ORDER: f64 = 0.25;
/// The largest number of rounds in which errors may rise because light was found in gaps.
const MOST_RISEN_ROUNDS: usize = 3;

/// The criterion for one kind of reading.
pub(crate) struct IndirectError {
    what: ReadFor,
    max_vertices: usize,
    /// The excess and the number of carriers one round ago.
    before: Option<(f64, f64)>,
    risen: usize,
    rounds: Rounds,
}

impl IndirectError {
    pub(crate) const fn of(what: ReadFor, max_vertices: usize) -> Self {
        Self { what, max_vertices, before: None, risen: 0, rounds: Rounds::at_most(MAX_ROUNDS) }
    }

    /// Whether the last round made no progress. While rounds find light in gaps, errors may rise.
    fn has_stalled(&mut self, excess: f64, carriers: f64, sees_lit_gaps: bool) -> bool {
        let Some((excess_before, carriers_before)) = self.before else { return false };
        let has_risen = sees_lit_gaps && excess > excess_before;
        self.risen += usize::from(has_risen);
        let is_excused = has_risen && self.risen <= MOST_RISEN_ROUNDS;
        let fallen = libm::pow(carriers_before / carriers, LEAST_PROGRESS_ORDER);
        !is_excused && excess > excess_before * fallen
    }
}

impl Criterion for IndirectError {
    fn marked(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        _go_on: &mut GoOn<'_>,
    ) -> Option<Marked> {
        let (errors, excess) = look.excess(self.what, request)?;
        let carriers = look.carriers as f64;
        // Where bisection no longer helps, the rest is noise, which check points measure.
        let has_stalled = self.has_stalled(excess, carriers, pilot.indirect.sees_lit_gaps);
        if !self.rounds.go_on(has_stalled) {
            return None;
        }
        let excesses = (Some(look.greatest_excess(request)), self.before);
        self.before = Some((excess, carriers));
        let which = Which::Worst { errors, wanted: 1.0 / excess, activates: true };
        Some(Marked { which, excess: Some(excesses), max_vertices: self.max_vertices })
    }
}
