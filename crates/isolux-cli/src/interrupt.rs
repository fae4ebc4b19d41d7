//! Ctrl-C and termination while a map is computed.

use crate::caller;
use crate::failure::Failure;
use crate::notes::{Note, note};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

/// The one that listens, from the first run on.
static INSTALLED: OnceLock<Interrupt> = OnceLock::new();

/// Whether the user wants the run to end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt {
    is_requested: Arc<AtomicBool>,
    ends_at_once: Arc<AtomicBool>,
}

impl Interrupt {
    /// From now on the first signal asks for an end with a valid map, the second ends at once. Runs
    /// one after another have one in common: who was stopped in one does not begin another.
    pub(crate) fn install() -> Result<Self, Failure> {
        if let Some(call) = caller::here() {
            return Ok(Self { is_requested: call.wants_end(), ends_at_once: Arc::default() });
        }
        if let Some(installed) = INSTALLED.get() {
            return Ok(installed.clone());
        }
        let interrupt = Self::default();
        let Self { is_requested, ends_at_once } = interrupt.clone();
        let handler = move || {
            if is_requested.swap(true, Ordering::Relaxed) || ends_at_once.load(Ordering::Relaxed) {
                std::process::exit(130);
            }
            note(
                Note::Info,
                "stopping as soon as the work so far is saved; press Ctrl-C again to stop at once",
            );
        };
        ctrlc::set_handler(handler)
            .map_err(|e| Failure::Refused(format!("cannot listen to Ctrl-C: {e}")))?;
        Ok(INSTALLED.get_or_init(|| interrupt).clone())
    }

    /// Whether a signal has arrived.
    pub(crate) fn is_requested(&self) -> bool {
        self.is_requested.load(Ordering::Relaxed)
    }

    /// From now on the first signal asks for an end again: something is being made that can be kept.
    pub(crate) fn has_more_to_keep(&self) {
        self.ends_at_once.store(false, Ordering::Relaxed);
    }

    /// From now on the next signal ends at once: all that could be kept is.
    pub(crate) fn has_nothing_more_to_keep(&self) {
        self.ends_at_once.store(true, Ordering::Relaxed);
    }
}
