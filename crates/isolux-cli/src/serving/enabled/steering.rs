//! What viewers want of a run.

use isolux_serve::Control;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// How often a paused run looks whether it was interrupted.
const LOOKS: Duration = Duration::from_millis(100);

/// Wishes of viewers, which the run looks at between two pieces of work.
#[derive(Default)]
pub(super) struct Steering {
    wishes: Mutex<Wishes>,
    changed: Condvar,
}

/// What is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Wishes {
    /// To rest.
    pub(super) paused: bool,
    /// To end with what there is.
    pub(super) stopped: bool,
    /// Another accuracy.
    pub(super) target: Option<f64>,
}

impl Steering {
    /// Takes a wish.
    pub(super) fn take(&self, what: Control) {
        let mut wishes = self.lock();
        match what {
            Control::Pause => wishes.paused = true,
            Control::Resume => wishes.paused = false,
            Control::Stop => *wishes = Wishes { stopped: true, paused: false, ..*wishes },
            Control::Target { accuracy } => {
                *wishes = Wishes { target: Some(accuracy), paused: false, ..*wishes };
            }
        }
        drop(wishes);
        self.changed.notify_all();
    }

    /// What is wanted now.
    pub(super) fn wishes(&self) -> Wishes {
        *self.lock()
    }

    /// The accuracy that is wanted, once.
    pub(super) fn take_target(&self) -> Option<f64> {
        self.lock().target.take()
    }

    /// Waits while a rest is wanted and nobody interrupts; how long that was.
    pub(super) fn wait_while_paused(&self, is_interrupted: &dyn Fn() -> bool) -> Duration {
        let started = Instant::now();
        let mut wishes = self.lock();
        if !wishes.paused {
            return Duration::ZERO;
        }
        while wishes.paused && !is_interrupted() {
            let waited = self.changed.wait_timeout(wishes, LOOKS);
            wishes = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        started.elapsed()
    }

    fn lock(&self) -> MutexGuard<'_, Wishes> {
        self.wishes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
