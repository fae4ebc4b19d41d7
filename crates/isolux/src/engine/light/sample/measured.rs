//! Light with its standard error, and the standard error asked for.

use crate::engine::ray::Dice;
use crate::units::Rgb;

/// Independent replicates, whose spread tells the standard error of their mean.
pub(crate) const REPLICATES: u32 = 8;

/// Factor on a standard error from the spread of eight replicates, with which 1.96 standard errors hold the true
/// value in 95 % of cases (quantiles of Student's distribution with seven degrees of freedom and of the normal one).
pub(crate) const STUDENT_FACTOR: f64 = 2.365 / 1.96;

/// Factor on the allowed noise from which rough clusters suffice.
const ROUGH_NOISE_FACTOR: f64 = 1.5;

/// Standard error of a reading, as a share of the accuracy asked for.
const ACCURACY_SHARE: f64 = 0.3;
/// The smallest and the largest standard error of a reading, as a share of its light. The number of
/// rays grows like its power of -1.4.
const READING_ERROR_SHARES: [f64; 2] = [3e-4, 3e-3];

/// The standard error asked for in a measurement of light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// Standard error, lx.
    pub(crate) lx: f64,
    /// Standard error as a share of the light; the larger of the two counts.
    pub(crate) share: f64,
    /// Rays of a first look, which tells how many rays are needed; with zero, the fewest are taken.
    pub(crate) first_look: usize,
    /// Whether clusters may be rough.
    pub(crate) is_rough: bool,
    /// Whether to measure again, by more rays, if the light turns out to be noisier.
    pub(crate) insists: bool,
}

impl Goal {
    /// No standard error asked for: the fewest rays.
    pub(crate) const ANY: Self =
        Self { lx: 0.0, share: 0.0, first_look: 0, is_rough: true, insists: false };

    /// The goal of a reading of a map that is accurate to this share of its light.
    pub(crate) fn reading(accuracy: f64) -> Self {
        let [least, most] = READING_ERROR_SHARES;
        let share = (ACCURACY_SHARE * accuracy).clamp(least, most);
        Self { lx: 0.0, share, first_look: 64, is_rough: false, insists: true }
    }

    /// Standard error for an illuminance, lx.
    pub(super) fn of(self, lx: f64) -> f64 {
        self.lx.max(self.share * lx)
    }

    /// The goal with `by` times the noise. If `by` is large, clusters may be as rough as those from
    /// which one luminaire is drawn.
    pub(crate) fn relaxed(self, by: f64) -> Self {
        Self { lx: self.lx * by, is_rough: by >= ROUGH_NOISE_FACTOR, ..self }
    }

    /// A goal in lux, with a short first look.
    pub(crate) const fn lux(lx: f64) -> Self {
        Self { lx, share: 0.0, first_look: 16, is_rough: false, insists: false }
    }
}

/// Illuminance at a place with its variance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    pub(crate) lx: Rgb,
    /// Variance of the photometric value, lx2.
    pub(crate) variance: f64,
}

/// Mean of samples over a low-discrepancy sequence.
pub(super) fn mean(samples: usize, dice: &mut Dice, mut one: impl FnMut(&mut Dice) -> Rgb) -> Rgb {
    if samples == 1 {
        return one(dice);
    }
    let sequence = dice.fork();
    let sum: Rgb = (0..samples).map(|k| one(&mut Dice::new(sequence, k as u32))).sum();
    sum / samples as f64
}
