//! The accuracy of a map as readers use it, and where they interpolate.
//!
//! The error depends on the reader: light that readers gather afresh has no interpolation error. Details tell
//! the pilot roughly in which elements readers can interpolate; check points measure the resulting error. If
//! it is too large for the accuracy goal, readers trust fewer elements, as far as that helps, before elements
//! are refined. If gathering would change less than the error of the map, readers gather in gaps alone.

use super::check_points::InterpolationErrors;
use crate::ablation::without;
use crate::engine::mesh::{Trust, TrustLevels};
use crate::map::Accuracy;

/// The least error that gathering is weighed against, as a share of the accuracy goal, however small the
/// error of the map is.
pub(crate) const OF_GOAL: f64 = 0.25;

/// The largest factor between measured and expected interpolation error that is believed, either way. Details
/// give at least the order of magnitude.
const MOST_ERROR_FACTOR: f64 = 10.0;

/// A map's errors, and the trust that readers have in it.
#[derive(Clone, Copy)]
pub(crate) struct Verdict {
    pub(crate) trust: Trust,
    pub(crate) errors: InterpolationErrors,
    pub(crate) accuracy: Option<Accuracy>,
}

impl Verdict {
    /// The verdict with the most trust that reaches a goal, or with the least trust if none does; `by` judges
    /// with a given trust.
    pub(crate) fn for_goal(goal: f64, trusts: TrustLevels, by: impl Fn(Trust) -> Self) -> Self {
        if without("trust-ladder") {
            return by(trusts.foreseen());
        }
        let (least, more) = (trusts.least(), trusts.all_but_least());
        more.map(&by).find(|judged| judged.reaches(goal)).unwrap_or_else(|| by(least))
    }

    /// This verdict, or the one with trust everywhere but in gaps, where that is enough and still reaches the
    /// goal.
    pub(crate) fn or_all_but_gaps(
        self,
        goal: f64,
        is_enough: impl Fn(&Accuracy) -> bool,
        by: impl Fn(Trust) -> Self,
    ) -> Self {
        if without("gap-trust") {
            return self;
        }
        let reached = self.accuracy.filter(|accuracy| accuracy.reached <= goal);
        let all = reached.filter(is_enough).map(|_| by(Trust::AllButGaps));
        let Some(mut all) = all.filter(|all| all.reaches(goal)) else { return self };
        // Rays of a reader in free space still read places close to things.
        all.errors.untrusted_lx = all.errors.untrusted_lx.max(self.errors.untrusted_lx);
        all
    }

    /// The factor by which elements err more than the pilot expected, within [`MOST_ERROR_FACTOR`].
    pub(crate) fn over_expected(&self) -> f64 {
        bounded(self.errors.over_expected)
    }

    fn reaches(&self, goal: f64) -> bool {
        self.accuracy.is_some_and(|accuracy| accuracy.reached <= goal)
    }
}

fn bounded(over: Option<f64>) -> f64 {
    over.map_or(1.0, |over| over.clamp(1.0 / MOST_ERROR_FACTOR, MOST_ERROR_FACTOR))
}
