//! What nobody reads finer.

/// Illuminances, lx.
pub(super) const LEAST_LX: f64 = 0.5;
/// Ratios.
pub(super) const LEAST_RATIO: f64 = 0.02;
