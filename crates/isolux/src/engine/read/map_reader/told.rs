//! Readings of the indirect light of a place.

use crate::map::Illuminance;
use crate::units::Rgb;

/// The errors allowed in indirect light, as shares of the light there. The trust and the noise goal of the
/// map may be stricter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// The noise of gathered light, as a share of indirect light (best effort: the number of rays is
    /// limited).
    pub noise: f64,
    /// The expected interpolation error, as a share of all light. Where it is larger, light is gathered.
    pub interpolation: f64,
}

impl Allowance {
    /// The errors that the map itself allows.
    pub const ANY: Self = Self { noise: f64::INFINITY, interpolation: f64::INFINITY };

    /// Whether the expected interpolation error of a value of the map is allowed.
    pub(super) fn includes(&self, stored: &Illuminance) -> bool {
        // A value of zero is allowed, too.
        self.interpolation == f64::INFINITY
            || stored.interpolation_error_lx <= self.interpolation * stored.illuminance_lx()
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
