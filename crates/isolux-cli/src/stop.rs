//! How work is stopped: it is asked to end with what it has come to, or it is left alone.

use isolux::engine::StopFlag;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is wanted of work, and whether it has something to lose. All threads of it share one.
#[derive(Debug, Default)]
pub struct Stop {
    asks: StopFlag,
    keeps: AtomicBool,
    is_left: AtomicBool,
}

/// What unwinds from work that nobody waits for.
struct Left;

impl Stop {
    /// Asks the work to end with what it has come to. Whether it was asked before.
    pub fn ask(&self) -> bool {
        self.asks.raise()
    }

    /// Whether the work is to end.
    pub fn is_asked_for(&self) -> bool {
        self.asks.is_raised()
    }

    /// The request, for the engine.
    pub(crate) fn flag(&self) -> StopFlag {
        self.asks.clone()
    }

    /// Whether the work has come to something that would be lost if it were left. At its beginning it has not.
    pub fn keeps(&self) -> bool {
        self.keeps.load(Ordering::Relaxed)
    }

    /// The work says whether it has.
    pub(crate) fn set_keeps(&self, keeps: bool) {
        self.keeps.store(keeps, Ordering::Relaxed);
    }

    /// Nobody waits for the work any more: it ends at its next look.
    pub fn leave(&self) {
        self.ask();
        self.is_left.store(true, Ordering::Relaxed);
    }

    /// Whether nobody waits for the work any more.
    pub(crate) fn is_left(&self) -> bool {
        self.is_left.load(Ordering::Relaxed)
    }

    /// Ends the work on this thread if it was left. Nobody hears of that: it unwinds without a message.
    pub(crate) fn look(&self) {
        if self.is_left() {
            resume_unwind(Box::new(Left));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::catch_unwind;

    #[test]
    fn work_that_is_left_ends_at_its_next_look() {
        let stop = Stop::default();
        stop.look();
        assert!(!stop.ask() && stop.ask());
        // It was asked, and nothing more.
        stop.look();
        stop.leave();
        let ended = catch_unwind(std::panic::AssertUnwindSafe(|| stop.look()));
        assert!(ended.is_err_and(|what| what.is::<Left>()));
    }
}
