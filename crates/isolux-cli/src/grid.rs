//! `isolux grid`: illuminance on calculation grids.

pub(crate) mod choice;
pub(crate) mod decide;
mod figures;
pub(crate) mod picture;
pub(crate) mod requirement;
pub(crate) mod result;
mod warnings;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::GridFlags;
use crate::interval::{Interval, Verdict};
use crate::maintained::{self, Maintained};
use crate::output::OutputPath;
use crate::{map_file, source};
use isolux::engine::MapReader;
use isolux::geometry::Point;
use isolux::map::{Figure, GridFigures, Illuminance, IlluminationMap};
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::Digits;
use requirement::Judged;
use result::GridResult;
use serde::Serialize;
use std::fmt::Write;

/// Runs the subcommand.
pub(crate) fn run(flags: &GridFlags, json: bool) -> Result<Outcome, Failure> {
    let csv = flags.csv.as_deref().map(|path| OutputPath::check(path, "csv")).transpose()?;
    let picture = flags
        .picture
        .as_deref()
        .map(|path| OutputPath::check_any(path, &["png", "svg"]))
        .transpose()?;
    let (scene, map) = if map_file::is_map(&flags.source) {
        if flags.accuracy.is_some() {
            return Err(Failure::bad_input(format!(
                "--accuracy: {} is a map, which is solved; leave it out or give a scene",
                flags.source.display()
            )));
        }
        let (scene, map) = map_file::read(&flags.source)?;
        (scene, Some(map))
    } else {
        (source::read_scene(&flags.source)?, None)
    };
    let grids = grids(flags, &scene)?;
    if picture.is_some() && grids.len() > 1 {
        return Err(Failure::bad_input(format!(
            "--picture: {} has {} grids; choose one with --name",
            flags.source.display(),
            grids.len()
        )));
    }
    let read = |map: &IlluminationMap| {
        let reader = MapReader::new(&scene, map);
        let read = |grid: &CalculationGrid| GridResult::of(grid.clone(), (&scene, &reader));
        grids.iter().map(read).collect::<Vec<GridResult>>()
    };
    let (map, outcome) = match map {
        Some(map) => (map, Outcome::Done),
        None => decide::decided((&scene, &flags.source), flags.accuracy, &grids)?,
    };
    map_file::warn_of_unknown_error(&flags.source, &map);
    let light = Maintained::of(&scene);
    let results = read(&map);
    let judged = requirement::judge(&results)?;
    warn(&results, &map, light);
    if let Some(csv) = csv {
        csv.write(
            rows(&results, flags.digits.map_or(Digits::ByError, Digits::Significant)).as_bytes(),
        )?;
    }
    if let (Some(output), [result]) = (picture, &results[..]) {
        picture::write(&output, &scene, result)?;
    }
    if json {
        let grids = results.iter().map(|result| Report::of(result, light)).collect();
        print_json(&Reports { grids, requirements: &judged })?;
    } else {
        print(&figures::text(&results, light))?;
        for judged in &judged {
            print(&format!("{}\n", judged.line()))?;
        }
    }
    let all_met = judged.iter().all(|judged| judged.verdict == Verdict::Met);
    Ok(if all_met { outcome } else { Outcome::CheckFailed })
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
    requirement::add(&flags.require, &mut grids)?;
    Ok(grids)
}

/// What figures do not say.
fn warn(results: &[GridResult], map: &IlluminationMap, light: Maintained) {
    for GridResult { read, in_space, outside } in results {
        requirement::warn_of_initial(&read.grid, light);
        let caustic = in_space.then(|| map.caustic_share());
        warnings::warn(&read.grid.name, (&read.values, outside), caustic);
    }
}

/// What `grid --json` prints.
#[derive(Serialize)]
struct Reports<'a> {
    grids: Vec<Report>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    requirements: &'a [Judged],
}

#[derive(Serialize)]
struct Report {
    name: String,
    maintenance_factor: f64,
    #[serde(flatten)]
    maintained: Maintained,
    /// Numbers of points along the sides, and their distances.
    counts: [u32; 2],
    spacing_m: [f64; 2],
    border_m: f64,
    points: usize,
    /// Of them, those with a value.
    known: usize,
    mean_lx: Option<Interval>,
    least_lx: Option<Interval>,
    greatest_lx: Option<Interval>,
    uniformity: Option<Interval>,
    diversity: Option<Interval>,
    direct_lx: Option<f64>,
    indirect_lx: Option<f64>,
    /// At every point, along `u` first; null where not known.
    values: Vec<Value>,
}

#[derive(Serialize)]
struct Value {
    position: [f64; 3],
    illuminance_lx: Option<f64>,
    standard_error_lx: Option<f64>,
    direct_lx: Option<f64>,
    indirect_lx: Option<f64>,
}

impl Report {
    fn of(result: &GridResult, light: Maintained) -> Self {
        let interval = |read: fn(&GridFigures) -> Figure| result.read.figures.as_ref().map(read);
        let (counts, sides_m) = (result.read.grid.counts(), result.read.grid.sides_m());
        Self {
            name: result.read.grid.name.clone(),
            maintenance_factor: result.read.grid.maintenance_factor,
            maintained: light.on_grid(result.read.grid.maintenance_factor),
            counts,
            spacing_m: [0, 1].map(|k| sides_m[k] / f64::from(counts[k])),
            border_m: result.read.grid.border_m,
            points: result.read.points.len(),
            known: result.read.figures.map_or(0, |f| f.known),
            mean_lx: interval(|f| f.mean_lx),
            least_lx: interval(|f| f.least_lx),
            greatest_lx: interval(|f| f.greatest_lx),
            uniformity: interval(|f| f.uniformity),
            diversity: interval(|f| f.diversity),
            direct_lx: result.read.figures.map(|f| f.direct_lx),
            indirect_lx: result.read.figures.map(|f| f.indirect_lx),
            values: result.read.points.iter().zip(result.read.maintained()).map(value).collect(),
        }
    }
}

fn value((&position, value): (&Point, Option<Illuminance>)) -> Value {
    Value {
        position: position.into(),
        illuminance_lx: value.map(|v| v.illuminance_lx()),
        standard_error_lx: value.map(|v| v.standard_error_lx),
        direct_lx: value.map(|v| v.direct_lx.luminance()),
        indirect_lx: value.map(|v| v.indirect_lx.luminance()),
    }
}

const HEADER: &str =
    "grid,i,j,x,y,z,illuminance_lx,standard_error_lx,direct_lx,indirect_lx,maintenance_factor\n";

/// All points as CSV.
fn rows(results: &[GridResult], digits: Digits) -> String {
    let mut text = HEADER.to_owned();
    for result in results {
        let across = result.read.grid.counts()[0] as usize;
        let name = format!("\"{}\"", result.read.grid.name.replace('"', "\"\""));
        for (index, (&position, of)) in
            result.read.points.iter().zip(result.read.maintained()).enumerate()
        {
            let Value { illuminance_lx, standard_error_lx, direct_lx, indirect_lx, .. } =
                value((&position, of));
            let error_lx = standard_error_lx.unwrap_or(f64::NAN);
            let fields = [illuminance_lx, standard_error_lx, direct_lx, indirect_lx]
                .map(|field| field.map_or(String::new(), |v| digits.number(v, error_lx)));
            let (i, j, Point { x, y, z }) = (index % across, index / across, position);
            let factor = result.read.grid.maintenance_factor;
            let _ = writeln!(text, "{name},{i},{j},{x},{y},{z},{},{factor}", fields.join(","));
        }
    }
    text
}
