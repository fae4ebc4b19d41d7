//! What can go wrong.

use crate::validate::ValidateError;

/// Why there is no calibration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrateError {
    /// A run of a case failed.
    #[error(transparent)]
    Case(#[from] ValidateError),
    /// The machine gave no thread.
    #[error("no thread to run on: {0}")]
    Thread(String),
}
