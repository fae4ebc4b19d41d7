//! The plan of a grid.

use super::asked::Asked;
use super::figures;
use super::modelling;
use super::result::GridResult;
use crate::failure::Failure;
use crate::maintained::Maintained;
use crate::output::OutputPath;
use crate::quantity::significant;
use crate::render;
use crate::shown::name;
use isolux::geometry::{Point, Ray};
use isolux::map::Illuminance;
use isolux::scene::{Scene, UpAxis};
use isolux::units::to_error;
use isolux_formats::counted;
use isolux_view::{Plan, PlanPoint, PlanWords};
use std::collections::BTreeMap;

/// Draws a grid, as pixels or as SVG by the end of the name.
pub(super) fn write(
    output: &OutputPath,
    scene: &Scene,
    (result, asked): (&GridResult, &Asked),
) -> Result<(), Failure> {
    let grid = &result.read.grid;
    let points: Vec<PlanPoint> = match &result.modelling {
        Some(modelling) => modelling.values.iter().map(ratio).collect(),
        None => result.read.maintained().map(|value| point(value, &PlanWords::ENGLISH)).collect(),
    };
    let (title, lines) = heading(scene, (result, asked));
    let values = match asked.is_modelling() {
        true => "Modelling Ez/Eh",
        false => PlanWords::ENGLISH.values,
    };
    let plan = Plan {
        scene,
        grid,
        points: &points,
        title: &title,
        lines: &lines,
        longest: Plan::SHEET,
        words: &PlanWords { values, ..PlanWords::ENGLISH },
    };
    let drawing = plan.drawing().map_err(Failure::bad_input)?;
    if output.path().extension().is_some_and(|end| end.eq_ignore_ascii_case("svg")) {
        return output.write(drawing.svg().as_bytes());
    }
    render::write(output, &drawing.picture())
}

/// A point of a plan in the words of a language.
pub(crate) fn point(value: Option<Illuminance>, words: &PlanWords) -> PlanPoint {
    let lx = value.map(|value| value.illuminance_lx());
    let error_lx = value.map_or(0.0, |value| value.standard_error_lx);
    // Whole lux are enough on a plan, unless there are few.
    let label = |lx: f64| to_error(lx, error_lx.max(if lx < 10.0 { 0.1 } else { 2.0 }));
    let label = lx.map_or(String::new(), |lx| words.local(&label(lx)));
    PlanPoint { illuminance_lx: lx, standard_error_lx: error_lx, label }
}

fn ratio(of: &modelling::Point) -> PlanPoint {
    let error = of.standard_error.unwrap_or(0.0);
    let label = of.modelling.map_or(String::new(), |value| to_error(value, error.max(0.02)));
    PlanPoint { illuminance_lx: of.modelling, standard_error_lx: error, label }
}

/// The title, and lines below it.
fn heading(scene: &Scene, (result, asked): (&GridResult, &Asked)) -> (String, Vec<String>) {
    let grid = &result.read.grid;
    let title = if scene.name().is_empty() { grid.name.as_str() } else { scene.name() };
    let mut about = vec![format!("Grid: {}", name(&grid.name))];
    about.extend(match height_m(scene, result) {
        Some(m) => Some(format!("height {} m", short(m))),
        None => before(scene, result),
    });
    let counts = grid.counts();
    about.push(format!("{} x {} points", counts[0], counts[1]));
    about.push(match grid.maintenance_factor {
        1.0 => format!("values {}", Maintained::of(scene).text()),
        factor => format!("values maintained, maintenance factor {}", significant(factor, 2)),
    });
    let mut lines = vec![about.join("  \u{b7}  ")];
    if !asked.is_planar() {
        lines.push(asked.title());
    }
    lines.extend(result.modelling.as_ref().map(modelling::Modelling::text));
    if let Some(f) = result.read.figures {
        let all = [("Em", f.mean_lx), ("Emin", f.least_lx), ("Emax", f.greatest_lx)];
        lines.push(
            all.map(|(name, figure)| format!("{name} {} lx", figures::lux(figure))).join("   "),
        );
        let all = [("U0 = Emin/Em", f.uniformity), ("Ud = Emin/Emax", f.diversity)];
        lines.push(
            all.map(|(name, figure)| format!("{name} {}", figures::ratio(figure))).join("   "),
        );
    }
    if result.read.figures.is_none() {
        lines.push("no value is known at any of its points".to_owned());
    }
    let outside = result.outside.count();
    if outside > 0 {
        let points = counted(outside, "point", "points");
        lines.push(format!("{points} outside of the room are left out"));
    }
    (name(title), lines)
}

/// A length to the millimetre, without needless zeros.
fn short(m: f64) -> String {
    let text = format!("{m:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The surface that most points of a grid stand before, and how far: the wall that it shows.
fn before(scene: &Scene, result: &GridResult) -> Option<String> {
    /// A surface is looked for from so far before the points, m; what is so close to them is at them.
    const AT_M: f64 = 1e-3;
    let normal = result.read.normal.to_vector();
    let back = (-normal).direction()?;
    let hit = |&point: &Point| scene.bvh().closest_hit(&Ray::new(point + normal * AT_M, back));
    let mut far_m: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
    for hit in result.read.points.iter().filter_map(hit) {
        far_m.entry(scene.shape_of(hit.triangle)).or_default().push(f64::from(hit.t) - AT_M);
    }
    let (shape, far_m) = far_m.into_iter().max_by_key(|(_, far_m)| far_m.len())?;
    let shape = name(scene.shape_names().get(shape as usize)?);
    let nearest_m = far_m.iter().copied().fold(f64::INFINITY, f64::min);
    let farthest_m = far_m.iter().copied().fold(0.0, f64::max);
    Some(match () {
        () if farthest_m < AT_M => format!("on {shape}"),
        () if farthest_m - nearest_m < AT_M => format!("{} m before {shape}", short(nearest_m)),
        () => format!("before {shape}"),
    })
}

/// Above the origin of the scene, of a level grid.
pub(crate) fn height_m(scene: &Scene, result: &GridResult) -> Option<f64> {
    let height = |point: &Point| match scene.up() {
        UpAxis::Y => point.y,
        UpAxis::Z => point.z,
    };
    let is_level =
        result.read.normal.to_vector().dot(scene.up().direction().to_vector()).abs() > 1.0 - 1e-9;
    result.read.points.first().map(height).filter(|_| is_level)
}
