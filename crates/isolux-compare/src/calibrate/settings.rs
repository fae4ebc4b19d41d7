//! What is run.

use isolux::engine::SolveRequest;
use std::time::Duration;

/// What is run.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibrateSettings {
    /// Accuracy that runs stop at, a fraction.
    pub accuracy: f64,
    /// Longest run, past its stop too.
    pub time_limit: Duration,
    /// Memory allowed for all runs at a time, bytes.
    pub max_memory_bytes: u64,
    /// Runs at a time, each on one thread.
    pub threads: usize,
}

impl Default for CalibrateSettings {
    /// Two per cent: coarse, where the errors that noise does not tell matter most, and cheap.
    fn default() -> Self {
        Self {
            accuracy: 0.02,
            time_limit: Duration::from_secs(60),
            max_memory_bytes: SolveRequest::default().max_memory_bytes,
            threads: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}
