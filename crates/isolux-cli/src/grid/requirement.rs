//! Whether what is required of calculation grids holds.

use super::choice;
use super::result::GridResult;
use crate::failure::Failure;
use crate::flags::{GridChoice, RequiredFlags};
use crate::glare;
use crate::maintained::{self, Maintained};
use crate::notes::{Note, note};
use crate::shown::name;
use isolux::engine::MapReader;
use isolux::map::{Figure, GridFigures, Verdict};
use isolux::scene::{CalculationGrid, Condition, GridQuantity, Requirement, Scene};
use isolux_formats::requirement;
use serde::Serialize;
use std::path::Path;

/// A condition on a grid, and what came of it.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Judged {
    pub(crate) grid: String,
    /// The task of a standard, if it follows from one.
    pub(crate) task: Option<String>,
    #[serde(rename = "condition", serialize_with = "as_text")]
    pub(crate) of: Condition,
    #[serde(flatten)]
    pub(crate) figure: Figure,
    pub(crate) verdict: Verdict,
    /// How likely it holds, if errors are normal.
    pub(crate) probability: f64,
}

fn as_text<S: serde::Serializer>(of: &Condition, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&of.text())
}

/// The grids asked for, with the maintenance factor and the requirements asked for. What a scene requires is of illuminance, and left
/// out where something else is read.
pub(crate) fn grids(
    (choice, is_illuminance): (&GridChoice, bool),
    required: &RequiredFlags,
    (source, scene): (&Path, &Scene),
) -> Result<Vec<CalculationGrid>, Failure> {
    let mut grids = choice::chosen(choice, source, scene)?;
    maintain(&mut grids, required, (source, scene))?;
    if !is_illuminance {
        grids.iter_mut().for_each(|grid| grid.requirements.clear());
    }
    add(&required.require, &mut grids)?;
    Ok(grids)
}

/// Gives grids the maintenance factor that is asked for.
pub(crate) fn maintain(
    grids: &mut [CalculationGrid],
    required: &RequiredFlags,
    (source, scene): (&Path, &Scene),
) -> Result<(), Failure> {
    let Some(factor) = required.maintenance_factor else { return Ok(()) };
    maintained::refuse_second(factor, scene, source)?;
    grids.iter_mut().for_each(|grid| grid.maintenance_factor = factor);
    Ok(())
}

/// Adds the requirements of `--require` to the grids that they are for: `desks: Em >= 500`, or without a name to all.
fn add(flags: &[String], grids: &mut [CalculationGrid]) -> Result<(), Failure> {
    for text in flags {
        let (named, rest) = match text.split_once(':') {
            Some((named, rest)) => (Some(named.trim()), rest),
            None => (None, text.as_str()),
        };
        let read = requirement(rest);
        let read = read.map_err(|what| Failure::bad_input(format!("--require: {what}")))?;
        let mut is_for_none = true;
        let is_for = |grid: &&mut CalculationGrid| named.is_none_or(|named| grid.name == named);
        for grid in grids.iter_mut().filter(is_for) {
            is_for_none = false;
            grid.requirements.push(read.clone());
        }
        if is_for_none {
            let what = format!("--require: there is no grid `{}`", name(named.unwrap_or_default()));
            return Err(Failure::bad_input(format!("{what}; name one that is read")));
        }
    }
    Ok(())
}

/// Whether anything is required.
pub(crate) fn are_there(grids: &[CalculationGrid]) -> bool {
    grids.iter().any(|grid| !grid.requirements.is_empty())
}

/// All conditions on all grids.
pub(crate) fn judge(
    results: &[GridResult],
    lit: (&Scene, &MapReader<'_>),
) -> Result<Vec<Judged>, Failure> {
    let mut judged = Vec::new();
    for GridResult { read, .. } in results {
        if read.grid.requirements.is_empty() {
            continue;
        }
        let Some(figures) = &read.figures else {
            let grid = name(&read.grid.name);
            let what = format!("nothing is known on grid `{grid}`, of which something is required");
            return Err(Failure::bad_input(format!("{what}; put it where light is")));
        };
        judged.extend(of_grid(&read.grid, (figures, rating(&read.grid, lit)?)));
    }
    Ok(judged)
}

/// The worst glare rating on a grid, if something is required of it.
pub(crate) fn rating(
    grid: &CalculationGrid,
    lit: (&Scene, &MapReader<'_>),
) -> Result<Option<Figure>, Failure> {
    let mut conditions = grid.requirements.iter().flat_map(|of| &of.conditions);
    match conditions.any(|condition| condition.of == GridQuantity::GlareRating) {
        true => glare::worst(lit, grid).map(Some),
        false => Ok(None),
    }
}

/// All conditions on a grid, by its figures and its rating.
pub(crate) fn of_grid<'a>(
    grid: &'a CalculationGrid,
    (figures, rating): (&'a GridFigures, Option<Figure>),
) -> impl Iterator<Item = Judged> + 'a {
    let of = move |requirement: &'a Requirement| {
        requirement.conditions.iter().filter_map(move |&of| {
            let figure = figure(of.of, figures).or(rating)?;
            let above = figure.probability_above(of.bound);
            Some(Judged {
                grid: grid.name.clone(),
                task: requirement.task.clone(),
                of,
                figure,
                verdict: match of.is_least {
                    true => figure.reaches(of.bound),
                    false => figure.keeps_within(of.bound),
                },
                probability: if of.is_least { above } else { 1.0 - above },
            })
        })
    };
    grid.requirements.iter().flat_map(of)
}

/// `None` of a rating, which has figures of its own.
const fn figure(of: GridQuantity, figures: &GridFigures) -> Option<Figure> {
    Some(match of {
        GridQuantity::Mean => figures.mean_lx,
        GridQuantity::Least => figures.least_lx,
        GridQuantity::Greatest => figures.greatest_lx,
        GridQuantity::Uniformity => figures.uniformity,
        GridQuantity::Diversity => figures.diversity,
        GridQuantity::GlareRating => return None,
    })
}

/// Standards require maintained values.
pub(crate) fn warn_of_initial(grid: &CalculationGrid, light: Maintained) {
    let is_of_a_standard = grid.requirements.iter().any(|requirement| requirement.task.is_some());
    if is_of_a_standard && light.on_grid(grid.maintenance_factor).is_initial() {
        let grid = name(&grid.name);
        let what = "EN 12464-1 requires maintained values, and these are initial";
        let remedy = "give a maintenance factor, as --maintenance-factor 0.8";
        note(Note::Warning, format!("grid `{grid}`: {what}; {remedy}"));
    }
}

impl Judged {
    /// The line that people read.
    pub(super) fn line(&self) -> String {
        let task = self.task.as_ref().map_or(String::new(), |task| format!(" ({task})"));
        let likely = match self.verdict {
            Verdict::Undecided => format!(", {:.0} % likely", 100.0 * self.probability),
            _ => String::new(),
        };
        let said = self.verdict.text();
        format!("{}: {}{task}: {said}{likely}", name(&self.grid), self.of.text())
    }
}
