//! What a map is found to be, and how far readers are to trust it.
//!
//! How good a map is depends on who reads it: what readers gather afresh does not err by interpolation. Details tell the
//! pilot roughly in which elements they need not gather; check points tell what that comes to. Where it is too much for the
//! accuracy asked for, readers trust fewer elements, as far as that helps, before finer ones are made; where to gather would
//! change no more than the map errs by, they gather in gaps alone.

use super::check_points::InterpolationErrors;
use crate::ablation::without;
use crate::engine::mesh::{Trust, TrustLevels};
use crate::map::Accuracy;

/// The part of the accuracy asked for that readers leave to where they would gather, however good the map is elsewhere.
pub(crate) const OF_GOAL: f64 = 0.25;

/// Greatest factor between the interpolation error seen and that expected that is believed, either
/// way: details tell the order at least.
const MOST_OVER: f64 = 10.0;

/// A map as it is to be read.
#[derive(Clone, Copy)]
pub(crate) struct Verdict {
    pub(crate) trust: Trust,
    pub(crate) errors: InterpolationErrors,
    pub(crate) accuracy: Option<Accuracy>,
}

impl Verdict {
    /// As found by `by`, with as much trust as reaches a goal, of several, the most first; with the least if none does.
    pub(crate) fn for_goal(goal: f64, trusts: TrustLevels, by: impl Fn(Trust) -> Self) -> Self {
        if without("trust-ladder") {
            return by(trusts.foreseen());
        }
        let (least, more) = (trusts.least(), trusts.all_but_least());
        more.map(&by).find(|judged| judged.reaches(goal)).unwrap_or_else(|| by(least))
    }

    /// The same, or trusting all but gaps where that is enough and a goal is still reached.
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
        // Who gathers in space reads what stands close by all the same.
        all.errors.untrusted_lx = all.errors.untrusted_lx.max(self.errors.untrusted_lx);
        all
    }

    /// The factor by which elements err more than the pilot has expected, within reason.
    pub(crate) fn over_expected(&self) -> f64 {
        bounded(self.errors.over_expected)
    }

    /// The same in a strip before walls. Who gathers elsewhere than in gaps goes by what all are expected to err by.
    pub(crate) fn over_expected_in(&self, strip: usize) -> f64 {
        let own = self.errors.over_in_strips[strip].filter(|_| self.trust == Trust::AllButGaps);
        bounded(own.or(self.errors.over_expected))
    }

    fn reaches(&self, goal: f64) -> bool {
        self.accuracy.is_some_and(|accuracy| accuracy.reached <= goal)
    }
}

fn bounded(over: Option<f64>) -> f64 {
    over.map_or(1.0, |over| over.clamp(1.0 / MOST_OVER, MOST_OVER))
}
