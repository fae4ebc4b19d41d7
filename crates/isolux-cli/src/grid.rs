//! `isolux grid`: illuminance on calculation grids.

mod figures;
mod picture;
mod result;
mod warnings;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::GridFlags;
use crate::maintained::{self, Maintained};
use crate::output::OutputPath;
use crate::quantity::significant;
use crate::shown::{name, names};
use crate::{map_file, solving, source};
use isolux::engine::{MapReader, SolveRequest};
use isolux::geometry::{Point, Vector};
use isolux::map::{Figure, GridFigures, Illuminance, IlluminationMap};
use isolux::scene::{CalculationGrid, Scene, UpAxis};
use isolux_formats::Digits;
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
    let (map, outcome) = match map {
        Some(map) => (map, Outcome::Done),
        None => solved(flags, &scene)?,
    };
    map_file::warn_of_unknown_error(&flags.source, &map);
    let reader = MapReader::new(&scene, &map);
    let light = Maintained::of(&scene);
    let results: Vec<GridResult> =
        grids.into_iter().map(|grid| GridResult::of(grid, (&scene, &reader))).collect();
    for GridResult { read, in_space, outside } in &results {
        warnings::warn(
            &read.grid.name,
            (&read.values, outside),
            in_space.then(|| map.caustic_share()),
        );
    }
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
        print_json(&Reports { grids })?;
    } else {
        print(&figures::text(&results, light))?;
    }
    Ok(outcome)
}

/// The grids asked for, as they are asked for.
fn grids(flags: &GridFlags, scene: &Scene) -> Result<Vec<CalculationGrid>, Failure> {
    if let Some(factor) = flags.maintenance_factor {
        maintained::refuse_second(factor, scene, &flags.source)?;
    }
    let mut grids = match (flags.height, flags.corner.zip(flags.u.zip(flags.v))) {
        (Some(height_m), _) => vec![working_plane(flags, scene, height_m)?],
        (None, Some((corner, (u, v)))) => vec![CalculationGrid {
            name: "grid".into(),
            corner: Point::from(corner),
            u: Vector::from(u),
            v: Vector::from(v),
            spacing_m: None,
            border_m: 0.0,
            maintenance_factor: 1.0,
        }],
        (None, None) => named(flags, scene)?,
    };
    for grid in &mut grids {
        grid.spacing_m = flags.spacing.or(grid.spacing_m);
        grid.border_m = flags.border.unwrap_or(grid.border_m);
        grid.maintenance_factor = flags.maintenance_factor.unwrap_or(grid.maintenance_factor);
        if let Some((what, remedy)) = grid.problem() {
            return Err(Failure::bad_input(format!(
                "grid `{}` {what}; {remedy}",
                name(&grid.name)
            )));
        }
    }
    Ok(grids)
}

fn named(flags: &GridFlags, scene: &Scene) -> Result<Vec<CalculationGrid>, Failure> {
    let all = scene.grids();
    let source = flags.source.display();
    if all.is_empty() {
        return Err(Failure::bad_input(format!(
            "{source}: has no calculation grids; give one with --height or --corner, --u and --v, or add \
             [[grid]] to its scene.toml"
        )));
    }
    let Some(name) = &flags.name else { return Ok(all.to_vec()) };
    let found: Vec<CalculationGrid> = all.iter().filter(|g| g.name == *name).cloned().collect();
    if found.is_empty() {
        return Err(Failure::bad_input(format!(
            "{source}: has no grid `{name}`; choose one of {}",
            names(all.iter().map(|g| g.name.as_str()))
        )));
    }
    Ok(found)
}

/// A horizontal grid over all of the floor plan, facing up.
fn working_plane(
    flags: &GridFlags,
    scene: &Scene,
    height_m: f64,
) -> Result<CalculationGrid, Failure> {
    let mut low = Vector::new(f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    for corner in (0..scene.triangle_count()).flat_map(|t| scene.triangle(t).corners) {
        low = Vector::new(low.x.min(corner.x), low.y.min(corner.y), low.z.min(corner.z));
        high = Vector::new(high.x.max(corner.x), high.y.max(corner.y), high.z.max(corner.z));
    }
    let size = high - low;
    let (lowest_m, highest_m) = match scene.up() {
        UpAxis::Z => (low.z, high.z),
        UpAxis::Y => (low.y, high.y),
    };
    if !(lowest_m..=highest_m).contains(&height_m) {
        return Err(Failure::bad_input(format!(
            "{}: --height {height_m} lies outside of the scene, which goes from {} to {} m; give one between",
            flags.source.display(),
            significant(lowest_m, 3),
            significant(highest_m, 3)
        )));
    }
    let (corner, u, v) = match scene.up() {
        UpAxis::Z => (
            Point::new(low.x, low.y, height_m),
            Vector::new(size.x, 0.0, 0.0),
            Vector::new(0.0, size.y, 0.0),
        ),
        UpAxis::Y => (
            Point::new(low.x, height_m, high.z),
            Vector::new(size.x, 0.0, 0.0),
            Vector::new(0.0, 0.0, -size.z),
        ),
    };
    Ok(CalculationGrid {
        name: format!("working plane at {height_m} m"),
        corner,
        u,
        v,
        spacing_m: None,
        border_m: CalculationGrid::usual_border_m([u.length(), v.length()]),
        maintenance_factor: 1.0,
    })
}

/// The map of a scene, as accurate as asked.
fn solved(flags: &GridFlags, scene: &Scene) -> Result<(IlluminationMap, Outcome), Failure> {
    let default = SolveRequest::default();
    let accuracy = flags.accuracy.or(default.accuracy);
    let request = SolveRequest { accuracy, ..default };
    let solved = solving::solve_here((scene, &flags.source), &request)?;
    Ok((solved.solution.map, solved.outcome))
}

/// What `grid --json` prints.
#[derive(Serialize)]
struct Reports {
    grids: Vec<Report>,
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
struct Interval {
    value: f64,
    low: f64,
    high: f64,
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
        let interval = |read: fn(&GridFigures) -> Figure| {
            result.read.figures.as_ref().map(read).map(|Figure { value, low, high }| Interval {
                value,
                low,
                high,
            })
        };
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
