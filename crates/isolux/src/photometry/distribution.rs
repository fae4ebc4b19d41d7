//! The closed set of intensity distributions.

use super::PhotometricWeb;
use isolux_geometry::{Direction, Vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::Arc;

/// Luminous intensity as a function of direction, candela.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IntensityDistribution {
    /// The same in every direction.
    Isotropic {
        /// Intensity, cd.
        intensity_cd: f64,
    },
    /// `peak cos^exponent(gamma)` below, nothing above the horizontal.
    CosinePower {
        /// Intensity at nadir, cd.
        peak_cd: f64,
        /// Exponent n >= 0; 1 is a small Lambertian emitter.
        exponent: f64,
    },
    /// Full intensity inside the inner cone, none outside the outer, smooth between: the square of
    /// a linear ramp in cos(gamma), as glTF's KHR_lights_punctual recommends.
    Spot {
        /// Intensity at nadir, cd.
        peak_cd: f64,
        /// Half angle of full intensity, rad.
        inner_rad: f64,
        /// Half angle of no intensity, rad.
        outer_rad: f64,
    },
    /// A measured table (IES LM-63, EULUMDAT).
    Web(Arc<PhotometricWeb>),
}

impl IntensityDistribution {
    /// Intensity in a direction of the luminaire's frame, cd.
    pub fn intensity_cd(&self, local: Direction) -> f64 {
        let cos_gamma = -local.to_vector().z;
        match self {
            Self::Isotropic { intensity_cd } => *intensity_cd,
            Self::CosinePower { peak_cd, exponent } => {
                if cos_gamma > 0.0 {
                    peak_cd * libm::pow(cos_gamma, *exponent)
                } else {
                    0.0
                }
            }
            Self::Spot { peak_cd, inner_rad, outer_rad } => {
                let (inner, outer) = (libm::cos(*inner_rad), libm::cos(*outer_rad));
                let ramp = if cos_gamma >= inner {
                    1.0
                } else if cos_gamma <= outer {
                    0.0
                } else {
                    (cos_gamma - outer) / (inner - outer)
                };
                peak_cd * ramp * ramp
            }
            Self::Web(web) => web.intensity_cd(local),
        }
    }

    /// Luminous flux over the whole sphere, lm: the exact integral of the distribution.
    pub fn luminous_flux_lm(&self) -> f64 {
        match self {
            Self::Isotropic { intensity_cd } => 4.0 * PI * intensity_cd,
            Self::CosinePower { peak_cd, exponent } => 2.0 * PI * peak_cd / (exponent + 1.0),
            Self::Spot { peak_cd, inner_rad, outer_rad } => {
                // In c = cos(gamma): a plateau of 1 - inner and a squared ramp, a third of its base.
                let (inner, outer) = (libm::cos(*inner_rad), libm::cos(*outer_rad));
                2.0 * PI * peak_cd * ((1.0 - inner) + (inner - outer) / 3.0)
            }
            Self::Web(web) => web.luminous_flux_lm(),
        }
    }

    /// A direction distributed in proportion to intensity, from two numbers of [0, 1). The flux it
    /// carries is the whole flux; the density is `intensity / flux`. `None` if there is no flux.
    pub fn sample(&self, [a, b]: [f64; 2]) -> Option<Direction> {
        let around = |cos_gamma: f64| {
            let sin_gamma = (1.0 - cos_gamma * cos_gamma).max(0.0).sqrt();
            let (s, c) = libm::sincos(2.0 * PI * b);
            Vector::new(sin_gamma * c, sin_gamma * s, -cos_gamma).direction()
        };
        match self {
            Self::Isotropic { .. } => around(1.0 - 2.0 * a),
            Self::CosinePower { exponent, .. } => {
                around(libm::pow(1.0 - a, 1.0 / (exponent + 1.0)))
            }
            Self::Spot { inner_rad, outer_rad, .. } => {
                let (inner, outer) = (libm::cos(*inner_rad), libm::cos(*outer_rad));
                let (plateau, ramp) = (1.0 - inner, (inner - outer) / 3.0);
                let at = a * (plateau + ramp);
                around(if at < plateau {
                    1.0 - at
                } else {
                    outer + (inner - outer) * libm::cbrt(1.0 - (at - plateau) / ramp)
                })
            }
            Self::Web(web) => web.sample([a, b]),
        }
    }

    /// The same distribution with every intensity multiplied by a factor >= 0.
    pub fn scaled(&self, factor: f64) -> Self {
        match self.clone() {
            Self::Isotropic { intensity_cd } => {
                Self::Isotropic { intensity_cd: intensity_cd * factor }
            }
            Self::CosinePower { peak_cd, exponent } => {
                Self::CosinePower { peak_cd: peak_cd * factor, exponent }
            }
            Self::Spot { peak_cd, inner_rad, outer_rad } => {
                Self::Spot { peak_cd: peak_cd * factor, inner_rad, outer_rad }
            }
            Self::Web(web) => Self::Web(Arc::new(web.scaled(factor))),
        }
    }
}
