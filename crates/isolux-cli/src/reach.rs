//! What accuracy a run reaches in a given time, where the one asked for would take more than a day.

use crate::quantity::{show_seconds, show_share};
use isolux::engine::{Progress, Stage};

/// The longest time that a run takes unless the user gives a time limit, s.
const DAY_S: f64 = 86_400.0;
const HOUR_S: f64 = 3600.0;

/// Whether so much time is more than a day.
pub(crate) fn is_beyond_a_day(left_s: f64) -> bool {
    left_s > DAY_S
}

/// The accuracy that a day reaches, about, where the goal takes longer: noise falls with the root of time.
pub(crate) fn in_a_day(goal: f64, time_s: f64) -> Option<f64> {
    is_beyond_a_day(time_s).then(|| goal * (time_s / DAY_S).sqrt())
}

/// The words for what is left of a run whose goal takes more than a day; `None` for others.
pub(crate) fn left(progress: &Progress) -> Option<String> {
    let left_s = progress.prediction?.finish_s - progress.elapsed_s;
    is_beyond_a_day(left_s).then(|| match reached(progress, DAY_S) {
        Some(share) => format!("more than a day left, a day reaches about {}", show_share(share)),
        None => "more than a day left".to_owned(),
    })
}

/// Why a run ends that nobody has given the time its goal takes: even the earliest predicted end is more than a day
/// ahead, and the error is known.
pub(crate) fn beyond(progress: &Progress) -> Option<String> {
    let (prediction, goal) = (progress.prediction?, progress.target?);
    let is_known = progress.stage == Stage::Increments && progress.accuracy.is_some();
    if !is_known || progress.ends || !is_beyond_a_day(prediction.earliest_s - progress.elapsed_s) {
        return None;
    }
    let [hour, day] = [HOUR_S, DAY_S].map(|time_s| reached(progress, time_s).map(show_share));
    let reachable = match (hour, day) {
        (Some(hour), Some(day)) => {
            format!("; about {hour} can be reached in an hour, about {day} in a day")
        }
        _ => String::new(),
    };
    Some(format!(
        "stopped: an error of {} cannot be reached in a day, it would take {}{reachable}; ask for one of these, or go on \
         from here with --resume and a --time-limit, as in --time-limit 72h",
        show_share(goal),
        show_seconds(prediction.finish_s - progress.elapsed_s)
    ))
}

/// The accuracy that a run reaches after so much more time, about.
fn reached(progress: &Progress, time_s: f64) -> Option<f64> {
    let goal = progress.target?;
    let left_s = progress.prediction?.finish_s - progress.elapsed_s;
    let Some(accuracy) = progress.accuracy else { return Some(goal * (left_s / time_s).sqrt()) };
    let elements = accuracy.of_elements();
    // The noise squared falls with the number of increments; the error of elements stays.
    let wanted = goal * goal - elements * elements;
    let more = accuracy.statistical * accuracy.statistical / wanted - 1.0;
    if wanted <= 0.0 || more <= 0.0 || left_s <= 0.0 {
        return None;
    }
    let grown = 1.0 + time_s * more / left_s;
    Some((elements * elements + accuracy.statistical * accuracy.statistical / grown).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::engine::Prediction;
    use isolux::map::Accuracy;

    fn progress(finish_s: f64, accuracy: Option<Accuracy>) -> Progress {
        Progress {
            stage: if accuracy.is_some() { Stage::Increments } else { Stage::Pilot },
            increments: 8,
            accuracy,
            unshot: None,
            target: Some(0.001),
            receivers: 100,
            rays: 100,
            earlier_rays: 0,
            elapsed_s: 100.0,
            prediction: Some(Prediction {
                finish_s,
                earliest_s: 0.8 * finish_s,
                latest_s: 1.2 * finish_s,
            }),
            ends: false,
        }
    }

    /// Noise alone.
    fn noise(share: f64) -> Accuracy {
        Accuracy {
            reached: share,
            statistical: share,
            discretization: 0.0,
            caustics: 0.0,
            bias: 0.0,
            interpolated: share,
        }
    }

    #[test]
    fn a_day_reaches_what_the_root_of_time_says() {
        // A hundredth of the time, ten times the error.
        let goal_s = 100.0 * DAY_S + 100.0;
        let left = left(&progress(goal_s, None)).unwrap();
        assert_eq!(left, "more than a day left, a day reaches about 1.0 %");
        let told = beyond(&progress(goal_s, Some(noise(0.1)))).unwrap();
        // From 10 % to 0.1 % takes ten thousand times as many increments: a hundredth of that is 101 times as many.
        assert!(told.contains("about 1.00 % in a day") && told.contains("100 days"), "{told}");
        assert!(told.contains("4.4 % can be reached in an hour"), "{told}");
        assert_eq!(in_a_day(0.001, 4.0 * DAY_S), Some(0.002));
    }

    #[test]
    fn runs_of_a_day_go_on() {
        let a_day = progress(DAY_S, Some(noise(0.1)));
        assert_eq!(
            (super::left(&a_day), beyond(&a_day), in_a_day(0.001, DAY_S)),
            (None, None, None)
        );
        // The error is not known yet, or the run ends here anyway.
        assert_eq!(beyond(&progress(1e9, None)), None);
        assert_eq!(beyond(&Progress { ends: true, ..progress(1e9, Some(noise(0.1))) }), None);
    }
}
