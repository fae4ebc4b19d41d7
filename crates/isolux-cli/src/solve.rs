//! `isolux solve`: a scene to a map.

use crate::console::{facts, print, print_json};
use crate::estimate::Estimate;
use crate::failure::{Failure, Outcome};
use crate::flags::{ProgressStyle, SolveFlags};
use crate::lightmap::{self, Planned};
use crate::notes::{Note, note, note_as_json};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::report::Report;
use crate::solving::{Run, Solved, estimate, solve};
use crate::{cache_samples, explain, groups, map_file, request, saved_run, source};
use isolux::scene::Scene;
use isolux_formats::lightmap::Target;
use serde::Serialize;

/// Runs the subcommand.
pub(crate) fn run(flags: &SolveFlags, json: bool) -> Result<Outcome, Failure> {
    if flags.progress == Some(ProgressStyle::Json) {
        note_as_json();
    }
    let mut asked = request::solution(flags)?;
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
        let memory_bytes = asked.request.max_memory_bytes;
        let lightmap = Planned::asked(&flags.layout, &scene, memory_bytes)?;
        let lightmap = lightmap.map(|planned| planned.sizes(&scene));
        return print_estimate(&DryRun { estimate, lightmap }, json);
    };
    if let Some(groups) = groups {
        let run = Run { source: &flags.scene, output: &output, request: &asked.request };
        return groups::run((&scene, &groups), &run, flags, json);
    }
    saved_run::check_writable(&output)?;
    let lightmap =
        Planned::ahead(&flags.layout, &scene, (&output, asked.request.max_memory_bytes))?;
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
    let finished = matches!(solved.outcome, Outcome::Done);
    map_file::write(&output, &scene, &solved.solution.map)?;
    if let Some(file) = &mut cache {
        cache_samples::keep(file, &solved.solution.cache);
    }
    saved_run::keep(&output, &solved.solution.state, finished)?;
    let (outcome, lightmap) = bake(&output, &scene, (&solved, lightmap))?;
    let report = Report::of(&solved.solution.map, solved.solution.time_s, &output);
    let report = report.with_lightmap(lightmap);
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

/// Writes the map anew, as texels, if so planned. Interrupted it leaves the map at vertices, which is written
/// already: hours of work are not lost by what follows.
fn bake(
    output: &OutputPath,
    scene: &Scene,
    (solved, planned): (&Solved, Option<Planned>),
) -> Result<(Outcome, Option<lightmap::Report>), Failure> {
    let Some(planned) = planned else { return Ok((solved.outcome, None)) };
    let map = &solved.solution.map;
    let baked = match solved.outcome {
        Outcome::Interrupted => None,
        _ => planned.bake(scene, map)?,
    };
    let Some(baked) = baked else {
        lightmap::tell_of_missing(output);
        return Ok((Outcome::Interrupted, None));
    };
    let report = baked.write(scene, map, (output, Target::Viewer, true))?;
    Ok((solved.outcome, Some(report)))
}

/// What a run would need.
#[derive(Serialize)]
struct DryRun {
    #[serde(flatten)]
    estimate: Estimate,
    #[serde(skip_serializing_if = "Option::is_none")]
    lightmap: Option<lightmap::Sizes>,
}

fn print_estimate(run: &DryRun, json: bool) -> Result<Outcome, Failure> {
    if json {
        print_json(run)?;
    } else {
        let [receivers, memory, time] = run.estimate.shown();
        let mut all = vec![("receivers", receivers), ("memory", memory), ("time", time)];
        all.extend(run.lightmap.as_ref().map(|sizes| ("lightmap", sizes.text())));
        print(&facts(&all))?;
    }
    Ok(Outcome::Done)
}
