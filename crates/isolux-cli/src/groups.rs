//! `solve --group`: a map for every group of luminaires, and their sum.

use crate::arriving::FluxLost;
use crate::claim::Claim;
use crate::clock::Clock;
use crate::console::{print, print_json, table};
use crate::estimate::Estimate;
use crate::failure::{Failure, Outcome};
use crate::flags::{LayoutName, ProgressStyle, SolveFlags};
use crate::lightmap::{self, Planned};
use crate::lightmap_files::Made;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::quantity::{show_seconds, show_share};
use crate::report::Report;
use crate::solving::{self, Run, Solved};
use crate::{kept, map_file, memory, saved_run, shown};
use isolux::engine::{MixPart, SolveRequest, mix};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::counted;
use isolux_formats::lightmap::Target;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A group with light of its own.
pub(crate) struct Group {
    name: String,
    scene: Scene,
}

/// The groups of a scene that have light; those without are told of.
pub(crate) fn of(scene: &Scene, source: &Path) -> Result<Vec<Group>, Failure> {
    let mut groups = Vec::new();
    for (number, name) in scene.groups().iter().enumerate() {
        match scene.lit_by(number as u32).filter(Scene::gives_light) {
            Some(lit) => groups.push(Group { name: name.clone(), scene: lit }),
            None => note(
                Note::Info,
                format!("group \"{}\" has no light and gets no map", shown::name(name)),
            ),
        }
    }
    if !groups.is_empty() {
        return Ok(groups);
    }
    Err(Failure::bad_input(format!(
        "{}: has no groups of luminaires; give luminaires a `group = \"NAME\"` in a scene.toml, or leave \
         --group out",
        source.display()
    )))
}

/// What all runs together would need.
pub(crate) fn estimate(
    groups: &[Group],
    source: &Path,
    request: &SolveRequest,
) -> Result<Estimate, Failure> {
    let each = groups.iter().map(|group| solving::estimate(&group.scene, source, request));
    Ok(Estimate::one_after_another(&each.collect::<Result<Vec<_>, _>>()?))
}

/// Where the map of a group goes: beside the sum, with the name of the group before the extension.
pub(crate) fn path_of(sum: &Path, group: &str) -> PathBuf {
    let safe = |c: char| if c.is_alphanumeric() || c == '_' { c } else { '-' };
    let name: String = group.chars().map(safe).collect();
    sum.with_extension(format!("{name}.glb"))
}

/// What is asked of the run of one group, of so many in all.
struct Turn<'a> {
    request: &'a SolveRequest,
    resume: bool,
    number: usize,
    left: usize,
    started: Instant,
}

/// Solves all groups, writes their maps and the sum.
pub(crate) fn run(
    (scene, groups): (&Scene, &[Group]),
    (whole, clock): (&Run, Clock),
    flags: &SolveFlags,
    json: bool,
) -> Result<Outcome, Failure> {
    let started = Instant::now();
    let resume = flags.resume;
    let (outputs, _claims) = outputs(groups, whole.output)?;
    let lightmap = planned((scene, &outputs), whole, flags)?;
    let mut request = whole.request.clone();
    if let Some(lightmap) = &lightmap {
        request.time_limit = lightmap.time_to_solve(scene, clock, groups.len() + 1);
    }
    let flux_lost = FluxLost::told(scene);
    let solving = Instant::now();
    let (mut maps, mut reports) = (Vec::new(), Vec::new());
    let mut outcome = Outcome::Done;
    for (number, (group, output)) in groups.iter().zip(&outputs).enumerate() {
        let left = groups.len() - number;
        let turn = Turn { request: &request, resume, number, left, started: solving };
        let reporter = &mut Reporter::new(flags.progress);
        let solved = solve_one(group, (whole.source, output), &turn, reporter)?;
        reports.push(GroupReport { group: group.name.clone(), report: solved.report });
        maps.push(solved.map);
        match solved.outcome {
            Outcome::Done => {}
            Outcome::Interrupted if left > 1 => {
                tell_what_is_missing(whole.output, left - 1);
                return Ok(Outcome::Interrupted);
            }
            other => outcome = other,
        }
    }
    let parts = groups.iter().zip(&maps);
    let parts: Vec<MixPart<'_>> =
        parts.map(|(group, map)| MixPart { scene: &group.scene, map, dimming: 1.0 }).collect();
    let (scene, map) = mix(&parts).map_err(|error| Failure::Refused(error.to_string()))?;
    map_file::write(whole.output, &scene, &map)?;
    let mut report = Reports {
        sum: Report::of((&scene, &map), started.elapsed().as_secs_f64(), whole.output)
            .with_flux_lost(flux_lost),
        groups: reports,
    };
    if lightmap.is_none() {
        outputs
            .iter()
            .chain([whole.output])
            .for_each(|output| lightmap::tell_of_older(output, &[]));
    }
    if let Some(lightmap) = lightmap {
        let lit = groups.iter().zip(&maps).map(|(group, map)| (&group.scene, map));
        let lit: Vec<_> = lit.zip(&outputs).chain([((&scene, &map), whole.output)]).collect();
        let (ended, baked) = bake(&lightmap, &lit, (clock, flags.progress))?;
        report = report.with_lightmaps(baked);
        outcome = match (outcome, ended) {
            (Outcome::Interrupted, _) | (_, Outcome::Done) => outcome,
            _ => ended,
        };
    }
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(outcome)
}

/// Says that there is no sum yet, as so many groups have no map.
fn tell_what_is_missing(sum: &OutputPath, groups: usize) {
    let (path, groups) = (sum.path().display(), counted(groups, "group has", "groups have"));
    let text = format!("{path}: not written, {groups} no map yet; go on with --resume");
    note(Note::Warning, text);
}

/// Where the map of each group goes, and claims to all of them and to the sum.
fn outputs(groups: &[Group], sum: &OutputPath) -> Result<(Vec<OutputPath>, Vec<Claim>), Failure> {
    let mut outputs = Vec::new();
    for group in groups {
        let path = path_of(sum.path(), &group.name);
        let output = OutputPath::check(&path, "glb")?;
        if outputs.iter().any(|other: &OutputPath| other.path() == path) {
            return Err(Failure::bad_input(format!(
                "{}: would be the map of two groups; give them names that differ in letters or digits",
                path.display()
            )));
        }
        saved_run::check_writable(&output)?;
        outputs.push(output);
    }
    let claims = outputs.iter().chain([sum]).map(Claim::of).collect::<Result<_, _>>()?;
    Ok((outputs, claims))
}

/// One layout for all groups: they light the same surfaces.
fn planned(
    (scene, outputs): (&Scene, &[OutputPath]),
    whole: &Run,
    flags: &SolveFlags,
) -> Result<Option<Planned>, Failure> {
    if flags.layout.layout == LayoutName::Texels {
        for output in outputs {
            OutputPath::check(&output.path().with_extension("exr"), "exr")?;
        }
    }
    Planned::ahead(&flags.layout, scene, (whole.output, memory::of_lightmap()))
}

/// Writes all maps anew, as texels of one layout; only the first of them if interrupted, which leaves the others at vertices.
fn bake(
    planned: &Planned,
    lit: &[((&Scene, &IlluminationMap), &OutputPath)],
    (clock, progress): (Clock, Option<ProgressStyle>),
) -> Result<(Outcome, Vec<lightmap::Report>), Failure> {
    let (mut reports, mut outcome) = (Vec::new(), Outcome::Done);
    for (index, &((scene, map), output)) in lit.iter().enumerate() {
        note(Note::Info, format!("lightmap of {}", output.path().display()));
        let clock = clock.next_of(lit.len() - index);
        let Some(baked) = planned.bake((scene, map), (clock, progress))? else {
            lit[index..].iter().for_each(|(_, output)| lightmap::tell_of_missing(output));
            return Ok((Outcome::Interrupted, reports));
        };
        reports.push(baked.write(scene, map, (output, Target::Viewer, Made::Map))?);
        if baked.is_coarse() {
            outcome = Outcome::StoppedEarly;
        }
    }
    Ok((outcome, reports))
}

struct SolvedGroup {
    map: IlluminationMap,
    report: Report,
    outcome: Outcome,
}

fn solve_one(
    group: &Group,
    (source, output): (&Path, &OutputPath),
    turn: &Turn<'_>,
    reporter: &mut Reporter,
) -> Result<SolvedGroup, Failure> {
    // Noise of groups must be independent, or it could not be told how they add up.
    let seed = turn.request.seed.wrapping_add(turn.number as u64);
    let share = |limit: std::time::Duration| {
        limit.saturating_sub(turn.started.elapsed()) / turn.left.max(1) as u32
    };
    let time_limit = turn.request.time_limit.map(share);
    let request = SolveRequest { seed, time_limit, ..turn.request.clone() };
    if turn.resume
        && let Some(map) = finished(output, group, &request)
    {
        note(Note::Info, format!("{}: is complete already", output.path().display()));
        let report = Report::of((&group.scene, &map), 0.0, output);
        return Ok(SolvedGroup { map, report, outcome: Outcome::Done });
    }
    let saved = match turn.resume {
        true => saved_run::read(output, request.max_memory_bytes)?,
        false => None,
    };
    note(Note::Info, format!("group \"{}\"", shown::name(&group.name)));
    let run = Run { source, output, request: &request };
    let mut solved = solving::solve(&group.scene, &run, saved.as_ref(), (reporter, None))?;
    let written = kept::write((&group.scene, &run), &mut solved, turn.resume);
    let Solved { solution, outcome, .. } = solved;
    let is_done = matches!(outcome, Outcome::Done);
    let kept = kept::with_map(&written, outcome)
        .then(|| kept::keep_state(output, (&solution.state, saved.as_ref()), is_done));
    let less = written?;
    kept.transpose()?;
    let report =
        Report::of((&group.scene, &solution.map), solution.time_s, output).instead_of(less);
    Ok(SolvedGroup { map: solution.map, report, outcome })
}

/// The map that an earlier run of the same kind has completed.
fn finished(output: &OutputPath, group: &Group, request: &SolveRequest) -> Option<IlluminationMap> {
    if !output.path().exists() || saved_run::path_beside(output.path()).exists() {
        return None;
    }
    let (scene, map) = map_file::read(output.path()).ok()?;
    let from = &map.provenance;
    let same = from.complete
        && from.scene_hash == group.scene.hash()
        && scene.hash() == from.scene_hash
        && from.version == env!("CARGO_PKG_VERSION")
        && from.method == request.method
        && from.seed == request.seed
        && from.accuracy_target == request.accuracy;
    same.then_some(map)
}

#[derive(Serialize)]
struct Reports {
    #[serde(flatten)]
    sum: Report,
    groups: Vec<GroupReport>,
}

#[derive(Serialize)]
struct GroupReport {
    group: String,
    #[serde(flatten)]
    report: Report,
}

impl Reports {
    /// With the lightmaps of the groups, and of the sum.
    fn with_lightmaps(self, baked: Vec<lightmap::Report>) -> Self {
        let mut baked = baked.into_iter();
        let groups = self
            .groups
            .into_iter()
            .map(|group| GroupReport { report: group.report.with_lightmap(baked.next()), ..group });
        Self { groups: groups.collect(), sum: self.sum.with_lightmap(baked.next()) }
    }

    fn text(&self) -> String {
        let row = |g: &GroupReport| {
            let Report { accuracy_reached, time_s, map, .. } = &g.report;
            let error = accuracy_reached.map_or("not known".to_owned(), show_share);
            vec![shown::name(&g.group), error, show_seconds(*time_s), map.clone()]
        };
        let rows: Vec<Vec<String>> = self.groups.iter().map(row).collect();
        format!("{}\n{}", self.sum.text(), table(&["group", "error", "time", "map"], &rows))
    }
}
