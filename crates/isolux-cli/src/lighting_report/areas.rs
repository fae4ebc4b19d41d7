//! Calculation grids of a report.

use crate::budget;
use crate::failure::Failure;
use crate::flags::InputFlags;
use crate::grid::Asked;
use crate::grid::picture::height_m;
use crate::grid::requirement::{Judged, of_grid, rating};
use crate::grid::result::GridResult;
use crate::interval::Interval;
use crate::shown::name;
use isolux::engine::MapReader;
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::{CalculationGrid, GridQuantity, Scene};
use isolux::units::to_error;
use isolux_report::{
    Area, Budget, BudgetLine, Condition, Image, Language, Quantity, Requirement, UncertainInput,
};
use isolux_view::{Plan, PlanPoint, PlanWords};

pub(super) fn of(
    (scene, map): (&Scene, &IlluminationMap),
    grids: &[CalculationGrid],
    (inputs, language): (&InputFlags, Language),
) -> Result<Vec<Area>, Failure> {
    let area = |result: &GridResult| {
        let rating = rating(&result.read.grid, (scene, map))?;
        let area = area(scene, (result, rating), language)?;
        Ok(Area { budget: budgeted(scene, result, inputs)?, ..area })
    };
    read((scene, map), grids).iter().map(area).collect()
}

/// The grids on a map.
pub(super) fn read(
    (scene, map): (&Scene, &IlluminationMap),
    grids: &[CalculationGrid],
) -> Vec<GridResult> {
    let reader = MapReader::new(scene, map);
    let asked = Asked::illuminance(scene);
    let read = |grid: &CalculationGrid| GridResult::of(grid.clone(), (scene, &reader), &asked);
    grids.iter().map(read).collect()
}

fn area(
    scene: &Scene,
    (result, rating): (&GridResult, Option<Interval>),
    language: Language,
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
                    maintained.iter().map(|value| point(*value, language)).collect();
                Some(plan((scene, grid), &points, &words(language))?)
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
        requirements: judged.map(|judged| required(&judged)).collect(),
        budget: None,
    })
}

/// `None` where no input is uncertain, or nothing is known.
fn budgeted(
    scene: &Scene,
    result: &GridResult,
    inputs: &InputFlags,
) -> Result<Option<Budget>, Failure> {
    let known = result.read.figures.filter(|_| !inputs.is_empty());
    let Some(figures) = known else { return Ok(None) };
    let found = budget::of(scene, &result.read.grid, inputs, Some(figures.mean_lx))?;
    let line = |line: &budget::Line| BudgetLine {
        source: match &line.source {
            budget::Source::Calculation => UncertainInput::Calculation,
            budget::Source::Flux(group) => UncertainInput::Flux(group.as_deref().map(name)),
            budget::Source::Maintenance => UncertainInput::Maintenance,
            budget::Source::Reflectance(material) => UncertainInput::Reflectance(name(material)),
            budget::Source::OtherReflectances => UncertainInput::OtherReflectances,
        },
        input: line.input,
        half_lx: line.half_lx,
        share: line.share,
    };
    Ok(Some(Budget {
        with_inputs_lx: found.with_inputs_lx,
        lines: found.lines.iter().map(line).collect(),
    }))
}

fn required(judged: &Judged) -> Requirement {
    Requirement {
        condition: Condition {
            quantity: match judged.of.of {
                GridQuantity::Mean => Quantity::Mean,
                GridQuantity::Least => Quantity::Least,
                GridQuantity::Greatest => Quantity::Greatest,
                GridQuantity::Uniformity => Quantity::Uniformity,
                GridQuantity::Diversity => Quantity::Diversity,
                GridQuantity::GlareRating => Quantity::GlareRating,
            },
            is_least: judged.of.is_least,
            bound: judged.of.bound,
        },
        source: judged.task.clone(),
        figure: judged.figure,
        verdict: judged.verdict,
        probability: judged.probability,
    }
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

/// The words of plans of illuminance.
pub(super) fn words(language: Language) -> PlanWords {
    let of = language.plan();
    PlanWords {
        values: of.illuminance,
        cut_at_height: of.cut_at_height,
        cut_by_plane: of.cut_by_plane,
        below: of.below,
        behind: of.behind,
        luminaire: of.luminaire,
        grid: of.grid,
        point: of.point,
        decimal_point: language.decimal_point(),
    }
}

fn point(value: Option<Illuminance>, language: Language) -> PlanPoint {
    let lx = value.map(|value| value.illuminance_lx());
    let error_lx = value.map_or(0.0, |value| value.standard_error_lx);
    // Whole lux are enough on a plan, unless there are few.
    let label = |lx: f64| to_error(lx, error_lx.max(if lx < 10.0 { 0.1 } else { 2.0 }));
    PlanPoint {
        illuminance_lx: lx,
        standard_error_lx: error_lx,
        label: lx.map_or(String::new(), |lx| local(&label(lx), language)),
    }
}

/// A number with the point of the language.
pub(super) fn local(number: &str, language: Language) -> String {
    number.replace('.', language.decimal_point().encode_utf8(&mut [0; 4]))
}
