//! `isolux solve`: a scene to a map.

use crate::console::{facts, print, print_json};
use crate::estimate::Estimate;
use crate::failure::{Failure, Outcome};
use crate::flags::{ProgressStyle, SolveFlags};
use crate::notes::{Note, note, note_as_json};
use crate::progress::Reporter;
use crate::report::Report;
use crate::solving::{Run, estimate, solve};
use crate::{cache_samples, explain, groups, map_file, request, saved_run, source};

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

fn print_estimate(estimate: &Estimate, json: bool) -> Result<Outcome, Failure> {
    if json {
        print_json(estimate)?;
    } else {
        let [receivers, memory, time] = estimate.shown();
        print(&facts(&[("receivers", receivers), ("memory", memory), ("time", time)]))?;
    }
    Ok(Outcome::Done)
}
