//! What is told of grids.

use super::asked::Asked;
use super::figures;
use super::modelling::Modelling;
use super::requirement::Judged;
use super::result::GridResult;
use super::rows::{Value, value};
use crate::console::{print, print_json};
use crate::failure::Failure;
use crate::installed::Installed;
use crate::maintained::Maintained;
use crate::shown::name;
use isolux::map::{Figure, GridFigures};
use isolux::scene::Scene;
use serde::Serialize;

/// What was found on all grids.
#[derive(Clone, Copy)]
pub(super) struct Found<'a> {
    pub(super) results: &'a [GridResult],
    pub(super) judged: &'a [Judged],
    pub(super) light: Maintained,
    pub(super) asked: &'a Asked,
}

/// The mean of a grid that faces up, if illuminance is read on it.
fn level_mean_lx(result: &GridResult, asked: &Asked) -> Option<Figure> {
    let faces_up = asked.is_planar() && asked.is_up(result.read.normal);
    result.read.figures.filter(|_| faces_up).map(|figures| figures.mean_lx)
}

/// Names of grids that face up, with their means.
fn lit_by_power(results: &[GridResult], asked: &Asked) -> Vec<(String, Figure)> {
    let of =
        |result: &GridResult| Some((name(&result.read.grid.name), level_mean_lx(result, asked)?));
    results.iter().filter_map(of).collect()
}

impl Found<'_> {
    /// Prints it.
    pub(super) fn tell(&self, scene: &Scene, json: bool) -> Result<(), Failure> {
        let Self { results, judged, light, asked } = *self;
        let installed = Installed::of(scene);
        if json {
            let report = |result| Report::of(result, light, asked, &installed);
            let grids = results.iter().map(report).collect();
            return print_json(&Reports { grids, requirements: judged, installed });
        }
        print(&figures::text(results, light, asked))?;
        if let Some(power) = installed.with_grids(&lit_by_power(results, asked)) {
            print(&format!("power: {power}\n"))?;
        }
        judged.iter().try_for_each(|judged| print(&format!("{}\n", judged.line())))
    }
}

/// What `grid --json` prints.
#[derive(Serialize)]
struct Reports<'a> {
    grids: Vec<Report>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    requirements: &'a [Judged],
    #[serde(flatten)]
    installed: Installed,
}

#[derive(Serialize)]
struct Report {
    name: String,
    quantity: &'static str,
    /// In plan, of semi-cylindrical illuminance.
    #[serde(skip_serializing_if = "Option::is_none")]
    facing_deg: Option<f64>,
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
    /// Of a level grid.
    power_density_w_m2_per_100_lx: Option<Figure>,
    mean_lx: Option<Figure>,
    least_lx: Option<Figure>,
    greatest_lx: Option<Figure>,
    uniformity: Option<Figure>,
    diversity: Option<Figure>,
    direct_lx: Option<f64>,
    indirect_lx: Option<f64>,
    /// At every point, along `u` first; null where not known.
    values: Vec<Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    modelling: Option<Modelling>,
}

impl Report {
    fn of(result: &GridResult, light: Maintained, asked: &Asked, installed: &Installed) -> Self {
        let interval = |read: fn(&GridFigures) -> Figure| result.read.figures.as_ref().map(read);
        let (counts, sides_m) = (result.read.grid.counts(), result.read.grid.sides_m());
        Self {
            name: result.read.grid.name.clone(),
            quantity: asked.word(),
            facing_deg: asked.facing_deg,
            maintenance_factor: result.read.grid.maintenance_factor,
            maintained: light.on_grid(result.read.grid.maintenance_factor),
            counts,
            spacing_m: [0, 1].map(|k| sides_m[k] / f64::from(counts[k])),
            border_m: result.read.grid.border_m,
            points: result.read.points.len(),
            known: result.read.figures.map_or(0, |f| f.known),
            power_density_w_m2_per_100_lx: level_mean_lx(result, asked)
                .and_then(|mean_lx| installed.per_100_lx(mean_lx)),
            mean_lx: interval(|f| f.mean_lx),
            least_lx: interval(|f| f.least_lx),
            greatest_lx: interval(|f| f.greatest_lx),
            uniformity: interval(|f| f.uniformity),
            diversity: interval(|f| f.diversity),
            direct_lx: result.read.figures.map(|f| f.direct_lx),
            indirect_lx: result.read.figures.map(|f| f.indirect_lx),
            values: result.read.points.iter().zip(result.read.maintained()).map(value).collect(),
            modelling: result.modelling.clone(),
        }
    }
}
