//! When a run will be done.

use super::request::Prediction;
use crate::engine::pilot::Left;
use crate::map::Accuracy;

/// Two-sided 90 % of the normal distribution.
const NORMAL_90: f64 = 1.645;

/// An accuracy without noise that increments do not take away, and what that leaves of a target.
pub(crate) fn beside(noise: f64, accuracy: Accuracy, target: f64) -> (Accuracy, f64) {
    let beside = |share: f64| (share * share - noise * noise).max(0.0).sqrt();
    (Accuracy { statistical: beside(accuracy.statistical), ..accuracy }, beside(target))
}

/// The increments that will be needed in all for a target, from the error after `increments`: the
/// statistical part falls as the root of their number, the rest stays. `None` where the rest alone
/// exceeds the target.
pub(crate) fn increments_needed(accuracy: &Accuracy, increments: u64, target: f64) -> Option<f64> {
    let of_elements = accuracy.of_elements();
    let left = target * target - of_elements * of_elements;
    let statistical = accuracy.statistical * accuracy.statistical;
    (left > 0.0).then(|| increments as f64 * statistical / left)
}

/// The same where a part of what elements are said to err by is in doubt, which falls as fast as noise, in the square: `seen` is
/// without it. `None` where what is seen alone exceeds the target.
pub(crate) fn increments_needed_beyond_doubt(
    accuracy: &Accuracy,
    seen: &Accuracy,
    increments: u64,
    target: f64,
) -> Option<f64> {
    let [said, seen] = [accuracy, seen].map(|a| a.of_elements() * a.of_elements());
    let falls = accuracy.statistical * accuracy.statistical + (said - seen).max(0.0);
    let left = target * target - seen.min(said);
    (left > 0.0).then(|| increments as f64 * falls / left)
}

/// The finishing time after `increments` of those needed, if each takes `each_s`.
pub(crate) fn finish(needed: f64, increments: u64, each_s: f64, now_s: f64) -> Prediction {
    let left = (needed - increments as f64).max(0.0);
    let finish_s = now_s + left * each_s;
    // The variance behind `needed` comes from `increments` replicates: its relative standard
    // deviation is at most sqrt(2 / (increments - 1)), far less where many receivers differ; the
    // pace of the machine varies by a few per cent.
    let spread = 0.05 + 0.25 * (2.0 / (increments.max(2) - 1) as f64).sqrt();
    let margin_s = NORMAL_90 * spread * left * each_s;
    Prediction {
        finish_s,
        earliest_s: (finish_s - margin_s).max(now_s),
        latest_s: finish_s + margin_s,
    }
}

/// The finishing time as the pilot sees it coming.
pub(crate) fn foreseen(left: Left, now_s: f64) -> Prediction {
    let Left { time_s, factor } = left;
    Prediction {
        finish_s: now_s + time_s,
        earliest_s: now_s + time_s / factor,
        latest_s: now_s + time_s * factor,
    }
}
