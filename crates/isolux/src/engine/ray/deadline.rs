//! When to give up work in hand.

use std::time::Instant;

/// The end of the time allowed, asked for in the midst of an increment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(pub(crate) Option<Instant>);

impl Deadline {
    /// For what is always finished.
    pub(crate) const NEVER: Self = Self(None);

    /// Whether it is over.
    pub(crate) fn has_passed(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
