//! Direct light where it is evaluated.

use isolux::units::Rgb;

/// The standard deviations up to which a difference may be noise.
pub(super) const DEVIATIONS: f64 = 2.5;

/// Direct light at a place.
#[derive(Clone, Copy)]
pub(super) struct Node {
    /// Direct light without caustics, lx.
    pub(super) lx: Rgb,
    /// The noise of that, lx.
    pub(super) noise_lx: f64,
    /// All light there, lx.
    pub(super) about_lx: f64,
}

impl Node {
    /// No light.
    pub(super) const DARK: Self = Self { lx: Rgb::BLACK, noise_lx: 0.0, about_lx: 0.0 };
}
