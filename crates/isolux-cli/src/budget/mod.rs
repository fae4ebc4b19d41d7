//! `isolux budget`: what a mean illuminance may be off by, in the manner of the GUM (JCGM 100:2008): the calculation, fluxes, maintenance
//! and reflectances, each as a line.

mod traced;

use crate::console::{print, print_json, table};
use crate::failure::{Failure, Outcome};
use crate::flags::{BudgetFlags, InputFlags};
use crate::grid::choice;
use crate::quantity::{show_share, significant};
use crate::shown::name;
use crate::{map_file, source};
use isolux::map::Figure;
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::to_error;
use isolux_report::{Budget, BudgetLine, UncertainInput};
use traced::Traced;

/// Lines of materials; the others are one line together.
const MOST_MATERIALS: usize = 6;

/// Runs the subcommand.
pub(crate) fn run(flags: &BudgetFlags, json: bool) -> Result<Outcome, Failure> {
    if flags.inputs.is_empty() {
        let how = "give what inputs may be off by: --flux 5%, --reflectance 10%, --maintenance 10%";
        return Err(Failure::bad_input(format!("budget: no input is uncertain; {how}")));
    }
    let scene = match map_file::is_map(&flags.source) {
        true => map_file::read(&flags.source)?.0,
        false => source::read_scene(&flags.source)?,
    };
    if !scene.gives_light() {
        return Err(source::no_light(&flags.source, &scene));
    }
    let grids = choice::chosen(&flags.grid, &flags.source, &scene)?;
    let budgets: Vec<Budget> =
        grids.iter().map(|grid| of(&scene, grid, &flags.inputs, None)).collect::<Result<_, _>>()?;
    if json {
        print_json(&serde_json::json!({ "confidence": 0.95, "grids": budgets }))?;
    } else {
        let texts: Vec<String> = budgets.iter().map(text).collect();
        print(&texts.join("\n"))?;
    }
    Ok(Outcome::Done)
}

/// The budget of a grid; `known_lx` is its mean where a map tells it, else it is that of the paths.
pub(crate) fn of(
    scene: &Scene,
    grid: &CalculationGrid,
    inputs: &InputFlags,
    known_lx: Option<Figure>,
) -> Result<Budget, Failure> {
    let traced = Traced::of(scene, grid)?;
    let mean_lx = known_lx.unwrap_or(traced.mean_lx);
    let mut lines = vec![(UncertainInput::Calculation, None, mean_lx.half_width())];
    if let Some(share) = inputs.flux {
        let of_group = |(group, lx): &(Option<String>, f64)| {
            (UncertainInput::Flux(group.as_deref().map(name)), Some(share), share * lx)
        };
        lines.extend(traced.by_group_lx.iter().map(of_group));
    }
    if let Some(share) = inputs.maintenance {
        lines.push((UncertainInput::Maintenance, Some(share), share * mean_lx.value));
    }
    if let Some(share) = inputs.reflectance {
        lines.extend(reflectances(&traced, share));
    }
    let variance: f64 = lines.iter().map(|(.., half_lx)| half_lx * half_lx).sum();
    let line = |(source, input, half_lx): (UncertainInput, Option<f64>, f64)| BudgetLine {
        source,
        input,
        half_lx,
        share: if variance > 0.0 { half_lx * half_lx / variance } else { 0.0 },
    };
    let half_lx = variance.sqrt();
    Ok(Budget {
        grid: name(&grid.name),
        mean_lx,
        with_inputs_lx: Figure {
            value: mean_lx.value,
            low: (mean_lx.value - half_lx).max(0.0),
            high: mean_lx.value + half_lx,
        },
        lines: lines.into_iter().map(line).collect(),
    })
}

/// A line for each material that matters most, and one for the rest.
fn reflectances(traced: &Traced, share: f64) -> Vec<(UncertainInput, Option<f64>, f64)> {
    let mut all: Vec<(&String, f64)> =
        traced.by_material_lx.iter().map(|(material, lx)| (material, share * lx)).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let rest = all.split_off(all.len().min(MOST_MATERIALS));
    let of = |(material, half_lx): (&String, f64)| {
        (UncertainInput::Reflectance(name(material)), Some(share), half_lx)
    };
    let mut lines: Vec<_> = all.into_iter().map(of).collect();
    if !rest.is_empty() {
        let squares: f64 = rest.iter().map(|(_, half_lx)| half_lx * half_lx).sum();
        lines.push((UncertainInput::OtherReflectances, Some(share), squares.sqrt()));
    }
    lines
}

fn source(of: &UncertainInput) -> String {
    match of {
        UncertainInput::Calculation => "calculation".to_owned(),
        UncertainInput::Flux(None) => "luminous flux".to_owned(),
        UncertainInput::Flux(Some(group)) => format!("luminous flux of {}", group),
        UncertainInput::Maintenance => "maintenance factor".to_owned(),
        UncertainInput::Reflectance(material) => format!("reflectance of {}", material),
        UncertainInput::OtherReflectances => "reflectances of all others".to_owned(),
    }
}

/// For people.
fn text(budget: &Budget) -> String {
    let row = |line: &BudgetLine| {
        vec![
            source(&line.source),
            line.input.map_or("-".to_owned(), show_share),
            significant(line.half_lx, 2),
            format!("{:.0} %", 100.0 * line.share),
        ]
    };
    let rows: Vec<Vec<String>> = budget.lines.iter().map(row).collect();
    let lines = table(&["source", "input, ±", "Em, ± lx", "of the variance"], &rows);
    let written = |of: Figure| {
        let half = of.half_width().max(0.5);
        let [value, low, high] = [of.value, of.low, of.high].map(|lx| to_error(lx, half));
        format!("{value} lx ({low} to {high})")
    };
    format!(
        "{}: Em {} by the calculation, {} with all inputs, at 95 %\n{lines}",
        budget.grid,
        written(budget.mean_lx),
        written(budget.with_inputs_lx)
    )
}
