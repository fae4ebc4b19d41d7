//! `isolux grid`: illuminance on calculation grids.

mod asked;
pub(crate) mod choice;
mod condition;
mod emergency;
mod figures;
mod modelling;
mod picture;
mod report;
mod requirement;
mod result;
mod rows;
mod tasks;
mod warnings;

use crate::failure::{Failure, Outcome};
use crate::flags::GridFlags;
use crate::interval::Verdict;
use crate::maintained::{self, Maintained};
use crate::output::OutputPath;
use crate::{map_file, solving, source};
use asked::Asked;
use isolux::engine::{MapReader, SolveRequest};
use isolux::map::IlluminationMap;
use isolux::scene::{CalculationGrid, Scene};
use isolux_formats::Digits;
use report::Found;
use requirement::{Judged, Requirement, requirement};
use result::GridResult;
use rows::rows;

/// Accuracies with which requirements are tried to be decided, one after the other: each costs some four times the one before. What
/// is undecided at the last is too near its bound.
const ACCURACIES: [f64; 5] = [0.04, 0.02, 0.01, 0.005, 0.0025];

/// Runs the subcommand.
pub(crate) fn run(flags: &GridFlags, json: bool) -> Result<Outcome, Failure> {
    let csv = flags.csv.as_deref().map(|path| OutputPath::check(path, "csv")).transpose()?;
    let picture = flags
        .picture
        .as_deref()
        .map(|path| OutputPath::check_any(path, &["png", "svg"]))
        .transpose()?;
    let (scene, map) = opened(flags)?;
    if let Some(kind) = flags.emergency {
        return emergency::run((kind, flags), &scene, json);
    }
    let grids = grids(flags, &scene)?;
    if picture.is_some() && grids.len() > 1 {
        return Err(Failure::bad_input(format!(
            "--picture: {} has {} grids; choose one with --name",
            flags.source.display(),
            grids.len()
        )));
    }
    let (asked, requirements) = (Asked::of(flags, &scene)?, requirements(flags)?);
    let read = |map: &IlluminationMap| {
        let reader = MapReader::new(&scene, map);
        let read = |grid: &CalculationGrid| GridResult::of(grid.clone(), (&scene, &reader), &asked);
        grids.iter().map(read).collect::<Vec<GridResult>>()
    };
    let (map, outcome) = match map {
        Some(map) => (map, Outcome::Done),
        None => decided(flags, &scene, &requirements, &read)?,
    };
    map_file::warn_of_unknown_error(&flags.source, &map);
    let light = Maintained::of(&scene);
    let results = read(&map);
    let judged = requirement::judge(&requirements, &results)?;
    warn((&results, &judged), &map, light);
    if let Some(csv) = csv {
        csv.write(
            rows(&results, &asked, flags.digits.map_or(Digits::ByError, Digits::Significant))
                .as_bytes(),
        )?;
    }
    if let (Some(output), [result]) = (picture, &results[..]) {
        picture::write(&output, &scene, (result, &asked))?;
    }
    let found = Found { results: &results, judged: &judged, light, asked: &asked };
    found.tell(&scene, json)?;
    let all_met = judged.iter().all(|judged| judged.verdict == Verdict::Met);
    Ok(if all_met { outcome } else { Outcome::CheckFailed })
}

/// The scene, and its map where it is solved.
fn opened(flags: &GridFlags) -> Result<(Scene, Option<IlluminationMap>), Failure> {
    if !map_file::is_map(&flags.source) {
        return Ok((source::read_scene(&flags.source)?, None));
    }
    if flags.accuracy.is_some() {
        return Err(Failure::bad_input(format!(
            "--accuracy: {} is a map, which is solved; leave it out or give a scene",
            flags.source.display()
        )));
    }
    let (scene, map) = map_file::read(&flags.source)?;
    Ok((scene, Some(map)))
}

/// The grids asked for, as they are asked for.
fn grids(flags: &GridFlags, scene: &Scene) -> Result<Vec<CalculationGrid>, Failure> {
    if let Some(factor) = flags.maintenance_factor {
        maintained::refuse_second(factor, scene, &flags.source)?;
    }
    let mut grids = choice::chosen(&flags.grid, &flags.source, scene)?;
    for grid in &mut grids {
        grid.maintenance_factor = flags.maintenance_factor.unwrap_or(grid.maintenance_factor);
    }
    Ok(grids)
}

/// What figures do not say.
fn warn((results, judged): (&[GridResult], &[Judged]), map: &IlluminationMap, light: Maintained) {
    requirement::warn_of_initial(judged, results, light);
    for GridResult { read, in_space, outside, .. } in results {
        let caustic = in_space.then(|| map.caustic_share());
        warnings::warn(&read.grid.name, (&read.values, outside), caustic);
    }
}

/// What `--require` asks for.
fn requirements(flags: &GridFlags) -> Result<Vec<Requirement>, Failure> {
    let read = |text: &String| {
        requirement(text).map_err(|what| Failure::bad_input(format!("--require: {what}")))
    };
    flags.require.iter().map(read).collect()
}

/// The map of a scene: as accurate as asked or, with requirements and no accuracy, as accurate as they need to be decided.
fn decided(
    flags: &GridFlags,
    scene: &Scene,
    requirements: &[Requirement],
    read: &impl Fn(&IlluminationMap) -> Vec<GridResult>,
) -> Result<(IlluminationMap, Outcome), Failure> {
    if requirements.is_empty() || flags.accuracy.is_some() {
        return solved(flags.accuracy, flags, scene);
    }
    let [first, finer @ ..] = ACCURACIES;
    let mut found = solved(Some(first), flags, scene)?;
    for accuracy in finer {
        let judged = requirement::judge(requirements, &read(&found.0))?;
        let is_decided = judged.iter().all(|judged| judged.verdict != Verdict::Undecided);
        if is_decided || found.1 != Outcome::Done {
            break;
        }
        found = solved(Some(accuracy), flags, scene)?;
    }
    Ok(found)
}

/// The map of a scene, as accurate as asked.
fn solved(
    accuracy: Option<f64>,
    flags: &GridFlags,
    scene: &Scene,
) -> Result<(IlluminationMap, Outcome), Failure> {
    let default = SolveRequest::default();
    let accuracy = accuracy.or(default.accuracy);
    let request = SolveRequest { accuracy, ..default };
    let solved = solving::solve_here((scene, &flags.source), &request)?;
    Ok((solved.solution.map, solved.outcome))
}
