//! `isolux grid`: illuminance on calculation grids.

mod asked;
pub(crate) mod choice;
pub(crate) mod decide;
pub(crate) mod emergency;
mod figures;
mod luminance;
mod modelling;
pub(crate) mod picture;
mod report;
pub(crate) mod requirement;
pub(crate) mod result;
mod rows;
mod warnings;

use crate::failure::{Failure, Outcome};
use crate::flags::{GridFlags, QuantityName};
use crate::maintained::Maintained;
use crate::output::OutputPath;
use crate::{map_file, source};
pub(crate) use asked::Asked;
use isolux::engine::MapReader;
use isolux::map::{IlluminationMap, Verdict};
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::Digits;
use report::Found;
use result::GridResult;
use rows::rows;

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
    if flags.quantity == QuantityName::Luminance {
        return luminances(flags, (csv, json), (&scene, map));
    }
    if flags.eye.is_some() {
        return Err(Failure::bad_input(
            "--eye: only luminances are seen by an eye; leave it out or add --quantity luminance",
        ));
    }
    let asked = Asked::of(flags, &scene)?;
    let source = (flags.source.as_path(), &scene);
    let grids = requirement::grids((&flags.grid, asked.is_planar()), &flags.required, source)?;
    if picture.is_some() && grids.len() > 1 {
        return Err(Failure::bad_input(format!(
            "--picture: {} has {} grids; choose one with --name",
            flags.source.display(),
            grids.len()
        )));
    }
    let read = |reader: &MapReader| {
        let read = |grid: &CalculationGrid| GridResult::of(grid.clone(), (&scene, reader), &asked);
        grids.iter().map(read).collect::<Vec<GridResult>>()
    };
    let judge = |map: &IlluminationMap| {
        let reader = MapReader::new(&scene, map);
        requirement::judge(&read(&reader), (&scene, &reader))
    };
    let (map, outcome) = match map {
        Some(map) => (map, Outcome::Done),
        None => {
            decide::decided((&scene, &flags.source), flags.required.accuracy, (&grids, &judge))?
        }
    };
    map_file::warn_of_unknown_error(&flags.source, &map);
    let light = Maintained::of(&scene);
    let reader = MapReader::new(&scene, &map);
    let results = read(&reader);
    let judged = requirement::judge(&results, (&scene, &reader))?;
    warn(&results, &map, light);
    if let Some(csv) = csv {
        csv.write(rows(&results, &asked, digits(flags)).as_bytes())?;
    }
    if let (Some(output), [result]) = (picture, &results[..]) {
        picture::write(&output, &scene, (result, &asked))?;
    }
    let found = Found { results: &results, judged: &judged, light, asked: &asked };
    found.tell(&scene, json)?;
    let all_met = judged.iter().all(|judged| judged.verdict == Verdict::Met);
    Ok(if all_met { outcome } else { Outcome::CheckFailed })
}

/// Luminances as an eye sees them.
fn luminances(
    flags: &GridFlags,
    (csv, json): (Option<OutputPath>, bool),
    (scene, map): (&Scene, Option<IlluminationMap>),
) -> Result<Outcome, Failure> {
    let eye = luminance::eye(flags)?;
    let source = (flags.source.as_path(), scene);
    let grids = requirement::grids((&flags.grid, false), &flags.required, source)?;
    let (map, outcome) = match map {
        Some(map) => (map, Outcome::Done),
        None => decide::decided(
            (scene, &flags.source),
            flags.required.accuracy,
            (&grids, &|_| Ok(Vec::new())),
        )?,
    };
    map_file::warn_of_unknown_error(&flags.source, &map);
    let digits = digits(flags);
    let request = luminance::Request { eye, grids: &grids, csv, digits };
    luminance::tell(request, (scene, &map), json)?;
    Ok(outcome)
}

fn digits(flags: &GridFlags) -> Digits {
    flags.digits.map_or(Digits::ByError, Digits::Significant)
}

/// The scene, and its map where it is solved.
fn opened(flags: &GridFlags) -> Result<(Scene, Option<IlluminationMap>), Failure> {
    if !map_file::is_map(&flags.source) {
        return Ok((source::read_scene(&flags.source)?, None));
    }
    let (scene, map) = map_file::read_solved(&flags.source, flags.required.accuracy)?;
    Ok((scene, Some(map)))
}

/// What figures do not say.
fn warn(results: &[GridResult], map: &IlluminationMap, light: Maintained) {
    for GridResult { read, in_space, outside, .. } in results {
        requirement::warn_of_initial(&read.grid, light);
        let caustic = in_space.then(|| map.caustic_share());
        warnings::warn(&read.grid.name, (&read.values, outside), caustic);
    }
}
