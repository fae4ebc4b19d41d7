//! The numbers of rays and replicates for gathering where the map is not trusted.

/// The number of independent replicates that gather at a place where the map is not trusted.
pub(super) const FRESH_REPLICATES: u32 = 16;
/// The fewest rays of a replicate.
pub(super) const FRESH_FEWEST_RAYS: f64 = 8.0;
/// The most rays of a replicate.
pub(super) const FRESH_MOST_RAYS: f64 = 1024.0;

/// The factor on a standard error from 16 replicates. Intervals of 1.96 of them hold the truth in 93 % of
/// cases, with this factor in 95 % (quantiles of Student's distribution with 15 degrees of freedom and of the
/// normal one).
pub(super) const OF_FEW: f64 = 2.131 / 1.96;

/// The number of rays of a replicate in the trial that measures noise: half of the fewest, since the trial is
/// discarded, where the map has a value.
pub(super) const TRIAL_RAYS: u32 = 4;

/// The same in free space, where the map has no value to tell how much few rays may miss: with all replicates 1024 rays. They miss what
/// fills a three-hundredth of the view once in thirty times.
pub(super) const TRIAL_RAYS_IN_SPACE: u32 = 64;

/// The effort of a reading, from a trial.
pub(super) struct Needed {
    /// The number of rays of a replicate.
    pub(super) rays: u32,
    /// The expected variance of the mean of all replicates, lx2.
    pub(super) variance: f64,
}

/// The number of rays that test the view of a place in space. A place that sees light in a fifth of its
/// hemisphere is taken to be inside something once in a thousand times.
pub(super) const LOOKS: u32 = 32;
