//! Why there is no file.

use crate::lightmap::LightmapFileError;
use crate::{Problem, Problems};

/// Why a scene cannot be written again with its light.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OntoError {
    /// The scene is not that of the map, or has what cannot be written.
    #[error(transparent)]
    Scene(#[from] Problems),
    /// The pages cannot be written, or the file would be too large.
    #[error(transparent)]
    File(#[from] LightmapFileError),
}

impl From<Problem> for OntoError {
    fn from(problem: Problem) -> Self {
        Self::Scene(problem.into())
    }
}
