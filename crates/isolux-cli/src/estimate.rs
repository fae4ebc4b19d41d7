//! A first guess of what a run will need, from the first seconds of its pilot.

use crate::quantity::{show_bytes, show_seconds, show_share};
use crate::reach;
use isolux::engine::{SolveError, SolveRequest, foresee};
use isolux::scene::Scene;
use serde::Serialize;
use std::time::Duration;

/// Elements, sums and gathered rays of a receiver, with as few rays as scenes of many triangles have: 1900 in a hall of 100,000.
const BYTES_WITH_FEW_RAYS: u64 = 2000;
/// The same with as many rays as small errors ask for: 2900 in the demo interior.
const BYTES_WITH_MANY_RAYS: u64 = 2900;
/// The part of them that a receiver has when the pilot is asked. What the pilot took beside is of luminaires, and stays.
const BYTES_IN_PILOT: u64 = 1900;
/// From this share of the most on, the least is not told apart: memory is told to a fifth.
const ALIKE: f64 = 0.8;
/// How long a pilot may look, its first survey aside, before it is asked what it has seen.
const PATIENCE: Duration = Duration::from_secs(1);
/// How long the first survey may take in an audit of a scene: for each of its triangles about what a survey takes in a hall, and no
/// longer than somebody waits.
const SURVEY_OF_A_TRIANGLE: Duration = Duration::from_micros(20);
const LONGEST_SURVEY: Duration = Duration::from_secs(9);

/// Whether a pilot's first survey may take as long as it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Survey {
    /// It may: its result was asked for.
    Whole,
    /// It may not, and then less is known.
    Short,
}

/// Sizes of a run.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Estimate {
    /// Vertices of the elements, at most and at least: how far elements are refined is known late. Without a survey only
    /// the least is.
    pub receivers: Option<u64>,
    pub receivers_least: u64,
    /// Memory for them, bytes.
    pub memory_bytes: Option<u64>,
    pub memory_least_bytes: u64,
    /// Time to the accuracy asked for on this machine, s, with an interval of 90 %; nothing where the
    /// method cannot tell.
    pub time_s: Option<f64>,
    pub time_earliest_s: Option<f64>,
    pub time_latest_s: Option<f64>,
    /// The accuracy that a day reaches, about, where the time is longer.
    pub accuracy_in_a_day: Option<f64>,
}

/// From the least to the most, or about so much where they differ by little.
fn span(least: u64, most: Option<u64>, show: &dyn Fn(u64) -> String) -> String {
    let Some(most) = most else { return format!("at least {}", show(least)) };
    if least as f64 >= ALIKE * most as f64 {
        return format!("about {}", show(most));
    }
    format!("{} to {}", show(least), show(most))
}

impl Estimate {
    /// From the beginning of the run itself.
    pub(crate) fn of(
        scene: &Scene,
        request: &SolveRequest,
        survey: Survey,
    ) -> Result<Self, SolveError> {
        // The scene, and what its reader needed beside.
        let taken = isolux_memory::peak_bytes();
        let at_most = (survey == Survey::Short).then(|| {
            (PATIENCE + SURVEY_OF_A_TRIANGLE * scene.triangle_count()).min(LONGEST_SURVEY)
        });
        let seen = foresee(scene, request, PATIENCE, at_most)?;
        let receivers_least = seen.receivers_so_far.min(seen.receivers.unwrap_or(u64::MAX));
        let of_pilot = isolux_memory::peak_bytes() - taken;
        let beside = taken + of_pilot.saturating_sub(seen.receivers_so_far * BYTES_IN_PILOT);
        let memory_bytes =
            |receivers: u64, each: u64| (beside + receivers * each).min(request.max_memory_bytes);
        let limit_s = request.time_limit.map_or(f64::INFINITY, |limit| limit.as_secs_f64());
        let limited = |time_s: f64| time_s.min(limit_s);
        Ok(Self {
            receivers: seen.receivers,
            receivers_least,
            memory_bytes: seen.receivers.map(|most| memory_bytes(most, BYTES_WITH_MANY_RAYS)),
            memory_least_bytes: memory_bytes(receivers_least, BYTES_WITH_FEW_RAYS),
            time_s: seen.finish.map(|p| limited(p.finish_s)),
            time_earliest_s: seen.finish.map(|p| limited(p.earliest_s)),
            time_latest_s: seen.finish.map(|p| limited(p.latest_s)),
            accuracy_in_a_day: request
                .accuracy
                .zip(seen.finish)
                .and_then(|(goal, p)| reach::in_a_day(goal, limited(p.finish_s))),
        })
    }

    /// Of runs one after another: the memory of the largest, the time of all.
    pub(crate) fn one_after_another(runs: &[Self]) -> Self {
        let most = |of: fn(&Self) -> u64| runs.iter().map(of).max().unwrap_or(0);
        let known = |of: fn(&Self) -> Option<u64>| {
            let all: Option<Vec<u64>> = runs.iter().map(of).collect();
            all.map(|all| all.into_iter().max().unwrap_or(0))
        };
        let time = |of: fn(&Self) -> Option<f64>| runs.iter().map(of).sum::<Option<f64>>();
        Self {
            receivers: known(|run| run.receivers),
            receivers_least: most(|run| run.receivers_least),
            memory_bytes: known(|run| run.memory_bytes),
            memory_least_bytes: most(|run| run.memory_least_bytes),
            time_s: time(|run| run.time_s),
            time_earliest_s: time(|run| run.time_earliest_s),
            time_latest_s: time(|run| run.time_latest_s),
            accuracy_in_a_day: runs.iter().filter_map(|run| run.accuracy_in_a_day).reduce(f64::max),
        }
    }

    /// Receivers, memory and time as a user reads them.
    pub(crate) fn shown(&self) -> [String; 3] {
        let receivers = span(self.receivers_least, self.receivers, &|count| count.to_string());
        let memory = span(self.memory_least_bytes, self.memory_bytes, &show_bytes);
        [receivers, memory, self.time()]
    }

    fn time(&self) -> String {
        if let Some(share) = self.accuracy_in_a_day {
            let share = show_share(share);
            return format!("first guess more than a day; a day reaches about {share}");
        }
        match (self.time_s, self.time_earliest_s, self.time_latest_s) {
            (Some(time_s), Some(earliest_s), Some(latest_s)) => format!(
                "first guess {} ({} to {})",
                show_seconds(time_s),
                show_seconds(earliest_s),
                show_seconds(latest_s)
            ),
            _ => "not known before it runs".to_owned(),
        }
    }
}
