//! Calculation grids of a report.

use crate::budget;
use crate::failure::Failure;
use crate::flags::InputFlags;
use crate::grid::Asked;
use crate::grid::picture::{height_m, point};
use crate::grid::requirement::{Judged, of_grid, rating};
use crate::grid::result::GridResult;
use crate::shown::name;
use isolux::engine::MapReader;
use isolux::map::{Figure, GridFigures, Illuminance};
use isolux::scene::{CalculationGrid, Scene};
use isolux_report::{Area, Image, Requirement};
use isolux_view::{Plan, PlanPoint, PlanWords};

pub(super) fn of(
    (scene, reader): (&Scene, &MapReader),
    grids: &[CalculationGrid],
    (inputs, words): (&InputFlags, &PlanWords),
) -> Result<Vec<Area>, Failure> {
    let area = |result: &GridResult| {
        let rating = rating(&result.read.grid, (scene, reader))?;
        let known = result.read.figures.filter(|_| !inputs.is_empty());
        let budget = |figures: GridFigures| {
            budget::of(scene, &result.read.grid, inputs, Some(figures.mean_lx))
        };
        let area = area(scene, (result, rating), words)?;
        Ok(Area { budget: known.map(budget).transpose()?, ..area })
    };
    read((scene, reader), grids).iter().map(area).collect()
}

/// The grids on a map.
pub(super) fn read(
    (scene, reader): (&Scene, &MapReader),
    grids: &[CalculationGrid],
) -> Vec<GridResult> {
    let asked = Asked::illuminance(scene);
    let read = |grid: &CalculationGrid| GridResult::of(grid.clone(), (scene, reader), &asked);
    grids.iter().map(read).collect()
}

fn area(
    scene: &Scene,
    (result, rating): (&GridResult, Option<Figure>),
    words: &PlanWords,
) -> Result<Area, Failure> {
    let read = &result.read;
    let grid = &read.grid;
    let maintained: Vec<Option<Illuminance>> = read.maintained().collect();
    let mut errors_lx: Vec<f64> =
        maintained.iter().flatten().map(|value| value.standard_error_lx).collect();
    errors_lx.sort_by(f64::total_cmp);
    let judged = read.figures.iter().flat_map(|figures| of_grid(grid, (figures, rating)));
    Ok(Area {
        name: name(&grid.name),
        plan: match &read.figures {
            None => None,
            Some(_) => {
                let points: Vec<PlanPoint> =
                    maintained.iter().map(|value| point(*value, words)).collect();
                Some(plan((scene, grid), &points, words)?)
            }
        },
        counts: grid.counts(),
        sides_m: grid.sides_m(),
        border_m: grid.border_m,
        height_m: height_m(scene, result),
        maintenance_factor: grid.maintenance_factor,
        figures: read.figures,
        values_lx: maintained.iter().map(|value| value.map(|v| v.illuminance_lx())).collect(),
        error_lx: errors_lx.get(errors_lx.len() / 2).copied().unwrap_or(0.0),
        outside: result.outside.count(),
        requirements: judged.map(required).collect(),
        budget: None,
    })
}

fn required(judged: Judged) -> Requirement {
    let Judged { task, of, figure, verdict, probability, .. } = judged;
    Requirement { condition: of, source: task, figure, verdict, probability }
}

/// The plan of a grid without a heading, which the report has around it.
pub(super) fn plan(
    (scene, grid): (&Scene, &CalculationGrid),
    points: &[PlanPoint],
    words: &PlanWords,
) -> Result<Image, Failure> {
    let plan = Plan { scene, grid, points, title: "", lines: &[], longest: Plan::PAGE, words };
    Ok(Image::Svg(plan.drawing().map_err(Failure::bad_input)?.svg()))
}
