//! The end of the time for a computation.

use std::time::Instant;

/// The end of the time allowed; the first survey and increments check it while they run. None means no limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(pub(crate) Option<Instant>);

impl Deadline {
    /// No deadline, for work that always runs to its end.
    pub(crate) const NEVER: Self = Self(None);

    /// Whether the deadline has passed.
    pub(crate) fn has_passed(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }

    /// The share of some work of this duration, s, that the time left allows, at most one.
    pub(crate) fn share_of(self, work_s: f64) -> f64 {
        let Some(end) = self.0 else { return 1.0 };
        let left_s = end.saturating_duration_since(Instant::now()).as_secs_f64();
        if left_s < work_s { left_s / work_s } else { 1.0 }
    }
}
