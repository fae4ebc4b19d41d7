//! What a server holds for all its requests.

use crate::answer::Refusal;
use crate::feed::Feed;
use crate::gate::Gate;
use crate::page::Sealed;
use crate::query;
use crate::settings::Limits;
use crate::shown::Shown;
use crate::stopping::Stopping;
use axum::http::{StatusCode, Uri};
use std::sync::Arc;
use tokio::sync::Semaphore;

const NO_WORLD: Refusal = Refusal::new(StatusCode::NOT_FOUND, "there is no such world");

/// What a server holds for all its requests.
pub(crate) struct Site {
    pub(crate) page: Sealed,
    pub(crate) feed: Feed,
    pub(crate) shown: Arc<dyn Shown>,
    pub(crate) limits: Limits,
    pub(crate) stopping: Stopping,
    /// One for each open stream of events.
    pub(crate) seats: Arc<Semaphore>,
    pub(crate) gates: Gates,
}

/// Calls of different kinds do not wait for each other.
pub(crate) struct Gates {
    pub(crate) readings: Gate,
    pub(crate) containers: Gate,
    pub(crate) controls: Gate,
}

impl Gates {
    pub(crate) fn new(limits: &Limits) -> Self {
        Self {
            readings: Gate::new(limits.readings, limits.waiting),
            containers: Gate::new(limits.containers, limits.waiting),
            controls: Gate::new(1, limits.waiting),
        }
    }
}

impl Site {
    /// Calls what is shown about a world.
    pub(crate) async fn about<T: Send + 'static>(
        &self,
        gate: &Gate,
        world: u64,
        call: impl FnOnce(&dyn Shown, usize) -> T + Send + 'static,
    ) -> Result<T, Refusal> {
        let shown = Arc::clone(&self.shown);
        let of_world = move || {
            let world = usize::try_from(world).ok().filter(|w| *w < shown.worlds())?;
            Some(call(&*shown, world))
        };
        gate.run(of_world).await?.ok_or(NO_WORLD)
    }

    /// Gets something of the world that an address names.
    pub(crate) async fn fetch<T: Send + 'static>(
        &self,
        uri: &Uri,
        call: impl FnOnce(&dyn Shown, usize) -> T + Send + 'static,
    ) -> Result<T, Refusal> {
        self.about(&self.gates.containers, query::number(uri, "world")?, call).await
    }
}
