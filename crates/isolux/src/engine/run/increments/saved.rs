//! Sums that are taken out of a run, and put back into one.

use super::super::part::Segment;
use super::super::request::SolveError;
use super::super::state::{RunState, restore};
use super::{Engine, Work};
use crate::engine::ray::Accumulator;

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
        let (checks, lacking) = made
            .checks
            .split_at_checked(self.checks.sums.sums.len())
            .ok_or(SolveError::OtherRun("the number of check points"))?;
        let into = [
            (&mut self.sums, made.receivers.as_slice(), "the number of receivers"),
            (&mut self.checks.sums, checks, "the number of check points"),
            (&mut self.checks.lacking, lacking, "the number of checked elements"),
            (&mut self.given_up, &made.given_up, "the sum of the light given up"),
        ];
        for (sums, made_sums, what) in into {
            sums.merge(made_sums, made.count).map_err(|_| SolveError::OtherRun(what))?;
        }
        Ok(())
    }

    pub(crate) fn restore(&mut self, saved: &RunState) -> Result<(), SolveError> {
        restore(&mut self.sums, &saved.receivers, saved.increments)?;
        let (checks, lacking) = saved
            .checks
            .split_at_checked(self.checks.sums.sums.len())
            .ok_or(SolveError::OtherRun("the number of check points"))?;
        restore(&mut self.checks.sums, checks, saved.increments)?;
        restore(&mut self.checks.lacking, lacking, saved.increments)?;
        restore(&mut self.given_up, &saved.given_up, saved.increments)?;
        self.look_what_is_left();
        Ok(())
    }
}
