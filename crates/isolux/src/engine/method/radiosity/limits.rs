//! How finely a shot is received.

/// The limits of shots, in lux.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// What the light of a source may be off by.
    pub(super) tolerance_lx: f64,
    /// What the visibility of one source may be in doubt by.
    pub(super) noise_lx: f64,
    /// What one source may bring by two rays.
    pub(super) most_lx: f64,
}
