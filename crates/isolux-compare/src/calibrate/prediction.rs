//! Whether runs end when they said they would.

use super::error::CalibrateError;
use super::scene_figure::spread;
use crate::statistics::binomial_interval;
use crate::validate::ValidateError;
use isolux::engine::{Prediction, SolveRequest, Watch, solve};
use isolux::map::Method;
use isolux::scene::Scene;
use serde::Serialize;

/// A prediction is right within this share of the true finishing time ...
const NEAR: f64 = 0.2;
/// ... and promised to be right so often ...
const PROMISED: f64 = 0.9;
/// ... from this share of the work on.
const DECILES: std::ops::RangeInclusive<u32> = 1..=9;
/// ... and as soon as somebody could read it, s: what is shown is renewed about that often.
const SOON_S: f64 = 0.25;
const CERTAINTY: f64 = 0.95;

/// Predictions of one scene by one engine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PredictionTable {
    /// Name of the scene.
    pub scene: String,
    /// Engine.
    pub method: Method,
    /// Accuracy asked for.
    pub accuracy: f64,
    /// Runs that came to it.
    pub runs: u64,
    /// Runs that did not, and are not counted.
    pub unreached: u64,
    /// Fewest, median and most increments.
    pub increments: Option<[f64; 3]>,
    /// Shortest, median and longest time, s.
    pub finish_s: Option<[f64; 3]>,
    /// From 10 % of the time to 90 %.
    pub deciles: Vec<Decile>,
}

impl PredictionTable {
    /// Whether predictions may well be right in nine runs of ten, from the first decile on.
    pub fn is_kept(&self) -> bool {
        self.deciles.iter().all(|decile| decile.high >= PROMISED)
    }
}

/// Predictions that stood after a share of the time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Decile {
    /// Share of the time that the run took in the end.
    pub work: f64,
    /// Runs that had lasted for a quarter of a second by then: of others nobody could have been told.
    pub runs: u64,
    /// Those of them that had said anything.
    pub said: u64,
    /// Runs that ended within 20 % of what they had said.
    pub near: u64,
    /// Share of them that did; saying nothing is no prediction. One if there are none.
    pub share: f64,
    /// Interval of 95 % of the share.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// Runs that ended in the interval they had said, of 90 %.
    pub in_interval: u64,
}

/// What a run said, and when it ended.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trace {
    said: Vec<(f64, Prediction)>,
    increments: u64,
    finish_s: f64,
}

/// Runs a scene from several seeds on all threads, one after another, as a user would. `on_run` is
/// told the time of every run and may stop.
pub fn predict_scene(
    scene: &Scene,
    request: &SolveRequest,
    seeds: &[u64],
    on_run: &mut dyn FnMut(f64) -> Watch,
) -> Result<PredictionTable, CalibrateError> {
    let (mut traces, mut unreached) = (Vec::new(), 0);
    for &seed in seeds {
        let mut said = Vec::new();
        let request = SolveRequest { seed, ..request.clone() };
        let solution = solve(scene, &request, None, &mut |progress| {
            said.extend(progress.prediction.map(|p| (progress.elapsed_s, p)));
            Watch::Continue
        })
        .map_err(|error| ValidateError::Solve { case: "prediction", error })?;
        let provenance = &solution.map.provenance;
        if provenance.complete {
            let (increments, finish_s) = (provenance.increments, solution.time_s);
            traces.push(Trace { said, increments, finish_s });
        } else {
            unreached += 1;
        }
        if on_run(solution.time_s) == Watch::Stop {
            break;
        }
    }
    let sorted = |value: &dyn Fn(&Trace) -> f64| {
        let mut values: Vec<f64> = traces.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        spread(&values)
    };
    Ok(PredictionTable {
        scene: scene.name().to_owned(),
        method: request.method,
        accuracy: request.accuracy.unwrap_or(f64::NAN),
        runs: traces.len() as u64,
        unreached,
        increments: sorted(&|t| t.increments as f64),
        finish_s: sorted(&|t| t.finish_s),
        deciles: deciles(&traces),
    })
}

fn deciles(traces: &[Trace]) -> Vec<Decile> {
    if traces.is_empty() {
        return Vec::new();
    }
    DECILES.map(|tenths| decile(f64::from(tenths) / 10.0, traces)).collect()
}

fn decile(work: f64, traces: &[Trace]) -> Decile {
    let standing = |trace: &Trace| {
        let before = |(at_s, _): &&(f64, Prediction)| *at_s <= work * trace.finish_s;
        trace.said.iter().rev().find(before).map(|(_, prediction)| *prediction)
    };
    let judged = || traces.iter().filter(|trace| work * trace.finish_s >= SOON_S);
    let count = |is_so: &dyn Fn(&Trace, Prediction) -> bool| {
        judged().filter(|t| standing(t).is_some_and(|p| is_so(t, p))).count() as u64
    };
    let near = count(&|t, p| (p.finish_s / t.finish_s - 1.0).abs() <= NEAR);
    let runs = judged().count() as f64;
    let [low, high] =
        if runs > 0.0 { binomial_interval(near as f64, runs, CERTAINTY) } else { [0.0, 1.0] };
    Decile {
        work,
        runs: runs as u64,
        said: count(&|_, _| true),
        near,
        share: if runs > 0.0 { near as f64 / runs } else { 1.0 },
        low,
        high,
        in_interval: count(&|t, p| p.earliest_s <= t.finish_s && t.finish_s <= p.latest_s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run of ten seconds that from `first_s` on, every second, says so many seconds.
    fn trace(first_s: u32, finish_s: f64) -> Trace {
        let said = Prediction { finish_s, earliest_s: finish_s - 1.0, latest_s: finish_s + 1.0 };
        let said = (first_s..10).map(|at_s| (f64::from(at_s), said)).collect();
        Trace { said, increments: 10, finish_s: 10.0 }
    }

    fn table(traces: &[Trace]) -> PredictionTable {
        PredictionTable {
            scene: "synthetic".into(),
            method: Method::Hybrid,
            accuracy: 0.01,
            runs: traces.len() as u64,
            unreached: 0,
            increments: None,
            finish_s: None,
            deciles: deciles(traces),
        }
    }

    #[test]
    fn near_and_early_predictions_keep_the_promise() {
        let kept = table(&vec![trace(1, 11.9); 40]);
        assert!(kept.is_kept(), "{kept:?}");
        let first = kept.deciles[0];
        assert_eq!((first.said, first.near, first.in_interval), (40, 40, 0));
    }

    #[test]
    fn silence_and_a_third_too_long_break_it() {
        let late = table(&vec![trace(5, 10.0); 40]);
        assert!(!late.is_kept());
        assert_eq!((late.deciles[3].said, late.deciles[4].near), (0, 40));
        assert!(!table(&vec![trace(1, 13.0); 40]).is_kept());
    }

    #[test]
    fn nobody_is_told_of_the_first_quarter_of_a_second() {
        let brief = Trace { finish_s: 0.6, ..trace(9, 10.0) };
        let brief = table(&vec![brief; 40]);
        let runs: Vec<u64> = brief.deciles.iter().map(|decile| decile.runs).collect();
        assert_eq!(runs, [0, 0, 0, 0, 40, 40, 40, 40, 40]);
        assert!(!brief.is_kept(), "half a second has to be told of: {brief:?}");
        let at_once = table(&vec![Trace { finish_s: 0.2, ..trace(9, 10.0) }; 40]);
        assert!(at_once.is_kept(), "{at_once:?}");
    }

    #[test]
    fn one_run_of_ten_may_be_wrong() {
        let mut traces = vec![trace(1, 10.0); 36];
        traces.extend(vec![trace(1, 20.0); 4]);
        assert!(table(&traces).is_kept());
        assert!(table(&[]).deciles.is_empty());
    }
}
