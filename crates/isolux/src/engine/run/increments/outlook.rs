//! Whether a run is done, or will be, and when.

use super::super::prediction;
use super::{Engine, FEWEST_INCREMENTS, Work};
use crate::engine::judge::{BELIEVED_INCREMENTS, FEWEST_TO_MISS, early_statistical};
use crate::engine::ray::{Noise, Sums};
use crate::map::Accuracy;

/// Increments that tell how many it will take; those of fewer were off by a factor of two.
const FEWEST_TO_TELL: u64 = 6;

/// Increments beyond which finer elements are faster, which take their pilot, as long as some ten increments of theirs, and as many
/// increments as are believed, all on half as many vertices again or more.
const MOST_INCREMENTS: f64 = 5.0 * BELIEVED_INCREMENTS as f64;

/// Increments that a run makes at most only to be less in doubt.
const MOST_HOPED_FOR: f64 = 32.0 * BELIEVED_INCREMENTS as f64;

impl Work<'_, '_> {
    /// An accuracy and a target without that noise.
    fn beside_direct(&self, accuracy: Accuracy, target: f64) -> (Accuracy, f64) {
        let share = self.noise_of_direct_lx2().sqrt() / self.plan.light.reference_lx;
        prediction::beside(if share.is_finite() { share } else { 0.0 }, accuracy, target)
    }

    /// Whether a run may stop at its accuracy.
    pub(crate) fn may_end(&self) -> bool {
        self.left.as_ref().map_or_else(|| self.is_believed(), |left| left.all_have_shot)
    }

    /// Whether finer elements will reach a target, but these will not, or much later.
    pub(crate) fn is_too_coarse(&self, accuracy: Option<Accuracy>, target: f64) -> bool {
        if self.left.is_some() {
            return self.is_hopeless(accuracy, Some(target));
        }
        // Elements are as fine as particles tell them to be for caustics, whatever they are made for.
        let of_caustics =
            self.caustics_told_lx2(Noise::TakenOff) + self.plan.errors.caustics_beside_lx2;
        let of_caustics = of_caustics.sqrt() / self.plan.light.reference_lx.max(f64::MIN_POSITIVE);
        if of_caustics > target {
            return false;
        }
        let count = self.sums.increments;
        let Some(counted) = accuracy.filter(|_| self.may_end()) else {
            return self.misses_early(target);
        };
        // More increments may show that what noise could hide is none.
        let seen = self.accuracy_if(Noise::TakenOff).unwrap_or(counted);
        let most = if self.has_nets() { MOST_INCREMENTS } else { f64::INFINITY };
        [counted, seen].into_iter().all(|a| {
            let (a, target) = self.beside_direct(a, target);
            let are_few = |a: &Accuracy| {
                prediction::increments_needed(a, count, target).is_some_and(|needed| needed <= most)
            };
            // The best that finer elements make of it.
            let without_others = Accuracy { discretization: of_caustics, bias: 0.0, ..a };
            !are_few(&a) && (of_caustics == 0.0 || are_few(&without_others))
        })
    }

    /// Whether the elements alone err by more than a target: seen before all of the error is believed.
    fn misses_early(&self, target: f64) -> bool {
        let ruled_out = || self.accuracy_if(Noise::RuledOut);
        self.has_nets()
            && self.sums.increments >= FEWEST_TO_MISS
            && ruled_out().is_some_and(|a| a.of_elements() > target)
    }

    /// What the elements err by, as far as it is seen.
    pub(crate) fn error_of_elements(&self) -> Option<f64> {
        self.accuracy_if(Noise::TakenOff).map(|a| a.of_elements())
    }

    /// Whether no number of increments will reach a target on these elements.
    pub(crate) fn is_hopeless(&self, accuracy: Option<Accuracy>, target: Option<f64>) -> bool {
        if let Some(left) = &self.left {
            let misses = |a: Accuracy| target.is_none_or(|target| a.reached > target);
            return accuracy.is_some_and(misses) && left.is_shot;
        }
        let wanted = accuracy.zip(target).filter(|_| self.may_end());
        wanted.is_some_and(|(a, goal)| {
            self.needed_beyond_doubt(a, goal).is_none_or(|needed| needed > MOST_HOPED_FOR)
        })
    }

    fn needed_beyond_doubt(&self, accuracy: Accuracy, target: f64) -> Option<f64> {
        let seen = self.accuracy_if(Noise::TakenOff).unwrap_or(accuracy);
        let count = self.sums.increments;
        let ((accuracy, target), (seen, _)) =
            (self.beside_direct(accuracy, target), self.beside_direct(seen, target));
        prediction::increments_needed_beyond_doubt(&accuracy, &seen, count, target)
    }

    /// The increments that a target will take in all; `None` if it cannot be reached. Until the error is
    /// believed, by what is seen of it, as soon as that tells something; before, by noise alone; from one increment,
    /// what elements and rays are made for.
    pub(crate) fn increments_needed(&self, accuracy: Option<Accuracy>, target: f64) -> Option<f64> {
        let count = self.sums.increments;
        if let (Engine::Radiosity(radiosity), Some(left)) = (&self.engine, &self.left) {
            return radiosity.shots_needed(count, left);
        }
        let by_all = |a: Accuracy| {
            let (a, target) = self.beside_direct(a, target);
            prediction::increments_needed(&a, count, target)
        };
        let by_noise = || {
            let statistical = early_statistical(self.plan, &self.sums).unwrap_or(0.0);
            let share = statistical / target;
            count as f64 * share * share
        };
        let needed = if count < BELIEVED_INCREMENTS {
            let is_told = self.has_nets() && count >= FEWEST_TO_TELL;
            let seen = is_told.then(|| self.accuracy_if(Noise::TakenOff).and_then(by_all));
            Some(seen.flatten().unwrap_or_else(by_noise))
        } else {
            accuracy.and_then(|a| self.needed_beyond_doubt(a, target))
        };
        needed.map(|needed| needed.max(FEWEST_INCREMENTS as f64))
    }

    /// Whether no number of increments will tell how good the map is: there is no light on it, or
    /// the light that was given up may be more than what is there; or whether radiosity was told to
    /// shoot no more.
    pub(crate) fn is_vain(&self, accuracy: Option<Accuracy>) -> bool {
        let dark = self.plan.light.reference_lx == 0.0;
        let lost = self.given_up.sums != [Sums::default()];
        let given_up = lost || self.left.as_ref().is_some_and(|left| !left.is_bounded);
        if self.stops_at_unshot && self.left.as_ref().is_some_and(|left| left.is_shot) {
            return true;
        }
        self.may_end() && accuracy.is_none() && (dark || given_up)
    }

    /// Whether more increments, of those that are hopeless, would change little: noise is a small part
    /// of the error.
    pub(crate) fn is_settled(&self, accuracy: Option<Accuracy>) -> bool {
        let is_shot = matches!(self.engine, Engine::Radiosity(_));
        is_shot || accuracy.is_some_and(|a| a.statistical <= 0.25 * a.of_elements())
    }
}
