//! Emergency lighting by EN 1838:2013: the luminaires marked for it, by their direct light alone, as reflections do not count.

mod points;

use super::requirement;
use crate::console::{print, print_json, table};
use crate::failure::{Failure, Outcome};
use crate::flags::{EmergencyName, GridFlags};
use crate::maintained::Maintained;
use crate::probe;
use crate::shown::name;
use isolux::engine::{ExactSettings, ProbePoint};
use isolux::map::{Figure, GridFigures, Verdict};
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::to_error;
use points::{OUTER_M, Strip};
use serde::Serialize;

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
struct Judged {
    grid: String,
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
    requirements: &'a [Judged],
}

/// Runs the subcommand for one kind of area.
pub(super) fn run(
    (kind, flags): (EmergencyName, &GridFlags),
    scene: &Scene,
    json: bool,
) -> Result<Outcome, Failure> {
    let lit = scene.in_emergency().ok_or_else(|| {
        Failure::bad_input(format!(
            "--emergency: no luminaire of {} is marked for it; give some `emergency = true` or `emergency_flux_share = 0.1`, \
             and solve a map again",
            flags.source.display()
        ))
    })?;
    if flags.task.is_some() != (kind == EmergencyName::HighRisk) {
        return Err(Failure::bad_input(match flags.task {
            Some(_) => "--task: only --emergency high-risk asks for it; leave it out",
            None => {
                "--emergency high-risk: needs the illuminance that the task requires; add --task LX"
            }
        }));
    }
    let mut judged = Vec::new();
    let source = (flags.source.as_path(), scene);
    for grid in requirement::grids((&flags.grid, true), &flags.required, source)? {
        judged.extend(on_grid((kind, flags), &lit, grid)?);
    }
    if json {
        print_json(&Report {
            standard: "EN 1838:2013",
            kind,
            emergency_luminaires: lit.luminaires().len(),
            maintained: Maintained::of(&lit),
            requirements: &judged,
        })?;
    } else {
        print(&text(&judged))?;
    }
    let all_met = judged.iter().all(|judged| judged.verdict == Verdict::Met);
    Ok(if all_met { Outcome::Done } else { Outcome::CheckFailed })
}

fn on_grid(
    (kind, flags): (EmergencyName, &GridFlags),
    lit: &Scene,
    grid: CalculationGrid,
) -> Result<Vec<Judged>, Failure> {
    let read = |points: &[ProbePoint]| figures((lit, flags), &grid, points);
    let of =
        |condition: &str, figure: Figure, verdict: fn(Figure, f64) -> Verdict, bound: f64| Judged {
            grid: grid.name.clone(),
            condition: condition.to_owned(),
            figure,
            verdict: verdict(figure, bound),
        };
    let least = |condition: &str, figure, bound| of(condition, figure, Figure::reaches, bound);
    let spread = |where_is: &str, found: &GridFigures| {
        let condition = format!("Emax/Emin <= 40 {where_is}");
        of(&condition, inverse(found.diversity), Figure::keeps_within, MOST_DIVERSITY)
    };
    Ok(match kind {
        EmergencyName::EscapeRoute => {
            let strip = Strip::of(&grid, flags.grid.spacing).map_err(Failure::bad_input)?;
            let [centre, middle] = [read(&strip.centre)?, read(&strip.middle)?];
            vec![
                least("Emin >= 1 lx on the centre line", centre.least_lx, CENTRE_LX),
                least("Emin >= 0.5 lx in the middle half", middle.least_lx, MIDDLE_LX),
                spread("on the centre line", &centre),
            ]
        }
        EmergencyName::OpenArea => {
            let found = read(&points::open_area(&grid).map_err(Failure::bad_input)?)?;
            let core = format!("without the outer {OUTER_M} m");
            vec![
                least(&format!("Emin >= 0.5 lx {core}"), found.least_lx, OPEN_LX),
                spread(&core, &found),
            ]
        }
        EmergencyName::HighRisk => {
            let found = read(&points::all(&grid))?;
            let bound_lx = (OF_TASK * flags.task.unwrap_or_default()).max(TASK_LX);
            vec![
                least(&format!("Em >= {bound_lx} lx"), found.mean_lx, bound_lx),
                least("U0 >= 0.1", found.uniformity, TASK_UNIFORMITY),
            ]
        }
    })
}

/// The figures of points; points inside of things are left out.
fn figures(
    (lit, flags): (&Scene, &GridFlags),
    grid: &CalculationGrid,
    points: &[ProbePoint],
) -> Result<GridFigures, Failure> {
    let values = probe::traced((lit, &flags.source), points, &DIRECT)?;
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
        vec![name(&of.grid), of.condition.clone(), found, of.verdict.text().to_owned()]
    };
    let rows: Vec<Vec<String>> = judged.iter().map(row).collect();
    let verdicts = table(&["grid", "EN 1838:2013", "found", "verdict"], &rows);
    format!("{verdicts}Direct light of emergency luminaires alone; nothing is reflected.\n")
}
