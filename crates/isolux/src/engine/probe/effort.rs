//! How many rays gathering takes where the map is not to be trusted.

/// Independent gatherings of a place where the map is not trusted, and rays of each, at least and at most.
pub(super) const FRESH_REPLICATES: u32 = 16;
pub(super) const FRESH_FEWEST_RAYS: f64 = 8.0;
pub(super) const FRESH_MOST_RAYS: f64 = 1024.0;

/// Of readings: noise may be any share of the light.
pub(super) const ANY_NOISE: f64 = f64::INFINITY;

/// Rays of each in the trial that tells how many it takes: half of the fewest, as they are thrown away.
pub(super) const TRIAL_RAYS: u32 = 4;

/// What a reading takes, as a trial tells.
pub(super) struct Needed {
    /// Rays of a replicate.
    pub(super) rays: u32,
    /// Of the mean of replicates, expected, lx2.
    pub(super) variance: f64,
}
