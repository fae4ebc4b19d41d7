//! Cases over many seeds, and what comes of it.

use super::coverage::{CONFIDENCES, Coverage, Judgement};
use super::error::CalibrateError;
use super::observe::{Interval, Observation, Observed, Stage, observe};
use super::places::{Place, places};
use super::prediction::PredictionTable;
use super::scene_figure::SceneFigure;
use super::settings::CalibrateSettings;
use crate::expectation::{Case, Quantity};
use crate::validate::{ValidateError, scene_of};
use isolux::engine::{SolveRequest, Watch};
use isolux::map::Method;
use serde::Serialize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

/// All that was calibrated.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Calibrated {
    /// Cases in the outer, methods in the inner loop.
    pub cases: Vec<CalibratedCase>,
    /// Scenes in the outer, methods in the inner loop.
    pub predictions: Vec<PredictionTable>,
}

impl Calibrated {
    /// Whether no promise was found broken: no interval short, no exact value wrong, no bias by
    /// stopping, and predictions true in nine runs of ten; each as far as chance leaves no doubt.
    /// Intervals wider than promised break none.
    pub fn is_kept(&self) -> bool {
        self.cases.iter().all(CalibratedCase::is_kept)
            && self.predictions.iter().all(PredictionTable::is_kept)
    }
}

/// One case by one engine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CalibratedCase {
    /// Name of the case.
    pub case: &'static str,
    /// Engine.
    pub method: Method,
    /// Accuracy asked for.
    pub accuracy: f64,
    /// Seeds run.
    pub runs: u64,
    /// Runs that came to the accuracy asked for.
    pub reached: u64,
    /// Which part of the light is read.
    pub quantity: Quantity,
    /// What was seen at the stages.
    pub stages: Vec<CalibratedStage>,
    /// Whether stopping where errors look small makes them too small; `None` if all runs stop after
    /// as many increments.
    pub stopping: Option<StoppingBias>,
    /// Every place at the stop.
    pub receivers: Vec<CalibratedReceiver>,
}

impl CalibratedCase {
    /// As [`Calibrated::is_kept`].
    pub fn is_kept(&self) -> bool {
        self.stages.iter().all(|s| s.judgement != Some(Judgement::Short) && s.exact_wrong == 0)
            && !self.stopping.as_ref().is_some_and(StoppingBias::is_found)
    }
}

/// One stage, over all seeds that came to it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CalibratedStage {
    /// Which.
    pub stage: Stage,
    /// Runs that came to it.
    pub runs: u64,
    /// Fewest, median and most increments.
    pub increments: [u64; 3],
    /// Intervals by all errors that the map reports; empty where it reports none.
    pub coverage: Vec<Coverage>,
    /// Intervals by standard errors alone.
    pub coverage_by_noise: Vec<Coverage>,
    /// Intervals of 95 % by all errors.
    pub judgement: Option<Judgement>,
    /// The error of the scene.
    pub scene: Option<SceneFigure>,
    /// Readings without a value.
    pub unknown: u64,
    /// Readings without any error reported, and of them those that are wrong.
    pub exact: u64,
    /// See `exact`.
    pub exact_wrong: u64,
}

/// Coverage of 95 % where runs stop, against that after a number of increments fixed beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StoppingBias {
    /// Increments fixed.
    pub fixed_increments: u64,
    /// Runs counted.
    pub runs: u64,
    /// Coverage at the stop less that at fixed work.
    pub difference: f64,
    /// Standard error of the difference, over seeds.
    pub standard_error: f64,
}

impl StoppingBias {
    /// Beyond three standard errors and one per cent: what is less does not matter.
    pub fn is_found(&self) -> bool {
        self.difference < -(3.0 * self.standard_error).max(0.01)
    }
}

/// One place at the stop, over all seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CalibratedReceiver {
    /// Where, m.
    pub position: [f64; 3],
    /// The exact value, lx.
    pub expected_lx: f64,
    /// Mean error over seeds, lx.
    pub mean_error_lx: f64,
    /// Intervals of 95 % by all errors; `None` where exact or without a value.
    pub coverage: Option<Coverage>,
}

/// What one run takes: seed 0, which is not counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Increments at its end.
    pub increments: u64,
    /// Time on one thread, past its end to the last stage, s.
    pub time_s: f64,
    /// Whether chance has a part in it; if not, all seeds tell the same.
    pub is_random: bool,
}

/// Runs a case once, to know what many seeds will take.
pub fn trial(
    case: &Case,
    method: Method,
    settings: &CalibrateSettings,
) -> Result<Trial, CalibrateError> {
    let started = Instant::now();
    let observed = runs(case, method, &[0], settings, None, &mut |_| Watch::Continue)?;
    let stop = observed.first().and_then(|o| o.at(Stage::AtStop));
    Ok(Trial {
        increments: stop.map_or(0, |o| o.increments),
        time_s: started.elapsed().as_secs_f64(),
        is_random: stop.is_some_and(|o| o.readings.iter().flatten().any(|r| !r.is_exact())),
    })
}

/// Runs a case from many seeds. `fixed_work` is a number of increments chosen beforehand, as that of
/// a [`trial`]. `on_run` is called after every run, from any thread, and may stop the others.
pub fn calibrate(
    case: &Case,
    method: Method,
    seeds: &[u64],
    fixed_work: u64,
    settings: &CalibrateSettings,
    on_run: &mut (dyn FnMut(&Observed) -> Watch + Send),
) -> Result<CalibratedCase, CalibrateError> {
    let observed = runs(case, method, seeds, settings, Some(fixed_work), on_run)?;
    Ok(calibrate_observed(case, method, settings.accuracy, fixed_work, &observed))
}

/// Runs on all threads, each of them on one; in the order of the seeds.
fn runs(
    case: &Case,
    method: Method,
    seeds: &[u64],
    settings: &CalibrateSettings,
    fixed_work: Option<u64>,
    on_run: &mut (dyn FnMut(&Observed) -> Watch + Send),
) -> Result<Vec<Observed>, CalibrateError> {
    let scene = scene_of(case)?;
    let places = places(case);
    let threads = settings.threads.clamp(1, seeds.len().max(1));
    let one = |&seed: &u64| {
        let request = SolveRequest {
            method,
            seed,
            accuracy: Some(settings.accuracy),
            time_limit: Some(settings.time_limit),
            max_memory_bytes: settings.max_memory_bytes / threads as u64,
            // Runs go on where an audit would end them; the maps looked at are audited by themselves.
            audit: false,
            ..SolveRequest::default()
        };
        observe(&scene, &request, &places, fixed_work)
            .map_err(|error| ValidateError::Solve { case: case.name, error })
    };
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let done = Mutex::new((Vec::new(), on_run));
    let work = || -> Result<(), CalibrateError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.map_err(|e| CalibrateError::Thread(e.to_string()))?;
        while let Some(seed) = seeds.get(next.fetch_add(1, Ordering::Relaxed)) {
            if stopped.load(Ordering::Relaxed) {
                break;
            }
            let observed = pool.install(|| one(seed))?;
            // A run that panics ends all: no lock outlives it.
            let Ok(mut done) = done.lock() else { break };
            if (done.1)(&observed) == Watch::Stop {
                stopped.store(true, Ordering::Relaxed);
            }
            done.0.push(observed);
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().try_for_each(|worker| {
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    })?;
    let (mut observed, _) = done.into_inner().unwrap_or_else(|poison| poison.into_inner());
    observed.sort_by_key(|o| o.seed);
    Ok(observed)
}

/// The table of runs that were observed.
pub fn calibrate_observed(
    case: &Case,
    method: Method,
    accuracy: f64,
    fixed_work: u64,
    runs: &[Observed],
) -> CalibratedCase {
    let places = places(case);
    let stages = Stage::ALL.into_iter().filter_map(|stage| {
        let at: Vec<&Observation> = runs.iter().filter_map(|run| run.at(stage)).collect();
        calibrated_stage(stage, &at)
    });
    let stop: Vec<&Observation> = runs.iter().filter_map(|run| run.at(Stage::AtStop)).collect();
    CalibratedCase {
        case: case.name,
        method,
        accuracy,
        runs: runs.len() as u64,
        reached: runs.iter().filter(|run| run.reached).count() as u64,
        quantity: places.first().map_or(Quantity::Total, |place| place.quantity),
        stages: stages.collect(),
        stopping: stopping_bias(fixed_work, runs),
        receivers: places.iter().enumerate().map(|(k, place)| receiver(k, place, &stop)).collect(),
    }
}

/// `None` if no run came to it.
fn calibrated_stage(stage: Stage, at: &[&Observation]) -> Option<CalibratedStage> {
    let mut increments: Vec<u64> = at.iter().map(|o| o.increments).collect();
    increments.sort_unstable();
    let middle = *increments.get(increments.len() / 2)?;
    let readings = || at.iter().flat_map(|o| &o.readings);
    let exact = || readings().flatten().filter(|r| r.is_exact());
    let coverage = |holds: fn(&Interval, f64) -> bool| -> Vec<Coverage> {
        let uncertain: Vec<Vec<Option<Interval>>> = at.iter().map(|o| uncertain(o)).collect();
        let seeds = || uncertain.iter().map(Vec::as_slice);
        CONFIDENCES.iter().filter_map(|&c| Coverage::of(c, seeds(), holds)).collect()
    };
    let whole = coverage(Interval::holds);
    Some(CalibratedStage {
        stage,
        runs: at.len() as u64,
        increments: [increments[0], middle, increments[increments.len() - 1]],
        judgement: whole.get(1).map(Coverage::judge),
        coverage: whole,
        coverage_by_noise: coverage(Interval::noise_holds),
        scene: SceneFigure::of(at.iter().copied()),
        unknown: readings().filter(|r| r.is_none()).count() as u64,
        exact: exact().count() as u64,
        exact_wrong: exact().filter(|r| !r.holds(1.0)).count() as u64,
    })
}

fn uncertain(observation: &Observation) -> Vec<Option<Interval>> {
    observation.readings.iter().map(|r| r.filter(|r| !r.is_exact())).collect()
}

fn receiver(index: usize, place: &Place, stop: &[&Observation]) -> CalibratedReceiver {
    let readings: Vec<Interval> = stop.iter().filter_map(|o| o.readings[index]).collect();
    let uncertain = readings.iter().filter(|r| !r.is_exact());
    let counts: Vec<[u64; 2]> =
        uncertain.map(|r| [u64::from(r.holds(CONFIDENCES[1])), 1]).collect();
    let sum: f64 = readings.iter().map(|r| r.error_lx).sum();
    CalibratedReceiver {
        position: place.at.position.into(),
        expected_lx: place.expected_lx,
        mean_error_lx: sum / readings.len().max(1) as f64,
        coverage: Coverage::of_counts(CONFIDENCES[1], &counts),
    }
}

fn stopping_bias(fixed_increments: u64, runs: &[Observed]) -> Option<StoppingBias> {
    let share = |observation: &Observation| {
        let readings = uncertain(observation);
        let all = readings.iter().flatten().count();
        let held = readings.iter().flatten().filter(|r| r.holds(CONFIDENCES[1])).count();
        (all > 0).then(|| held as f64 / all as f64)
    };
    let pairs: Vec<[&Observation; 2]> = runs
        .iter()
        .filter_map(|run| Some([run.at(Stage::AtStop)?, run.at(Stage::FixedWork)?]))
        .collect();
    if pairs.iter().all(|[stop, fixed]| stop.increments == fixed.increments) {
        return None;
    }
    let differences: Vec<f64> =
        pairs.iter().filter_map(|[stop, fixed]| Some(share(stop)? - share(fixed)?)).collect();
    let n = differences.len() as f64;
    let difference = differences.iter().sum::<f64>() / n;
    let squares: f64 = differences.iter().map(|d| (d - difference) * (d - difference)).sum();
    let standard_error = (squares / (n * (n - 1.0))).sqrt();
    let runs = differences.len() as u64;
    (runs > 1).then_some(StoppingBias { fixed_increments, runs, difference, standard_error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::find;

    /// Coarse, so that it takes a second.
    fn settings(threads: usize) -> CalibrateSettings {
        CalibrateSettings { accuracy: 0.1, threads, ..CalibrateSettings::default() }
    }

    fn observed(threads: usize) -> (Case, Vec<Observed>) {
        let case = find("cube").expect("a case");
        let go_on = &mut |_: &Observed| Watch::Continue;
        let seeds = [1, 2, 3, 4];
        let runs = runs(&case, Method::Hybrid, &seeds, &settings(threads), Some(12), go_on);
        (case, runs.expect("CUBE has light"))
    }

    /// Errors said to be so many times what they are said to be.
    fn saying(factor: f64, runs: &[Observed]) -> Vec<Observed> {
        let mut runs = runs.to_vec();
        let stages = runs.iter_mut().flat_map(|run| &mut run.stages);
        for reading in stages.flat_map(|(_, o)| &mut o.readings).flatten() {
            reading.standard_error_lx *= factor;
            reading.rest_lx *= factor;
        }
        runs
    }

    #[test]
    fn stages_are_seen_in_order_on_any_number_of_threads() {
        let (case, runs) = observed(1);
        assert_eq!(observed(3).1, runs);
        let table = calibrate_observed(&case, Method::Hybrid, 0.1, 12, &runs);
        let at =
            |stage: Stage| table.stages.iter().find(|s| s.stage == stage).map(|s| s.increments[1]);
        assert_eq!(at(Stage::FirstBelieved), Some(8));
        assert_eq!(at(Stage::FixedWork), Some(12));
        assert_eq!(at(Stage::FourTimes), Some(32));
        assert!(at(Stage::AtStop).is_some_and(|n| n >= 8));
        assert_eq!((table.runs, table.reached), (4, 4));
        assert!(table.stages.iter().all(|s| s.unknown == 0 && s.runs == 4));
    }

    #[test]
    fn an_engine_made_overconfident_is_found_out() {
        let (case, runs) = observed(2);
        let kept = |factor: f64| {
            let runs = saying(factor, &runs);
            calibrate_observed(&case, Method::Hybrid, 0.1, 12, &runs).is_kept()
        };
        assert!(kept(1.5), "errors said too large break no promise");
        assert!(!kept(0.1));
    }

    #[test]
    fn stopping_on_a_lucky_dip_is_found() {
        let interval = |error_lx: f64| Interval {
            error_lx,
            standard_error_lx: 1.0,
            degrees_of_freedom: 1e9,
            rest_lx: 0.0,
            bound_lx: 0.0,
        };
        let (_, runs) = observed(2);
        let mut dipped = runs.clone();
        for (stage, observation) in dipped.iter_mut().flat_map(|run| &mut run.stages) {
            let error_lx = if *stage == Stage::AtStop { 3.0 } else { 0.0 };
            observation.readings = vec![Some(interval(error_lx)); 20];
        }
        assert!(stopping_bias(12, &dipped).is_some_and(|bias| bias.is_found()));
        assert!(stopping_bias(12, &runs).is_none_or(|bias| !bias.is_found()));
    }
}
