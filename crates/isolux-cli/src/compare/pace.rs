//! How long the rest will take.

use super::plan::Plan;
use crate::notes::{Note, note};
use crate::quantity::show_seconds;
use std::time::Instant;

/// What is done and what is left, for people.
pub(crate) struct Pace {
    begun: Instant,
    asked_s: f64,
    done_s: f64,
}

impl Pace {
    pub(crate) fn start(plan: &Plan) -> Self {
        Self { begun: Instant::now(), asked_s: plan.asked_s(), done_s: 0.0 }
    }

    /// Tells of a map that was made or found; what was found took no time.
    pub(crate) fn tell(&mut self, what: &str, asked_s: f64, was_made: bool) {
        if was_made {
            self.done_s += asked_s;
        } else {
            self.asked_s -= asked_s;
        }
        let elapsed_s = self.begun.elapsed().as_secs_f64();
        let left_s = match self.done_s > 0.0 {
            true => elapsed_s / self.done_s * (self.asked_s - self.done_s),
            false => self.asked_s,
        };
        let (verb, left) = (if was_made { "made" } else { "found" }, show_seconds(left_s.max(0.0)));
        note(Note::Info, format!("{what}: {verb}; {left} left"));
    }
}
