//! Ctrl-C and termination while something is made that can be kept.

pub(crate) mod signals;

use crate::caller;
use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::stop::Stop;
use isolux::engine::StopFlag;
use std::sync::{Arc, OnceLock};

/// The one that listens, from the first run on.
static INSTALLED: OnceLock<Interrupt> = OnceLock::new();

/// Whether the user wants the run to end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt(Arc<Stop>);

impl Interrupt {
    /// From now on the first signal asks for an end with a valid map, the second ends at once. Runs
    /// one after another have one in common: who was stopped in one does not begin another.
    pub(crate) fn install() -> Result<Self, Failure> {
        let interrupt = Self::listening()?;
        interrupt.has_more_to_keep();
        Ok(interrupt)
    }

    fn listening() -> Result<Self, Failure> {
        if let Some(call) = caller::here() {
            // Nothing is begun for nobody.
            call.stop().look();
            return Ok(Self(call.stop()));
        }
        if let Some(installed) = INSTALLED.get() {
            return Ok(installed.clone());
        }
        let stop = Arc::<Stop>::default();
        let of_handler = Arc::clone(&stop);
        let handler = move || {
            if of_handler.ask() || !of_handler.keeps() {
                std::process::exit(130);
            }
            note(
                Note::Info,
                "stopping as soon as the work so far is saved; press Ctrl-C again to stop at once",
            );
        };
        // The handler may be called at once.
        stop.set_keeps(true);
        signals::listen(handler)
            .map_err(|e| Failure::Refused(format!("cannot listen to signals: {e}")))?;
        Ok(INSTALLED.get_or_init(|| Self(stop)).clone())
    }

    /// Whether a signal has arrived.
    pub(crate) fn is_requested(&self) -> bool {
        self.0.is_asked_for()
    }

    /// The request to end, for the engine, which heeds it within its steps.
    pub(crate) fn flag(&self) -> StopFlag {
        self.0.flag()
    }

    /// From now on the first signal asks for an end: something is being made that can be kept.
    pub(crate) fn has_more_to_keep(&self) {
        self.0.set_keeps(true);
    }

    /// From now on the next signal ends at once: all that could be kept is.
    pub(crate) fn has_nothing_more_to_keep(&self) {
        self.0.set_keeps(false);
    }
}
