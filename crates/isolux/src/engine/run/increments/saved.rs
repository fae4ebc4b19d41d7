//! Sums that are taken out of a run, and put back into one.

use super::super::part::Segment;
use super::super::request::SolveError;
use super::super::state::RunState;
use super::{Engine, Work};
use crate::engine::ray::{Accumulator, Sums};

impl Work<'_, '_> {
    /// The number of receivers.
    pub(crate) fn receivers(&self) -> u64 {
        self.sums.sums.len() as u64
    }

    /// Begins with an increment in place of the first one, without sums, and to end before another.
    pub(crate) fn begin_at(&mut self, first: u64, end: u64) {
        self.first = first;
        self.sums.clear();
        self.checks.sums.clear();
        self.checks.lacking.clear();
        self.given_up.clear();
        if let Engine::Hybrid(hybrid) = &mut self.engine {
            hybrid.begin_at(end);
        }
    }

    /// Takes the sums since the increments began, and goes on without them.
    pub(crate) fn take(&mut self, rays: u64) -> Segment {
        let (first, count) = (self.first, self.sums.increments);
        self.first += count;
        let given_up = self.given_up.clear();
        let [receivers, checks, lacking] =
            [&mut self.sums, &mut self.checks.sums, &mut self.checks.lacking]
                .map(Accumulator::clear);
        Segment { first, count, rays, receivers, checks: [checks, lacking].concat(), given_up }
    }

    /// Adds increments made elsewhere. The error names what has another size than here.
    pub(crate) fn add(&mut self, made: &Segment) -> Result<(), SolveError> {
        self.merge([&made.receivers, &made.checks, &made.given_up], made.count)
    }

    /// Adds the increments of a saved run to none.
    pub(crate) fn restore(&mut self, saved: &RunState) -> Result<(), SolveError> {
        self.merge([&saved.receivers, &saved.checks, &saved.given_up], saved.increments)?;
        self.look_what_is_left();
        Ok(())
    }

    /// Adds sums of receivers, of check points with parts of elements, and of the light given up.
    fn merge(
        &mut self,
        [receivers, checks, given_up]: [&[Sums]; 3],
        increments: u64,
    ) -> Result<(), SolveError> {
        let (checks, lacking) = checks
            .split_at_checked(self.checks.sums.sums.len())
            .ok_or(SolveError::OtherRun("the number of check points"))?;
        let into = [
            (&mut self.sums, receivers, "the number of receivers"),
            (&mut self.checks.sums, checks, "the number of check points"),
            (&mut self.checks.lacking, lacking, "the number of checked elements"),
            (&mut self.given_up, given_up, "the sum of the light given up"),
        ];
        for (sums, more, what) in into {
            sums.merge(more, increments).map_err(|_| SolveError::OtherRun(what))?;
        }
        Ok(())
    }
}
