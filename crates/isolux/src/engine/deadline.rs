//! When to give up work in hand.

use std::time::Instant;

/// The end of the time allowed, asked for in the midst of an increment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deadline(pub(super) Option<Instant>);

impl Deadline {
    /// For what is always finished.
    pub(super) const NEVER: Self = Self(None);

    /// Whether it is over.
    pub(super) fn has_passed(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
