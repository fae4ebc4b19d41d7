//! Direct light with its own standard error, by as many shadow rays as that takes.

use super::Lighting;
use super::cut::Cut;
use crate::engine::accumulate::mean_and_variance;
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::sampling::Sequence;
use crate::units::Rgb;

/// Independent combs, whose spread tells the error of their mean.
const REPLICATES: u32 = 8;

/// Teeth of one of them.
const FEWEST_TEETH: f64 = 4.0;
const MOST_TEETH: f64 = 512.0;

/// Light by combs of n teeth errs like this power of 1/n where part of it is hidden: measured on an
/// interior of 2626 luminaires from 8 to 512 (independent rays err like 0.5).
const COMB_ORDER: f64 = 0.7;

/// Rays that are added to those of the first look, half of them dark: one that agrees need not be
/// right.
const DOUBT: f64 = 0.5;

/// Where light may be so many times as noisy, rough clusters will do.
const ROUGH_FROM: f64 = 1.5;

/// How well light is to be known.
#[derive(Clone, Copy, Debug)]
pub(in crate::engine) struct Goal {
    /// Standard error, lx.
    pub(in crate::engine) lx: f64,
    /// Or as a share of the light itself, whichever is larger.
    pub(in crate::engine) share: f64,
    /// Rays of a first look, which tells how many it takes; none for the fewest.
    pub(in crate::engine) first_look: usize,
    /// Whether clusters may be rough.
    pub(in crate::engine) is_rough: bool,
}

impl Goal {
    /// A look by the fewest rays.
    pub(in crate::engine) const ANY: Self =
        Self { lx: 0.0, share: 0.0, first_look: 0, is_rough: true };

    /// What a reading of a map is worth.
    pub(in crate::engine) const READING: Self =
        Self { lx: 0.0, share: 0.003, first_look: 64, is_rough: false };

    /// With so many times the noise; where that is much, by clusters as rough as those that one luminaire is drawn from.
    pub(in crate::engine) fn relaxed(self, by: f64) -> Self {
        Self { lx: self.lx * by, is_rough: by >= ROUGH_FROM, ..self }
    }

    /// So many lux, after a short look.
    pub(in crate::engine) const fn lux(lx: f64) -> Self {
        Self { lx, share: 0.0, first_look: 16, is_rough: false }
    }
}

/// Photometric light of a place with its error.
#[derive(Clone, Copy, Debug)]
pub(in crate::engine) struct Measured {
    pub(in crate::engine) lx: Rgb,
    /// Variance of its photometric value, lx2.
    pub(in crate::engine) variance: f64,
}

impl Lighting<'_> {
    /// Direct illuminance with the variance of its noise; where luminaires are few it is evaluated
    /// once, and nothing is known of the noise of emitting surfaces.
    ///
    /// Best effort: the noise is about as asked for. The first look is not part of the result, so that this is
    /// free of bias.
    pub(in crate::engine) fn measured(
        &self,
        at: &SurfacePoint,
        goal: Goal,
        sequence: Sequence,
    ) -> Measured {
        if !self.has_many() {
            let lx = self.illuminance(at, &mut Dice::new(sequence, 0));
            return Measured { lx, variance: 0.0 };
        }
        let cut = if goal.is_rough { self.rough_cut(at) } else { self.fine_cut(at) };
        let teeth = self.teeth(&cut, at, goal, &mut Dice::new(sequence, REPLICATES));
        let of_each =
            (REPLICATES as usize * teeth >= self.count(&cut)).then(|| self.lit_by_each(&cut, at));
        let samples = self.area_samples();
        let values = [const { Rgb::BLACK }; REPLICATES as usize];
        let mut replicate = 0;
        let values = values.map(|_| {
            let mut dice = Dice::new(sequence, replicate);
            replicate += 1;
            let points = of_each.unwrap_or_else(|| self.lit_by_many(&cut, at, teeth, &mut dice));
            self.others().fold(points, |sum, s| sum + self.lit_by(s, at, samples, &mut dice))
        });
        let (lx, variance) = mean_and_variance(&values);
        Measured { lx, variance }
    }

    /// Teeth of a replicate: as many as it takes by the spread of what a first look finds.
    fn teeth(&self, cut: &Cut, at: &SurfacePoint, goal: Goal, dice: &mut Dice) -> usize {
        if goal.first_look == 0 || cut.parts.total <= 0.0 {
            return FEWEST_TEETH as usize;
        }
        let total = cut.parts.total;
        // Half of the doubt is dark, half as lit as it can be.
        let (mut sum, mut squares) = (0.5 * DOUBT * total, 0.5 * DOUBT * total * total);
        self.look(cut, at, goal.first_look, dice, |found| {
            let lx = found.luminance();
            sum += lx;
            squares += lx * lx;
        });
        let looks = goal.first_look as f64 + DOUBT;
        let (lx, square) = (sum / looks, squares / looks);
        let spread_lx = (square - lx * lx).max(0.0).sqrt();
        let goal_lx = goal.lx.max(goal.share * lx);
        let error_lx = spread_lx / f64::from(REPLICATES).sqrt();
        libm::pow(error_lx / goal_lx, 1.0 / COMB_ORDER).clamp(FEWEST_TEETH, MOST_TEETH) as usize
    }
}
