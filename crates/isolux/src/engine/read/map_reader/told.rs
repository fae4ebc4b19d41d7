//! Readings of the indirect light of a place.

use crate::map::{Fresh, Illuminance};
use crate::units::Rgb;

/// The errors allowed in indirect light, as shares of all light there. Below things that stand on a surface, light is
/// gathered in any case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// The noise of gathered light, in place of that of readings (best effort: the number of rays is
    /// limited). Infinite: the noise of readings.
    pub noise: f64,
    /// The expected interpolation error, in place of that of readings. Where it is larger, light is gathered.
    /// Infinite: that of readings.
    pub interpolation: f64,
    /// A number that tells readings of one place apart, where [`Self::noise`] is finite: those with different numbers have
    /// independent noise.
    pub number: u64,
}

impl Allowance {
    /// The errors that the map itself allows.
    pub const ANY: Self = Self { noise: f64::INFINITY, interpolation: f64::INFINITY, number: 0 };

    /// The expected interpolation error up to which a value of the map is trusted, lx.
    pub(super) fn trusted_lx(&self, fresh: Fresh, stored: &Illuminance) -> f64 {
        if self.interpolation < f64::INFINITY {
            self.interpolation * stored.illuminance_lx()
        } else if fresh.in_gaps_alone {
            f64::INFINITY
        } else {
            fresh.above_lx.unwrap_or(f64::INFINITY)
        }
    }
}

/// The indirect light of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndirectReading {
    /// The light, lx.
    pub lx: Rgb,
    /// The standard error of its photometric value and of the caustics, as [`super::MapReader::at`] counts
    /// it, lx.
    pub error_lx: f64,
    /// The part of that error from the noise of its own rays, which no other reading shares, lx.
    pub noise_lx: f64,
}

/// The indirect light of a place as a map gives it without further rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// The light.
    Light(IndirectReading),
    /// Not trusted: light must be gathered ([`super::MapReader::indirect_at`]).
    Little {
        /// Whether something stands so close before the place that it lies in a gap.
        in_gap: bool,
    },
}
