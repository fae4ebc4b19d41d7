//! The word that the server is to stop.

use std::sync::Arc;
use tokio::sync::watch;

/// Stops a server from any thread. Clones stop the same server.
#[derive(Clone, Debug)]
pub struct Stopper(Arc<watch::Sender<bool>>);

impl Stopper {
    pub(crate) fn new() -> Self {
        Self(Arc::new(watch::Sender::new(false)))
    }

    /// Tells the server to stop, and waits for nothing.
    pub fn stop(&self) {
        self.0.send_replace(true);
    }

    pub(crate) fn stopping(&self) -> Stopping {
        Stopping(self.0.subscribe())
    }
}

/// Hears when the server is to stop.
#[derive(Clone)]
pub(crate) struct Stopping(watch::Receiver<bool>);

impl Stopping {
    /// Waits for the word. Without anybody left to say it, it is as good as said.
    pub(crate) async fn told(&mut self) {
        let _ = self.0.wait_for(|is_told| *is_told).await;
    }
}
