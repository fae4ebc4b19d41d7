//! `isolux validate --calibrate`: whether reported errors are the errors that are made.

use super::calibrated_text::text;
use super::chosen::{chosen, methods, seeds};
use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::ValidateFlags;
use crate::interrupt::Interrupt;
use crate::notes::{Note, note};
use crate::quantity::show_seconds;
use crate::request;
use isolux::engine::{SolveRequest, Watch};
use isolux::map::Method;
use isolux::scene::Scene;
use isolux_compare::calibrate::{
    CALIBRATED_CASES, CalibrateError, CalibrateSettings, Calibrated, CalibratedCase, Trial,
    calibrate, predict_scene, trial,
};
use isolux_compare::case::find;
use isolux_compare::{BUILTIN_NAMES, Case, builtin};

const DEFAULT_SEEDS: u32 = 200;
/// Of runs that chance has no part in.
const SEEDS_IF_EXACT: usize = 2;
/// Predictions need whole runs one after another: a tenth of the seeds, and no fewer than this.
const FEWEST_PREDICTED: u32 = 10;
/// A line of progress for so many runs.
const RUNS_A_LINE: u64 = 25;

/// Runs the calibration.
pub(super) fn run(flags: &ValidateFlags, json: bool) -> Result<Outcome, Failure> {
    let mut settings = CalibrateSettings::default();
    settings.accuracy = flags.accuracy.unwrap_or(settings.accuracy);
    let count = flags.seeds.unwrap_or(DEFAULT_SEEDS);
    let interrupt = Interrupt::install()?;
    let jobs = jobs(flags, count, &settings, &interrupt)?;
    if !jobs.is_empty() {
        let total_s: f64 = jobs.iter().map(|job| job.time_s(&settings)).sum();
        note(Note::Info, format!("the cases take about {}", show_seconds(total_s)));
    }
    let mut calibrated = Calibrated::default();
    for job in &jobs {
        if !interrupt.is_requested() {
            calibrated.cases.push(job.run(&settings, &interrupt)?);
        }
    }
    predict(&mut calibrated, flags, count, &settings, &interrupt)?;
    if json {
        print_json(&calibrated)?
    } else {
        print(&text(&calibrated))?
    }
    Ok(match (interrupt.is_requested(), calibrated.is_kept()) {
        (true, _) => Outcome::Interrupted,
        (false, false) => Outcome::CheckFailed,
        (false, true) => Outcome::Done,
    })
}

/// A case, an engine, and what one run of them takes.
struct Job {
    case: Case,
    method: Method,
    seeds: Vec<u64>,
    trial: Trial,
}

fn jobs(
    flags: &ValidateFlags,
    count: u32,
    settings: &CalibrateSettings,
    interrupt: &Interrupt,
) -> Result<Vec<Job>, Failure> {
    let name = flags.case.as_deref();
    let is_known = name.is_some_and(|name| BUILTIN_NAMES.contains(&name));
    // A built-in scene without exact answers still has a finishing time.
    let mut cases =
        if is_known { find(name.unwrap_or_default()).into_iter().collect() } else { chosen(name)? };
    cases.retain(|case| name.is_some() || CALIBRATED_CASES.contains(&case.name));
    let mut jobs = Vec::new();
    for case in cases {
        for method in methods(flags) {
            if interrupt.is_requested() {
                return Ok(jobs);
            }
            let trial = trial(&case, method, settings).map_err(failure)?;
            let mut seeds = seeds(count);
            if !trial.is_random {
                seeds.truncate(SEEDS_IF_EXACT);
            }
            jobs.push(Job { case, method, seeds, trial });
        }
    }
    Ok(jobs)
}

impl Job {
    fn time_s(&self, settings: &CalibrateSettings) -> f64 {
        self.seeds.len() as f64 * self.trial.time_s / settings.threads as f64
    }

    fn run(
        &self,
        settings: &CalibrateSettings,
        interrupt: &Interrupt,
    ) -> Result<CalibratedCase, Failure> {
        let name = format!("{} {}", self.case.name, request::method_name(self.method));
        let took = show_seconds(self.time_s(settings));
        note(Note::Info, format!("{name}: {} runs, about {took}", self.seeds.len()));
        let mut done = 0;
        let mut on_run = |_: &_| {
            done += 1;
            if done % RUNS_A_LINE == 0 {
                note(Note::Info, format!("{name}: {done} of {}", self.seeds.len()));
            }
            if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
        };
        let fixed = self.trial.increments;
        calibrate(&self.case, self.method, &self.seeds, fixed, settings, &mut on_run)
            .map_err(failure)
    }
}

fn failure(error: CalibrateError) -> Failure {
    Failure::Refused(error.to_string())
}

fn predict(
    calibrated: &mut Calibrated,
    flags: &ValidateFlags,
    count: u32,
    settings: &CalibrateSettings,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let seeds = seeds((count / 10).max(FEWEST_PREDICTED).min(count));
    let is_asked = |name: &&str| flags.case.as_deref().is_none_or(|case| case == *name);
    for name in BUILTIN_NAMES.into_iter().filter(is_asked) {
        let parts = builtin(name).map_err(Failure::bad_input)?;
        let scene = Scene::assemble(parts).map_err(Failure::bad_inputs)?;
        for method in methods(flags) {
            if interrupt.is_requested() {
                return Ok(());
            }
            let request = SolveRequest {
                method,
                accuracy: Some(settings.accuracy),
                time_limit: Some(settings.time_limit),
                max_memory_bytes: settings.max_memory_bytes,
                ..SolveRequest::default()
            };
            let method = request::method_name(method);
            note(Note::Info, format!("{name} {method}: {} predicted runs", seeds.len()));
            let table = predict_scene(&scene, &request, &seeds, &mut |_| {
                if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
            });
            calibrated.predictions.push(table.map_err(failure)?);
        }
    }
    Ok(())
}
