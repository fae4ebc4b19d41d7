//! Calls that may take long, few of them at once.

use crate::answer::Refusal;
use axum::http::StatusCode;
use std::sync::Arc;
use tokio::sync::Semaphore;
use tokio::task::spawn_blocking;

const BUSY: Refusal =
    Refusal::new(StatusCode::SERVICE_UNAVAILABLE, "too many ask at once: try again");
const FAILED: Refusal = Refusal::new(
    StatusCode::INTERNAL_SERVER_ERROR,
    "this could not be computed: the program has said why where it was started",
);

/// Lets few calls through at once, and few wait.
pub(crate) struct Gate {
    /// Calls that run.
    runs: Arc<Semaphore>,
    /// Calls that run or wait.
    stays: Arc<Semaphore>,
}

impl Gate {
    /// For at least one call at once.
    pub(crate) fn new(at_once: u16, waiting: u16) -> Self {
        let at_once = usize::from(at_once.max(1));
        let permits = |n| Arc::new(Semaphore::new(n));
        Self { runs: permits(at_once), stays: permits(at_once + usize::from(waiting)) }
    }

    /// Runs a call on a thread that may wait. A call that has begun keeps its place to its end,
    /// even if nobody waits for it any longer.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        call: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Refusal> {
        let stay = Arc::clone(&self.stays).try_acquire_owned().map_err(|_| BUSY)?;
        let run = Arc::clone(&self.runs).acquire_owned().await.map_err(|_| BUSY)?;
        let held = move || {
            let _places = (stay, run);
            call()
        };
        spawn_blocking(held).await.map_err(|_| FAILED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    fn runtime() -> tokio::runtime::Runtime {
        tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap()
    }

    #[test]
    fn results_come_back_and_panics_are_refusals() {
        runtime().block_on(async {
            let gate = Gate::new(1, 0);
            assert_eq!(gate.run(|| 7).await.unwrap(), 7);
            let failed = gate.run(|| panic!("on purpose")).await;
            assert_eq!(failed.unwrap_err().status, StatusCode::INTERNAL_SERVER_ERROR);
            assert_eq!(gate.run(|| 8).await.unwrap(), 8);
        });
    }

    #[test]
    fn one_runs_one_waits_and_the_third_is_turned_away() {
        let (go, wait) = channel::<()>();
        runtime().block_on(async {
            let gate = Arc::new(Gate::new(1, 1));
            let first = tokio::spawn({
                let gate = Arc::clone(&gate);
                async move { gate.run(move || wait.recv().is_ok()).await }
            });
            let second = tokio::spawn({
                let gate = Arc::clone(&gate);
                async move { gate.run(|| true).await }
            });
            tokio::time::sleep(Duration::from_millis(10)).await;
            let third = gate.run(|| true).await;
            assert_eq!(third.unwrap_err().status, StatusCode::SERVICE_UNAVAILABLE);
            assert!(!second.is_finished());
            go.send(()).unwrap();
            assert!(first.await.unwrap().unwrap() && second.await.unwrap().unwrap());
        });
    }

    #[test]
    fn who_leaves_frees_no_place_before_the_call_ends() {
        let (go, wait) = channel::<()>();
        runtime().block_on(async {
            let gate = Gate::new(1, 0);
            let call = gate.run(move || wait.recv());
            assert!(tokio::time::timeout(Duration::from_millis(10), call).await.is_err());
            assert!(gate.run(|| ()).await.is_err());
            go.send(()).unwrap();
        });
    }
}
