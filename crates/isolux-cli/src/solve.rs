//! `isolux solve`: a scene to a map.

use crate::console::{facts, print, print_json};
use crate::estimate::Estimate;
use crate::failure::{Failure, Outcome};
use crate::flags::{ProgressStyle, SolveFlags};
use crate::interrupt::Interrupt;
use crate::notes::{Note, note, note_as_json};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::quantity::show_bytes;
use crate::report::Report;
use crate::{cache_samples, explain, groups, map_file, request, saved_run, source};
use isolux::engine::{self, RunState, Solution, SolveError, SolveRequest, Watch};
use isolux::scene::Scene;
use std::path::Path;

/// Runs the subcommand.
pub(crate) fn run(flags: &SolveFlags, json: bool) -> Result<Outcome, Failure> {
    if flags.progress == Some(ProgressStyle::Json) {
        note_as_json();
    }
    let mut asked = request::solution(flags)?;
    request::use_threads(flags.threads)?;
    let scene = source::read_scene(&flags.scene)?;
    let scene = match flags.radiosity.diffuse_only {
        true => source::diffuse(&flags.scene, &scene)?,
        false => scene,
    };
    if flags.explain {
        explain::lines(&scene, &asked.request).iter().for_each(|line| note(Note::Info, line));
    }
    let groups = flags.group.then(|| groups::of(&scene, &flags.scene)).transpose()?;
    let Some(output) = asked.output.filter(|_| !flags.dry_run) else {
        let estimate = match &groups {
            Some(groups) => groups::estimate(groups, &flags.scene, &asked.request)?,
            None => estimate(&scene, &flags.scene, &asked.request)?,
        };
        return print_estimate(&estimate, json);
    };
    if let Some(groups) = groups {
        let run = Run { source: &flags.scene, output: &output, request: &asked.request };
        return groups::run(&groups, &run, flags, json);
    }
    saved_run::check_writable(&output)?;
    let saved =
        if flags.resume { saved_run::read(&output, asked.request.max_memory_bytes)? } else { None };
    let mut cache = None;
    if let Some(path) = &flags.cache {
        // Samples take more memory than bytes of the file, and rays come on top.
        let (file, samples) =
            cache_samples::open(path, &scene, asked.request.max_memory_bytes / 4)?;
        asked.request.cache = samples;
        cache = Some(file);
    }
    let mut reporter = Reporter::new(flags.progress);
    let run = Run { source: &flags.scene, output: &output, request: &asked.request };
    let solved = solve(&scene, &run, saved.as_ref(), &mut reporter)?;
    map_file::write(&output, &scene, &solved.solution.map)?;
    let finished = matches!(solved.outcome, Outcome::Done);
    if let Some(file) = &mut cache {
        cache_samples::keep(file, &solved.solution.cache);
    }
    saved_run::keep(&output, &solved.solution.state, finished)?;
    let report = Report::of(&solved.solution.map, solved.solution.time_s, &output);
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(solved.outcome)
}

/// What a run would need.
pub(crate) fn estimate(
    scene: &Scene,
    source: &Path,
    request: &SolveRequest,
) -> Result<Estimate, Failure> {
    Estimate::of(scene, request).map_err(|error| unsolvable(error, source))
}

fn print_estimate(estimate: &Estimate, json: bool) -> Result<Outcome, Failure> {
    if json {
        print_json(estimate)?;
    } else {
        let [receivers, memory, time] = estimate.shown();
        print(&facts(&[("receivers", receivers), ("memory", memory), ("time", time)]))?;
    }
    Ok(Outcome::Done)
}

/// A solution and how its computation ended.
pub(crate) struct Solved {
    /// The map and the state of the run.
    pub solution: Solution,
    /// Done, stopped by a limit, or interrupted.
    pub outcome: Outcome,
}

/// What is computed from what, and where it goes.
pub(crate) struct Run<'a> {
    /// The scene as the user named it.
    pub source: &'a Path,
    /// The map.
    pub output: &'a OutputPath,
    /// What is asked of the engine.
    pub request: &'a SolveRequest,
}

/// Computes a map, reports progress, and ends early at a signal.
pub(crate) fn solve(
    scene: &Scene,
    run: &Run,
    saved: Option<&RunState>,
    reporter: &mut Reporter,
) -> Result<Solved, Failure> {
    follow(scene, run.request, saved, reporter, |error| failure(error, run))
}

/// The same where the map goes nowhere.
pub(crate) fn solve_here(
    (scene, source): (&Scene, &Path),
    request: &SolveRequest,
) -> Result<Solved, Failure> {
    let reporter = &mut Reporter::new(None);
    follow(scene, request, None, reporter, |error| unsolvable(error, source))
}

fn follow(
    scene: &Scene,
    request: &SolveRequest,
    saved: Option<&RunState>,
    reporter: &mut Reporter,
    failure: impl Fn(SolveError) -> Failure,
) -> Result<Solved, Failure> {
    let interrupt = Interrupt::install()?;
    let solved = engine::solve(scene, request, saved, &mut |progress| {
        reporter.show(progress);
        if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
    });
    reporter.finish();
    let solution = solved.map_err(failure)?;
    let outcome = match (solution.map.provenance.complete, interrupt.is_requested()) {
        (true, _) => Outcome::Done,
        (false, true) => Outcome::Interrupted,
        (false, false) => Outcome::StoppedEarly,
    };
    Ok(Solved { solution, outcome })
}

/// Sorted by who can mend it.
fn failure(error: SolveError, run: &Run) -> Failure {
    match error {
        SolveError::OtherRun(what) => Failure::bad_input(format!(
            "{}: the saved run differs in {what}; repeat its flags, or solve without --resume",
            saved_run::path_beside(run.output.path()).display()
        )),
        other => unsolvable(other, run.source),
    }
}

/// Why a scene cannot be solved.
fn unsolvable(error: SolveError, path: &Path) -> Failure {
    let source = path.display();
    match error {
        SolveError::Memory { needed, allowed } => Failure::Refused(format!(
            "{source}: the map needs about {}, more than the {} of --max-memory; raise it, or ask \
             for less with --mesh-accuracy",
            show_bytes(needed),
            show_bytes(allowed)
        )),
        SolveError::NoLight => source::no_light(path),
        SolveError::NoReceiver => Failure::bad_input(format!(
            "{source}: no surface can carry a map: all are mirrors, glass or without area; give one \
             a diffuse reflectance, and check the scales"
        )),
        other => Failure::bad_input(format!("{source}: {other}")),
    }
}
