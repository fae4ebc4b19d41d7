//! Calculation grids.

use super::context::Context;
use super::quantity::{Triple, plain};
use super::record::GridRecord;
use super::spans::At;
use isolux::geometry::{Point, Vector};
use isolux::scene::{CalculationGrid, SceneParts};

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
