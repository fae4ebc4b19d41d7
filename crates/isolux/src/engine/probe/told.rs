//! What is told of the indirect light of a place.

use crate::units::Rgb;

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
