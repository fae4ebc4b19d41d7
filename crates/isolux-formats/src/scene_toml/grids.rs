//! Calculation grids.

use super::context::Context;
use super::quantity::{Triple, plain};
use super::record::{EmergencyRecord, GridRecord};
use super::spans::At;
use isolux::geometry::{Point, Vector};
use isolux::scene::{CalculationGrid, EmergencyArea, SceneParts};

/// What area of emergency lighting a grid is, if it is one.
fn emergency(entry: &At<GridRecord>, context: &mut Context) -> Option<EmergencyArea> {
    let record = entry.get_ref();
    let task_lx = record.task_lx.map(|lx| lx.0);
    let wrong = match (record.emergency, task_lx) {
        (None, None) => return None,
        (Some(EmergencyRecord::EscapeRoute), None) => return Some(EmergencyArea::EscapeRoute),
        (Some(EmergencyRecord::OpenArea), None) => return Some(EmergencyArea::OpenArea),
        (Some(EmergencyRecord::HighRisk), Some(task_lx)) => {
            return Some(EmergencyArea::HighRisk { task_lx });
        }
        (Some(EmergencyRecord::HighRisk), None) => (
            "an area of high risk without the illuminance that its task requires",
            "add task_lx = 500",
        ),
        (_, Some(_)) => (
            "`task_lx` of a grid that is no area of high risk",
            "leave it out, or add emergency = \"high-risk\"",
        ),
    };
    context.problem(&entry.span(), wrong.0.to_owned(), wrong.1);
    None
}

/// Adds all grids of the file to the scene.
pub(super) fn add(entries: &[At<GridRecord>], scene: &mut SceneParts, context: &mut Context) {
    for (number, entry) in (1..).zip(entries) {
        let record = entry.get_ref();
        let unit_m = context.unit_m;
        let metres = |triple: Triple| plain(triple).map(|c| c * unit_m);
        let grid = CalculationGrid {
            name: record.name.clone().unwrap_or_else(|| format!("grid {number}")),
            corner: Point::from(metres(record.corner)),
            u: Vector::from(metres(record.u)),
            v: Vector::from(metres(record.v)),
            spacing_m: record.spacing.map(|spacing| spacing.0 * unit_m),
            border_m: record.border.map_or(0.0, |border| border.0 * unit_m),
            maintenance_factor: record.maintenance_factor.map_or(1.0, |factor| factor.0),
            requirements: Vec::new(),
            emergency: emergency(entry, context),
        };
        if scene.maintenance.is_some() && grid.maintenance_factor != 1.0 {
            let what = format!(
                "grid `{}` has a maintenance factor, and the luminaires of the scene have one in their light already",
                grid.name
            );
            context.problem(&entry.span(), what, "a factor counts once: remove one of them");
        }
        match grid.problem() {
            Some((what, remedy)) => {
                context.problem(&entry.span(), format!("grid `{}` {what}", grid.name), remedy);
            }
            None => scene.grids.push(grid),
        }
    }
}
