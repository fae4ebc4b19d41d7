//! The limits on how finely a shot is received.

/// The limits of one shot, lx.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// The largest error of the light of one source.
    pub(super) tolerance_lx: f64,
    /// The largest uncertainty of the visibility of one source.
    pub(super) noise_lx: f64,
    /// The most light from one source by two rays.
    pub(super) most_lx: f64,
}
