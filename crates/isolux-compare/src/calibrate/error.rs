//! What can go wrong.

use isolux::engine::SolveError;
use isolux::scene::SceneProblem;

/// Why there is no calibration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrateError {
    /// The case is not a scene: a fault of this crate.
    #[error("case `{case}` is not a scene: {problem}")]
    Scene {
        /// Its name.
        case: &'static str,
        /// The first problem.
        problem: SceneProblem,
    },
    /// The engine gave no map.
    #[error("case `{case}`: {error}")]
    Solve {
        /// Its name.
        case: &'static str,
        /// Why.
        error: SolveError,
    },
    /// The machine gave no thread.
    #[error("no thread to run on: {0}")]
    Thread(String),
}
