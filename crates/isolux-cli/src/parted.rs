//! `isolux solve --increments`: parts of a run, and its pilot alone.

use crate::claim::Claim;
use crate::console::{facts, print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::SolveFlags;
use crate::interrupt::Interrupt;
use crate::output::OutputPath;
use crate::part_files::{read_pilot, write_part, write_pilot};
use crate::progress::Reporter;
use crate::quantity::{Increments, show_count, show_seconds};
use crate::solving::unsolvable;
use isolux::engine::{
    PilotState, Progress, RunPart, SoFar, SolveError, SolveRequest, Watch, make_pilot, with_parts,
};
use isolux::scene::Scene;
use isolux_formats::checkpoint::Part;
use serde::Serialize;
use std::time::Instant;

/// Whether a part or a pilot is to be written, by the name of the file.
pub(crate) fn is_wanted(output: &OutputPath) -> bool {
    let extension = output.path().extension().map(|e| e.to_ascii_lowercase());
    extension.is_some_and(|extension| extension == "part" || extension == "pilot")
}

/// What was written.
#[derive(Serialize)]
struct Report {
    scene: String,
    file: String,
    /// The first increment and the one after the last; nothing for a pilot.
    increments: Option<[u64; 2]>,
    receivers: usize,
    rays: u64,
    time_s: f64,
}

impl Report {
    fn text(&self) -> String {
        let made = self.increments.map(|[first, end]| ("increments", format!("{first}..{end}")));
        let mut all = vec![("written", self.file.clone())];
        all.extend(made);
        all.extend([
            ("receivers", show_count(self.receivers as f64)),
            ("rays", show_count(self.rays as f64)),
            ("time", show_seconds(self.time_s)),
        ]);
        facts(&all)
    }
}

/// Makes the increments that are asked for, or the pilot alone, and writes them.
pub(crate) fn run(
    flags: &SolveFlags,
    (scene, output, request): (&Scene, &OutputPath, &SolveRequest),
    json: bool,
) -> Result<Outcome, Failure> {
    let started = Instant::now();
    let _claim = Claim::of(output)?;
    let interrupt = Interrupt::install()?;
    let mut reporter = Reporter::new(flags.progress);
    let mut watch = |progress: &Progress, _: &SoFar<'_>| {
        reporter.show(progress);
        if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
    };
    let failure = |error| match (error, &flags.pilot) {
        (SolveError::OtherRun("the scene"), Some(pilot)) => Failure::bad_input(format!(
            "{}: is the pilot of another scene than {}, or that has changed since; give the pilot of this scene, or leave --pilot out",
            pilot.display(),
            flags.scene.display()
        )),
        (SolveError::OtherRun(what), Some(pilot)) => Failure::bad_input(format!(
            "{}: the pilot differs in {what}; repeat its flags, or leave --pilot out",
            pilot.display()
        )),
        (SolveError::Unsound(what), Some(pilot)) => Failure::bad_input(format!(
            "{}: {what} does not fit the scene: it is damaged; leave --pilot out",
            pilot.display()
        )),
        (error, _) => unsolvable(error, (scene, &flags.scene)),
    };
    let pilot = match &flags.pilot {
        Some(path) => Some(read_pilot(path, request.max_memory_bytes)?),
        None => make_pilot(scene, request, &mut watch).map_err(failure)?,
    };
    let Some(pilot) = pilot else { return Err(too_short(output)) };
    let made = flags.increments.map(|Increments { first, end }| {
        with_parts(scene, request, &pilot, |maker| maker.make(first..end, &mut watch))
    });
    let made: Option<RunPart> = made.transpose().map_err(failure)?;
    reporter.finish();
    let rays = made.as_ref().map_or(pilot.rays, |part| part.segments.iter().map(|s| s.rays).sum());
    let report = |increments: Option<[u64; 2]>| Report {
        scene: scene.name().to_owned(),
        file: output.path().display().to_string(),
        increments,
        receivers: pilot.result.receivers(),
        rays,
        time_s: started.elapsed().as_secs_f64(),
    };
    let Some(part) = made else {
        write(&pilot, output)?;
        return tell(&report(None), json, Outcome::Done);
    };
    let range = part.ranges().pop().ok_or_else(|| too_short(output))?;
    let is_whole = flags.increments.is_some_and(|asked| asked.end == range.end);
    write_part(output.path(), &Part { scene: flags.scene.display().to_string(), part })?;
    let outcome = match (is_whole, interrupt.is_requested()) {
        (true, _) => Outcome::Done,
        (false, true) => Outcome::Interrupted,
        (false, false) => Outcome::StoppedEarly,
    };
    tell(&report(Some([range.start, range.end])), json, outcome)
}

fn tell(report: &Report, json: bool, outcome: Outcome) -> Result<Outcome, Failure> {
    if json {
        print_json(report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

fn write(pilot: &PilotState, output: &OutputPath) -> Result<(), Failure> {
    let written = write_pilot(output.path(), pilot);
    written.map_err(|problem| Failure::Refused(problem.to_string()))
}

fn too_short(output: &OutputPath) -> Failure {
    Failure::bad_input(format!(
        "{}: not written: the run was stopped before its pilot or its first increment was complete; allow more time",
        output.path().display()
    ))
}
