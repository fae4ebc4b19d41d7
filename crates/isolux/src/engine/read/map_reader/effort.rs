//! How many rays gathering takes where the map is not to be trusted.

/// Independent gatherings of a place where the map is not trusted, and rays of each, at least and at most.
pub(super) const FRESH_REPLICATES: u32 = 16;
pub(super) const FRESH_FEWEST_RAYS: f64 = 8.0;
pub(super) const FRESH_MOST_RAYS: f64 = 1024.0;

/// The standard error by their spread, which is found too small as often as too large: 1.96 of it hold the truth in 93 % of
/// cases, of so much more in 95 % (quantiles of Student's distribution with 15 degrees of freedom and of the normal one).
pub(super) const OF_FEW: f64 = 2.131 / 1.96;

/// Rays of each in the trial that tells how many it takes: half of the fewest, as they are thrown away.
pub(super) const TRIAL_RAYS: u32 = 4;

/// What a reading takes, as a trial tells.
pub(super) struct Needed {
    /// Rays of a replicate.
    pub(super) rays: u32,
    /// Of the mean of replicates, expected, lx2.
    pub(super) variance: f64,
}

/// Rays that look about from a place in space: one that sees light in a fifth of its hemisphere is taken to be
/// inside something once in a thousand times.
pub(super) const LOOKS: u32 = 32;
