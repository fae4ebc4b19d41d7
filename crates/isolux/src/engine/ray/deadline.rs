//! The end of the time for a computation.

use std::time::Instant;

/// The end of the time allowed; increments check it while they run. None means no limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(pub(crate) Option<Instant>);

impl Deadline {
    /// No deadline, for work that always runs to its end.
    pub(crate) const NEVER: Self = Self(None);

    /// Whether the deadline has passed.
    pub(crate) fn has_passed(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
