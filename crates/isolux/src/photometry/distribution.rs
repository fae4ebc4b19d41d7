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
                let (plateau, ramp) = spot_caps(*inner_rad, *outer_rad);
                let beyond = (1.0 - cos_gamma) - plateau;
                let left = if beyond <= 0.0 { 1.0 } else { (1.0 - beyond / ramp).max(0.0) };
                peak_cd * left * left
            }
            Self::Web(web) => web.intensity_cd(local),
        }
    }

    /// Highest intensity in any direction, cd.
    pub fn max_intensity_cd(&self) -> f64 {
        match self {
            Self::Isotropic { intensity_cd } => *intensity_cd,
            Self::CosinePower { peak_cd, .. } | Self::Spot { peak_cd, .. } => *peak_cd,
            Self::Web(web) => web.max_intensity_cd(),
        }
    }

    /// Luminous flux over the whole sphere, lm: the exact integral of the distribution.
    pub fn luminous_flux_lm(&self) -> f64 {
        match self {
            Self::Isotropic { intensity_cd } => 4.0 * PI * intensity_cd,
            Self::CosinePower { peak_cd, exponent } => 2.0 * PI * peak_cd / (exponent + 1.0),
            Self::Spot { peak_cd, inner_rad, outer_rad } => {
                let (plateau, ramp) = spot_caps(*inner_rad, *outer_rad);
                2.0 * PI * peak_cd * (plateau + ramp / 3.0)
            }
            Self::Web(web) => web.luminous_flux_lm(),
        }
    }

    /// A direction distributed in proportion to intensity, from two numbers of [0, 1): `a` chooses
    /// gamma, `b` chooses C. The flux it carries is the whole flux; the density is
    /// `intensity / flux` per steradian. `None` if there is no flux.
    pub fn sample(&self, [a, b]: [f64; 2]) -> Option<Direction> {
        let lit = self.luminous_flux_lm() > 0.0;
        if !lit {
            return None;
        }
        match self {
            Self::Isotropic { .. } => at_cap(2.0 * a, b),
            Self::CosinePower { exponent, .. } => {
                // 1 - (1 - a)^(1 / (n + 1)), to the last digit for narrow beams too.
                at_cap(-libm::expm1(libm::log1p(-a) / (exponent + 1.0)), b)
            }
            Self::Spot { inner_rad, outer_rad, .. } => {
                let (plateau, ramp) = spot_caps(*inner_rad, *outer_rad);
                let cap = a * (plateau + ramp / 3.0);
                if cap < plateau {
                    at_cap(cap, b)
                } else {
                    let left = (1.0 - 3.0 * (cap - plateau) / ramp).max(0.0);
                    at_cap(plateau + ramp * (1.0 - libm::cbrt(left)), b)
                }
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

/// `1 - cos` of the inner angle and how much more that of the outer angle is: solid angles over
/// 2 pi, without the cancellation that a cosine near 1 would bring.
fn spot_caps(inner_rad: f64, outer_rad: f64) -> (f64, f64) {
    let cap = |angle: f64| {
        let sine = libm::sin(0.5 * angle);
        2.0 * sine * sine
    };
    (cap(inner_rad), cap(outer_rad) - cap(inner_rad))
}

/// The direction with `1 - cos(gamma) = cap` and C a share of the turn.
fn at_cap(cap: f64, share: f64) -> Option<Direction> {
    let sin_gamma = (cap * (2.0 - cap)).max(0.0).sqrt();
    let (sin_c, cos_c) = libm::sincos(2.0 * PI * share);
    Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, cap - 1.0).direction()
}
