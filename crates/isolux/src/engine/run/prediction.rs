//! The predicted finishing time of a run.

use super::request::Prediction;
use crate::engine::pilot::Left;
use crate::map::Accuracy;

/// The normal quantile for two-sided intervals of 90 %.
const NORMAL_90: f64 = 1.645;

/// A relative accuracy and a target without a noise that increments do not reduce. Its square is subtracted from those
/// of the statistical error and of the target.
pub(crate) fn beside(noise: f64, accuracy: Accuracy, target: f64) -> (Accuracy, f64) {
    let beside = |share: f64| (share * share - noise * noise).max(0.0).sqrt();
    (Accuracy { statistical: beside(accuracy.statistical), ..accuracy }, beside(target))
}

/// The number of increments in all for a target, from the error after `increments` increments. The statistical error
/// falls with the root of their number, the rest stays. `None` where the rest alone exceeds the target.
pub(crate) fn increments_needed(accuracy: &Accuracy, increments: u64, target: f64) -> Option<f64> {
    let of_elements = accuracy.of_elements();
    let left = target * target - of_elements * of_elements;
    let statistical = accuracy.statistical * accuracy.statistical;
    (left > 0.0).then(|| increments as f64 * statistical / left)
}

/// The number of increments in all for a target, if part of the reported error of elements is doubt. The square of this
/// part falls as fast as that of noise. `seen` is the accuracy without it. `None` where the error of elements alone
/// exceeds the target without doubt, too.
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

/// The finishing time after `increments` increments of `needed` ones, if each takes `each_s`, s.
pub(crate) fn finish(needed: f64, increments: u64, each_s: f64, now_s: f64) -> Prediction {
    let left = (needed - increments as f64).max(0.0);
    let finish_s = now_s + left * each_s;
    // `needed` comes from the variance of `increments` replicates. Its relative standard deviation is at most sqrt(2 /
    // (increments - 1)), and far less where many receivers differ. The speed of the machine varies by a few per cent.
    let spread = 0.05 + 0.25 * (2.0 / (increments.max(2) - 1) as f64).sqrt();
    let margin_s = NORMAL_90 * spread * left * each_s;
    Prediction {
        finish_s,
        earliest_s: (finish_s - margin_s).max(now_s),
        latest_s: finish_s + margin_s,
    }
}

/// The finishing time predicted by the pilot.
pub(crate) fn foreseen(left: Left, now_s: f64) -> Prediction {
    let Left { time_s, factor } = left;
    Prediction {
        finish_s: now_s + time_s,
        earliest_s: now_s + time_s / factor,
        latest_s: now_s + time_s * factor,
    }
}
