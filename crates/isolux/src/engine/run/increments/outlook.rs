//! The outlook of a run: whether its increments may end, whether they suffice, and when.

use super::super::prediction;
use super::{Engine, FEWEST_INCREMENTS, Work};
use crate::engine::judge::{BELIEVED_INCREMENTS, FEWEST_TO_MISS, early_statistical};
use crate::engine::ray::{Noise, Sums};
use crate::map::Accuracy;

/// The number of increments from which the measured error predicts their number in all. Predictions from fewer were
/// wrong by a factor of two.
const FEWEST_TO_TELL: u64 = 6;

/// The number of increments beyond which finer elements are faster. These cost a pilot, which takes as long as about
/// ten of their increments. They also cost [`BELIEVED_INCREMENTS`] increments, all on at least half as many vertices
/// again.
const MOST_INCREMENTS: f64 = 5.0 * BELIEVED_INCREMENTS as f64;

/// The largest number of increments that a run makes only to reduce the doubt about its error.
const MOST_HOPED_FOR: f64 = 32.0 * BELIEVED_INCREMENTS as f64;

impl Work<'_, '_> {
    /// An accuracy and a target without the noise of direct light that all increments share.
    fn beside_direct(&self, accuracy: Accuracy, target: f64) -> (Accuracy, f64) {
        let share = self.noise_of_direct_lx2().sqrt() / self.plan.light.reference_lx;
        prediction::beside(if share.is_finite() { share } else { 0.0 }, accuracy, target)
    }

    /// Whether a run may end at its accuracy: its error is known, or all patches of radiosity have shot.
    pub(crate) fn may_end(&self) -> bool {
        self.left.as_ref().map_or_else(|| self.is_believed(), |left| left.all_have_shot)
    }

    /// Whether finer elements will reach a target that the present ones will not reach, or only much later.
    pub(crate) fn is_too_coarse(&self, accuracy: Option<Accuracy>, target: f64) -> bool {
        if self.left.is_some() {
            return self.is_hopeless(accuracy, Some(target));
        }
        // Elements for caustics are as fine as particles can resolve, whatever accuracy they are made for.
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
        // More increments may show that the allowance for noise was not needed.
        let seen = self.accuracy_if(Noise::TakenOff).unwrap_or(counted);
        let most = if self.has_nets() { MOST_INCREMENTS } else { f64::INFINITY };
        [counted, seen].into_iter().all(|a| {
            let (a, target) = self.beside_direct(a, target);
            let are_few = |a: &Accuracy| {
                prediction::increments_needed(a, count, target).is_some_and(|needed| needed <= most)
            };
            // Finer elements leave at least the error of caustics.
            let without_others = Accuracy { discretization: of_caustics, bias: 0.0, ..a };
            !are_few(&a) && (of_caustics == 0.0 || are_few(&without_others))
        })
    }

    /// Whether the error of the elements alone exceeds a target beyond noise, before the whole error is known.
    fn misses_early(&self, target: f64) -> bool {
        let ruled_out = || self.accuracy_if(Noise::RuledOut);
        self.has_nets()
            && self.sums.increments >= FEWEST_TO_MISS
            && ruled_out().is_some_and(|a| a.of_elements() > target)
    }

    /// The error of the elements, relative, with noise subtracted.
    pub(crate) fn error_of_elements(&self) -> Option<f64> {
        self.accuracy_if(Noise::TakenOff).map(|a| a.of_elements())
    }

    /// Whether a target cannot be reached on these elements with an acceptable number of increments.
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

    /// The number of increments in all for a target; `None` if it cannot be reached. Before the error is known, it
    /// follows from the measured error, from [`FEWEST_TO_TELL`] increments on, or else from noise alone. After one
    /// increment it is the number that elements and rays are made for.
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

    /// Whether no number of increments will give the accuracy of the map. Either the map has no light, or the light of
    /// paths given up may exceed all light. Radiosity also ends here at a limit of unshot light that the request sets.
    pub(crate) fn is_vain(&self, accuracy: Option<Accuracy>) -> bool {
        let dark = self.plan.light.reference_lx == 0.0;
        let lost = self.given_up.sums != [Sums::default()];
        let given_up = lost || self.left.as_ref().is_some_and(|left| !left.is_bounded);
        if self.stops_at_unshot && self.left.as_ref().is_some_and(|left| left.is_shot) {
            return true;
        }
        self.may_end() && accuracy.is_none() && (dark || given_up)
    }

    /// Whether further increments would change little if the target cannot be reached: noise is a small part of the
    /// error.
    pub(crate) fn is_settled(&self, accuracy: Option<Accuracy>) -> bool {
        let is_shot = matches!(self.engine, Engine::Radiosity(_));
        is_shot || accuracy.is_some_and(|a| a.statistical <= 0.25 * a.of_elements())
    }
}
