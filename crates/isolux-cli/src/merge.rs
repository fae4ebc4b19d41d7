//! `isolux merge`: parts of a run to its map.

use crate::claim::Claim;
use crate::console::{facts, print, print_json};
use crate::energy;
use crate::failure::{Failure, Outcome};
use crate::flags::MergeFlags;
use crate::interrupt::Interrupt;
use crate::output::OutputPath;
use crate::part_files::{read_part, read_pilot, write_part};
use crate::progress::Reporter;
use crate::report::Report;
use crate::solving::{Solved, tell_of_end, unsolvable};
use crate::{map_file, memory, parted, request, source};
use isolux::engine::{SolveError, Watch, solve_merged};
use isolux_formats::checkpoint::Part;
use serde::Serialize;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What is told of a part.
#[derive(Serialize)]
struct Merged {
    file: String,
    increments: Vec<[u64; 2]>,
}

/// Runs the subcommand.
pub(crate) fn run(flags: &MergeFlags, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check_any(&flags.output, &["glb", "part"])?;
    flags.parts.iter().try_for_each(|part| output.differs_from(part))?;
    let _claim = Claim::of(&output)?;
    let merged = merged(&flags.parts)?;
    if parted::is_wanted(&output) {
        write_part(output.path(), &merged)?;
        let increments =
            merged.part.ranges().iter().map(|range| [range.start, range.end]).collect();
        let merged = Merged { file: output.path().display().to_string(), increments };
        return print_merged(&merged, json);
    }
    let path = flags.scene.clone().unwrap_or_else(|| PathBuf::from(&merged.scene));
    let scene = source::read_scene(&path).map_err(|failure| missing(failure, &path, flags))?;
    let scene = match merged.part.identity.radiosity.diffuse_only {
        true => source::diffuse(&path, &scene)?,
        false => scene,
    };
    let request = request::of_run(&merged.part.identity, !flags.no_filter);
    let pilot = flags.pilot.as_deref().map(|path| read_pilot(path, request.max_memory_bytes));
    let pilot = pilot.transpose()?;
    let other = pilot.as_ref().and_then(|p| merged.part.identity.difference(&p.identity));
    if let Some((what, pilot)) = other.zip(flags.pilot.as_ref()) {
        return Err(Failure::bad_input(format!(
            "{}: the pilot and the parts differ in {what}; give the pilot that the parts were made with, or leave --pilot out",
            pilot.display()
        )));
    }
    let interrupt = Interrupt::install()?;
    let mut reporter = Reporter::new(flags.progress);
    let solved =
        solve_merged(&scene, &request, pilot.as_ref(), &merged.part, &mut |progress, _| {
            reporter.show(progress);
            if interrupt.is_requested() { Watch::Stop } else { Watch::Continue }
        });
    reporter.finish();
    let solution = solved.map_err(|error| match error {
        SolveError::OtherRun(what) => of_other_run(what, &path, &merged.scene),
        SolveError::Missing(range) => incomplete(&output, range),
        other => unsolvable(other, (&scene, &path)),
    })?;
    map_file::write(&output, &scene, &solution.map)?;
    let outcome = match solution.map.provenance.complete {
        true => Outcome::Done,
        false => Outcome::StoppedEarly,
    };
    let solved = Solved { solution, outcome, beyond: None };
    // Of few increments the error is not known yet.
    if solved.solution.map.provenance.accuracy.is_some() {
        tell_of_end(&solved, &request);
    }
    let Solved { solution, .. } = solved;
    let report = Report::of((&scene, &solution.map), solution.time_s, &output);
    let report = report.with_energy(energy::of_run(&scene, &solution.map));
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

/// Parts that are not of the run that their scene tells of; `of_parts` is the scene by the name that they have of it.
fn of_other_run(what: &str, scene: &Path, of_parts: &str) -> Failure {
    let is_by_name = scene.as_os_str() == of_parts;
    let scene = scene.display();
    Failure::bad_input(match what {
        "the scene" if is_by_name => {
            format!(
                "{scene}: has changed since the parts were made of it; name theirs with --scene"
            )
        }
        "the scene" => format!(
            "{scene}: is not the scene that the parts are of, which was `{of_parts}`, or it has changed since; name theirs with --scene"
        ),
        _ => format!(
            "{scene}: the parts differ in {what}; name their scene with --scene, their pilot with --pilot, and use the same build"
        ),
    })
}

/// Parts with a gap.
fn incomplete(output: &OutputPath, Range { start, end }: Range<u64>) -> Failure {
    Failure::bad_input(format!(
        "{}: not written: increments {start}..{end} are in no part; make them with `isolux solve --increments {start}..{end}`, or \
         write what is there as a .part",
        output.path().display()
    ))
}

/// All parts as one.
fn merged(paths: &[PathBuf]) -> Result<Part, Failure> {
    let mut merged: Option<Part> = None;
    for path in paths {
        let read = read_part(path, memory::of_map())?;
        let Some(all) = &mut merged else {
            merged = Some(read);
            continue;
        };
        all.part.merge(read.part).map_err(|error| {
            Failure::bad_input(format!("{}: {error}; leave it out", path.display()))
        })?;
    }
    Ok(merged.expect("the command needs one part at least"))
}

/// A scene that is not there may be elsewhere on this machine.
fn missing(failure: Failure, path: &Path, flags: &MergeFlags) -> Failure {
    if flags.scene.is_some() || path.exists() || source::is_builtin(path) {
        return failure;
    }
    Failure::bad_input(format!(
        "{}: the scene of the parts does not exist here; name it with --scene",
        path.display()
    ))
}

fn print_merged(merged: &Merged, json: bool) -> Result<Outcome, Failure> {
    if json {
        print_json(merged)?;
    } else {
        let ranges = merged.increments.iter().map(|[first, end]| format!("{first}..{end}"));
        let ranges = ranges.collect::<Vec<_>>().join(", ");
        print(&facts(&[("written", merged.file.clone()), ("increments", ranges)]))?;
    }
    Ok(Outcome::Done)
}
