//! Emergency lighting by EN 1838:2013: the luminaires marked for it, by their direct light alone, as reflections do not count.

mod points;

use super::{choice, requirement};
use crate::console::{print, print_json, table};
use crate::failure::{Failure, Outcome};
use crate::flags::{EmergencyName, GridFlags};
use crate::maintained::Maintained;
use crate::probe;
use crate::shown::name;
use isolux::engine::{ExactSettings, ProbePoint};
use isolux::map::{Figure, GridFigures, Verdict};
use isolux::scene::{CalculationGrid, EmergencyArea, Scene};
use isolux::units::to_error;
use isolux_report::{EmergencyCriterion, EmergencyRequirement};
use points::{OUTER_M, Strip};
use serde::Serialize;
use std::path::Path;

/// On the centre line of an escape route (4.2.1), and of that in its middle half.
const CENTRE_LX: f64 = 1.0;
const MIDDLE_LX: f64 = 0.5 * CENTRE_LX;
/// The greatest over the least illuminance at most (4.2.2, 4.3.2).
const MOST_DIVERSITY: f64 = 40.0;
/// On the floor of an open area (4.3.1).
const OPEN_LX: f64 = 0.5;
/// Of a high-risk task area: of the illuminance that the task requires, at least, and the uniformity (4.4.1, 4.4.2).
const OF_TASK: f64 = 0.1;
const TASK_LX: f64 = 15.0;
const TASK_UNIFORMITY: f64 = 0.1;

/// Nothing is reflected, so paths end where they begin.
const DIRECT: ExactSettings = ExactSettings { rays: 1, replicates: 16, seed: 1 };

/// A condition on a grid, and what came of it.
#[derive(Clone, Debug, Serialize)]
struct Judged<'a> {
    grid: &'a str,
    condition: String,
    #[serde(flatten)]
    figure: Figure,
    verdict: Verdict,
}

/// What is told.
#[derive(Serialize)]
struct Report<'a> {
    standard: &'static str,
    kind: EmergencyName,
    emergency_luminaires: usize,
    #[serde(flatten)]
    maintained: Maintained,
    requirements: &'a [Judged<'a>],
}

/// Runs the subcommand for one kind of area, or for areas as they are marked.
pub(super) fn run(
    (kind, flags): (EmergencyName, &GridFlags),
    scene: &Scene,
    json: bool,
) -> Result<Outcome, Failure> {
    let lit = lit(scene, &flags.source)?;
    if flags.task.is_some() != (kind == EmergencyName::HighRisk) {
        return Err(Failure::bad_input(match flags.task {
            Some(_) => "--task: only --emergency high-risk asks for it; leave it out",
            None => {
                "--emergency high-risk: needs the illuminance that the task requires; add --task LX"
            }
        }));
    }
    let source = (flags.source.as_path(), scene);
    let mut grids = choice::chosen_of(&flags.grid, source, |_| true)?;
    requirement::maintain(&mut grids, &flags.required, source)?;
    let mut found = Vec::new();
    for mut grid in grids {
        grid.emergency = match kind {
            EmergencyName::AsMarked => grid.emergency,
            EmergencyName::EscapeRoute => Some(EmergencyArea::EscapeRoute),
            EmergencyName::OpenArea => Some(EmergencyArea::OpenArea),
            EmergencyName::HighRisk => {
                Some(EmergencyArea::HighRisk { task_lx: flags.task.unwrap_or_default() })
            }
        };
        found.extend(judged(&grid, (&lit, &flags.source))?);
    }
    if found.is_empty() {
        return Err(Failure::bad_input(format!(
            "--emergency as-marked: no grid of {} is marked; give some `emergency = \"escape-route\"`, or name the kind here",
            flags.source.display()
        )));
    }
    let told: Vec<Judged<'_>> = found.iter().map(Judged::of).collect();
    if json {
        print_json(&Report {
            standard: "EN 1838:2013",
            kind,
            emergency_luminaires: lit.luminaires().len(),
            maintained: Maintained::of(&lit),
            requirements: &told,
        })?;
    } else {
        print(&text(&told))?;
    }
    let all_met = found.iter().all(|of| of.verdict == Verdict::Met);
    Ok(if all_met { Outcome::Done } else { Outcome::CheckFailed })
}

/// The scene in an emergency.
pub(crate) fn lit(scene: &Scene, source: &Path) -> Result<Scene, Failure> {
    scene.in_emergency().ok_or_else(|| {
        Failure::bad_input(format!(
            "emergency lighting: no luminaire of {} is marked for it; give some `emergency = true` or `emergency_flux_share = 0.1` \
             in the scene; a group that is dimmed to nothing has none",
            source.display()
        ))
    })
}

/// What has to hold on a grid, if it is an area of emergency lighting.
pub(crate) fn judged(
    grid: &CalculationGrid,
    (lit, source): (&Scene, &Path),
) -> Result<Vec<EmergencyRequirement>, Failure> {
    let read = |points: &[ProbePoint]| figures((lit, source), grid, points);
    let of = |criterion, bound, figure: Figure, verdict| EmergencyRequirement {
        area: grid.name.clone(),
        criterion,
        bound,
        figure,
        verdict,
    };
    let least =
        |criterion, figure: Figure, bound| of(criterion, bound, figure, figure.reaches(bound));
    let spread = |criterion, found: &GridFigures| {
        let figure = inverse(found.diversity);
        of(criterion, MOST_DIVERSITY, figure, figure.keeps_within(MOST_DIVERSITY))
    };
    let Some(area) = grid.emergency else { return Ok(Vec::new()) };
    Ok(match area {
        EmergencyArea::EscapeRoute => {
            let strip = Strip::of(grid).map_err(Failure::bad_input)?;
            let [centre, middle] = [read(&strip.centre)?, read(&strip.middle)?];
            vec![
                least(EmergencyCriterion::CentreLine, centre.least_lx, CENTRE_LX),
                least(EmergencyCriterion::MiddleHalf, middle.least_lx, MIDDLE_LX),
                spread(EmergencyCriterion::CentreLineSpread, &centre),
            ]
        }
        EmergencyArea::OpenArea => {
            let found = read(&points::open_area(grid).map_err(Failure::bad_input)?)?;
            vec![
                least(EmergencyCriterion::OpenArea, found.least_lx, OPEN_LX),
                spread(EmergencyCriterion::OpenAreaSpread, &found),
            ]
        }
        EmergencyArea::HighRisk { task_lx } => {
            let found = read(&points::all(grid))?;
            let bound_lx = (OF_TASK * task_lx).max(TASK_LX);
            vec![
                least(EmergencyCriterion::HighRiskMean, found.mean_lx, bound_lx),
                least(EmergencyCriterion::HighRiskUniformity, found.uniformity, TASK_UNIFORMITY),
            ]
        }
    })
}

impl<'a> Judged<'a> {
    fn of(of: &'a EmergencyRequirement) -> Self {
        let EmergencyRequirement { area, criterion, bound, figure, verdict } = of;
        let condition = match criterion {
            EmergencyCriterion::CentreLine => format!("Emin >= {bound} lx on the centre line"),
            EmergencyCriterion::MiddleHalf => format!("Emin >= {bound} lx in the middle half"),
            EmergencyCriterion::CentreLineSpread => {
                format!("Emax/Emin <= {bound} on the centre line")
            }
            EmergencyCriterion::OpenArea => {
                format!("Emin >= {bound} lx without the outer {OUTER_M} m")
            }
            EmergencyCriterion::OpenAreaSpread => {
                format!("Emax/Emin <= {bound} without the outer {OUTER_M} m")
            }
            EmergencyCriterion::HighRiskMean => format!("Em >= {bound} lx"),
            EmergencyCriterion::HighRiskUniformity => format!("U0 >= {bound}"),
        };
        Self { grid: area, condition, figure: *figure, verdict: *verdict }
    }
}

/// The figures of points; points inside of things are left out.
fn figures(
    (lit, source): (&Scene, &Path),
    grid: &CalculationGrid,
    points: &[ProbePoint],
) -> Result<GridFigures, Failure> {
    let values = probe::traced((lit, source), points, &DIRECT)?;
    GridFigures::of(grid, &values).ok_or_else(|| {
        let what = format!("grid `{}` lies outside of the room", name(&grid.name));
        Failure::bad_input(format!("{what}; put it on the floor"))
    })
}

/// The greatest over the least, of the least over the greatest.
fn inverse(Figure { value, low, high }: Figure) -> Figure {
    Figure { value: 1.0 / value, low: 1.0 / high, high: 1.0 / low }
}

fn text(judged: &[Judged]) -> String {
    let row = |of: &Judged| {
        let Figure { value, low, high } = of.figure;
        let written = |number: f64| match number.is_finite() {
            true => to_error(number, 0.5 * (high - low)),
            false => "dark".to_owned(),
        };
        let found = match low == high {
            true => written(value),
            false => format!("{} ({} to {})", written(value), written(low), written(high)),
        };
        vec![name(of.grid), of.condition.clone(), found, of.verdict.text().to_owned()]
    };
    let rows: Vec<Vec<String>> = judged.iter().map(row).collect();
    let verdicts = table(&["grid", "EN 1838:2013", "found", "verdict"], &rows);
    format!("{verdicts}Direct light of emergency luminaires alone; nothing is reflected.\n")
}
