//! `isolux solve`: a scene to a map.

use crate::arriving::FluxLost;
use crate::claim::Claim;
use crate::clock::Clock;
use crate::console::{facts, print, print_json};
use crate::energy;
use crate::estimate::Estimate;
use crate::failure::{Failure, Outcome};
use crate::flags::{ProgressStyle, SolveFlags};
use crate::lightmap::{self, Planned};
use crate::lightmap_files::Made;
use crate::notes::{Note, note, note_as_json};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::report::Report;
use crate::serving::Live;
use crate::solving::{Run, Solved, estimate, solve};
use crate::{cache_samples, explain, groups, kept, memory, parted, request, saved_run, source};
use isolux::engine::{IrradianceCache, RunState, Solution, SolveRequest};
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
    let is_apart = |output: &&OutputPath| !flags.dry_run && parted::is_wanted(output);
    if let Some(output) = asked.output.as_ref().filter(is_apart) {
        return parted::run(flags, (&scene, output, &asked.request), json);
    }
    let groups = flags.group.then(|| groups::of(&scene, &flags.scene)).transpose()?;
    let Some(output) = asked.output.filter(|_| !flags.dry_run) else {
        let estimate = match &groups {
            Some(groups) => groups::estimate(groups, &flags.scene, &asked.request)?,
            None => estimate(&scene, &flags.scene, &asked.request)?,
        };
        let memory_bytes = memory::of_lightmap();
        let lightmap = Planned::asked(&flags.layout, &scene, memory_bytes)?;
        let count = groups.map_or(1, |groups| groups.len() + 1);
        let lightmap = lightmap.map(|planned| planned.sizes(&scene, count));
        return print_estimate(&DryRun { estimate, lightmap }, json);
    };
    let clock = Clock::start(asked.request.time_limit);
    if let Some(groups) = groups {
        let run = Run { source: &flags.scene, output: &output, request: &asked.request };
        return groups::run((&scene, &groups), (&run, clock), flags, json);
    }
    let _claim = Claim::of(&output)?;
    let mut live = match flags.live {
        true => Some(Live::start(&flags.server, &scene, output.path())?),
        false => None,
    };
    let written = one(flags, (&scene, &output), &mut asked.request, (clock, live.as_mut()))?;
    let outcome = written.print(json)?;
    if let Some(live) = live {
        live.linger();
    }
    Ok(outcome)
}

/// A map written, and how that ended.
struct Written {
    outcome: Outcome,
    report: Report,
}

impl Written {
    fn print(&self, json: bool) -> Result<Outcome, Failure> {
        if json {
            print_json(&self.report)?
        } else {
            print(&self.report.text())?
        }
        Ok(self.outcome)
    }
}

/// Solves a scene, writes its map, bakes texels if asked to.
fn one(
    flags: &SolveFlags,
    (scene, output): (&Scene, &OutputPath),
    request: &mut SolveRequest,
    (clock, mut live): (Clock, Option<&mut Live>),
) -> Result<Written, Failure> {
    saved_run::check_writable(output)?;
    let lightmap = Planned::ahead(&flags.layout, scene, (output, memory::of_lightmap()))?;
    let saved =
        if flags.resume { saved_run::read(output, request.max_memory_bytes)? } else { None };
    let mut cache = None;
    if let Some(path) = &flags.cache {
        // Samples take more memory than bytes of the file, and rays come on top.
        let (file, samples) = cache_samples::open(path, scene, request.max_memory_bytes / 4)?;
        request.cache = samples;
        cache = Some(file);
    }
    let earlier = saved.as_ref().and_then(|saved| earlier(saved, output, (scene, request)));
    if let (Some(lightmap), None) = (&lightmap, &earlier) {
        request.time_limit = lightmap.time_to_solve(scene, clock, 1);
    }
    let flux_lost = FluxLost::told(scene);
    let mut solved = match earlier {
        Some(earlier) => earlier,
        None => watched(flags, (scene, output), request, (saved.as_ref(), live.as_deref_mut()))?,
    };
    let run = Run { source: &flags.scene, output, request };
    let written = kept::write((scene, &run), &mut solved, flags.resume);
    // Until a lightmap is written, too, there is something to go on with.
    let finished = solved.outcome == Outcome::Done && lightmap.is_none();
    let kept = kept::with_map(&written, solved.outcome)
        .then(|| kept::keep_state(output, (&solved.solution.state, saved.as_ref()), finished));
    let less = written?;
    kept.transpose()?;
    if let Some(live) = live {
        live.end(&solved.solution, output.path());
    }
    if let Some(file) = &mut cache {
        cache_samples::keep(file, &solved.solution.cache);
    }
    let (outcome, lightmap) = match &lightmap {
        Some(planned) => bake(output, (scene, planned), &solved, (clock, flags.progress))?,
        None => {
            lightmap::tell_of_older(output, &[]);
            (solved.outcome, None)
        }
    };
    if outcome == Outcome::Done && !finished {
        saved_run::keep(output, &solved.solution.state, true)?;
    }
    let report = Report::of((scene, &solved.solution.map), solved.solution.time_s, output);
    let energy = energy::of_run(scene, &solved.solution.map);
    let report = report.with_flux_lost(flux_lost).with_energy(energy);
    Ok(Written { outcome, report: report.with_lightmap(lightmap).instead_of(less) })
}

/// Runs, and anew for every other accuracy that a viewer asks for: the map is that of a run that was asked for it at once.
fn watched(
    flags: &SolveFlags,
    (scene, output): (&Scene, &OutputPath),
    request: &mut SolveRequest,
    (mut saved, mut live): (Option<&RunState>, Option<&mut Live>),
) -> Result<Solved, Failure> {
    loop {
        if let Some(live) = &mut live {
            live.begin(request);
        }
        let run = Run { source: &flags.scene, output, request };
        let mut reporter = Reporter::new(flags.progress);
        let solved = solve(scene, &run, saved, (&mut reporter, live.as_deref_mut()))?;
        let next = live.as_mut().and_then(|live| live.next_target());
        match next.filter(|_| solved.outcome != Outcome::Interrupted) {
            Some(accuracy) => (request.accuracy, saved) = (Some(accuracy), None),
            None => return Ok(solved),
        }
    }
}

/// The map of an earlier run that was complete, and stopped only thereafter.
fn earlier(
    saved: &RunState,
    output: &OutputPath,
    (scene, request): (&Scene, &SolveRequest),
) -> Option<Solved> {
    let map = saved_run::complete_map(saved, output, (scene, request))?;
    let text = format!("{}: is solved already", output.path().display());
    note(Note::Info, text);
    let solution = Solution {
        map,
        state: saved.clone(),
        cache: IrradianceCache::default(),
        time_s: 0.0,
        lacked_time: false,
    };
    Some(Solved { solution, outcome: Outcome::Done, beyond: None })
}

/// Writes the map anew, as texels. Interrupted it leaves the map at vertices, which is written already: hours of work
/// are not lost by what follows.
fn bake(
    output: &OutputPath,
    (scene, planned): (&Scene, &Planned),
    solved: &Solved,
    how: (Clock, Option<ProgressStyle>),
) -> Result<(Outcome, Option<lightmap::Report>), Failure> {
    let map = &solved.solution.map;
    let baked = match solved.outcome {
        Outcome::Interrupted => None,
        _ => planned.bake((scene, map), how)?,
    };
    let Some(baked) = baked else {
        lightmap::tell_of_missing(output);
        return Ok((Outcome::Interrupted, None));
    };
    let report = baked.write(scene, map, (output, Target::Viewer, Made::Map))?;
    let outcome = if baked.is_coarse() { Outcome::StoppedEarly } else { solved.outcome };
    Ok((outcome, Some(report)))
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
        let solving = if run.lightmap.is_some() { "time to solve" } else { "time" };
        let mut all = vec![("receivers", receivers), ("memory", memory), (solving, time)];
        if let Some(sizes) = &run.lightmap {
            all.extend([("lightmap", sizes.text()), ("time to bake", sizes.time_text())]);
        }
        print(&facts(&all))?;
    }
    Ok(Outcome::Done)
}
