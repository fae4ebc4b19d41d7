//! What is told of the indirect light of a place.

use crate::map::Illuminance;
use crate::units::Rgb;

/// What indirect light may err by where it is read, as shares of the light there; the map, and what gathering takes its noise down to,
/// may ask for less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowance {
    /// Noise of what is gathered, of the indirect light (best effort: rays are limited).
    pub noise: f64,
    /// What interpolation is expected to err by, of all light: where that is more, light is gathered.
    pub interpolation: f64,
}

impl Allowance {
    /// As the map has it.
    pub const ANY: Self = Self { noise: f64::INFINITY, interpolation: f64::INFINITY };

    /// Whether interpolation is expected to err by no more where the map tells so much light.
    pub(super) fn includes(&self, stored: &Illuminance) -> bool {
        // Any share of no light is allowed, too.
        self.interpolation == f64::INFINITY
            || stored.interpolation_error_lx <= self.interpolation * stored.illuminance_lx()
    }
}

/// Indirect light of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IndirectReading {
    /// The light, lx.
    pub lx: Rgb,
    /// Standard error of its photometric value and of the caustics, as [`super::MapReader::at`] counts it, lx.
    pub error_lx: f64,
    /// What of that is the noise of its own rays, which no other reading shares, lx.
    pub noise_lx: f64,
}

/// What a map tells of the indirect light of a place without further rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Told {
    /// The light.
    Light(IndirectReading),
    /// Nothing to be trusted: it is to be gathered ([`super::MapReader::indirect_at`]).
    Little {
        /// Whether something stands so close before the place that it lies in a gap.
        in_gap: bool,
    },
}
