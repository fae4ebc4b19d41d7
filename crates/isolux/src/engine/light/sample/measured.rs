//! Light with its own standard error, and how well it is to be known.

use crate::units::Rgb;

/// Independent combs, whose spread tells the error of their mean.
pub(crate) const REPLICATES: u32 = 8;

/// The standard error by the spread of eight replicates, so that 1.96 of it hold the truth in 95 % of cases (quantiles of Student's
/// distribution with seven degrees of freedom and of the normal one).
pub(crate) const OF_FEW: f64 = 2.365 / 1.96;

/// Where light may be so many times as noisy, rough clusters will do.
const ROUGH_FROM: f64 = 1.5;

/// Noise of a reading, of the accuracy asked for, and the least and the most of it, of all light: rays grow like its power of -1.4.
const OF_ACCURACY: f64 = 0.3;
const OF_READINGS: [f64; 2] = [3e-4, 3e-3];

/// How well light is to be known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// Standard error, lx.
    pub(crate) lx: f64,
    /// Or as a share of the light itself, whichever is larger.
    pub(crate) share: f64,
    /// Rays of a first look, which tells how many it takes; none for the fewest.
    pub(crate) first_look: usize,
    /// Whether clusters may be rough.
    pub(crate) is_rough: bool,
    /// Whether to measure again, by more rays, what turns out to be noisier.
    pub(crate) insists: bool,
}

impl Goal {
    /// A look by the fewest rays.
    pub(crate) const ANY: Self =
        Self { lx: 0.0, share: 0.0, first_look: 0, is_rough: true, insists: false };

    /// What a reading of a map is worth that is to err by so much of its light.
    pub(crate) fn reading(accuracy: f64) -> Self {
        let [least, most] = OF_READINGS;
        let share = (OF_ACCURACY * accuracy).clamp(least, most);
        Self { lx: 0.0, share, first_look: 64, is_rough: false, insists: true }
    }

    /// Standard error where there is so much light, lx.
    pub(super) fn of(self, lx: f64) -> f64 {
        self.lx.max(self.share * lx)
    }

    /// With so many times the noise; where that is much, by clusters as rough as those that one luminaire is drawn from.
    pub(crate) fn relaxed(self, by: f64) -> Self {
        Self { lx: self.lx * by, is_rough: by >= ROUGH_FROM, ..self }
    }

    /// So many lux, after a short look.
    pub(crate) const fn lux(lx: f64) -> Self {
        Self { lx, share: 0.0, first_look: 16, is_rough: false, insists: false }
    }
}

/// Photometric light of a place with its error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    pub(crate) lx: Rgb,
    /// Variance of its photometric value, lx2.
    pub(crate) variance: f64,
}
