//! The map of a scene that decides what is required of its grids.

use super::requirement::{are_there, of_grid};
use crate::failure::{Failure, Outcome};
use crate::grid_values::GridValues;
use crate::interval::Verdict;
use crate::solving;
use isolux::engine::{MapReader, SolveRequest};
use isolux::map::IlluminationMap;
use isolux::scene::{CalculationGrid, Scene};
use std::path::Path;

/// Accuracies with which requirements are tried to be decided, one after the other: each costs some four times the one before. What
/// is undecided at the last is too near its bound.
const ACCURACIES: [f64; 5] = [0.04, 0.02, 0.01, 0.005, 0.0025];

/// The map of a scene: as accurate as asked or, with requirements and no accuracy, as accurate as they need to be decided.
pub(crate) fn decided(
    (scene, source): (&Scene, &Path),
    accuracy: Option<f64>,
    grids: &[CalculationGrid],
) -> Result<(IlluminationMap, Outcome), Failure> {
    let default = SolveRequest::default();
    let solved = |accuracy: Option<f64>| {
        let request = SolveRequest { accuracy, ..SolveRequest::default() };
        solving::solve_here((scene, source), &request)
            .map(|solved| (solved.solution.map, solved.outcome))
    };
    if !are_there(grids) || accuracy.is_some() {
        return solved(accuracy.or(default.accuracy));
    }
    let [first, finer @ ..] = ACCURACIES;
    let mut found = solved(Some(first))?;
    for accuracy in finer {
        if is_decided(scene, &found.0, grids) || found.1 != Outcome::Done {
            break;
        }
        found = solved(Some(accuracy))?;
    }
    Ok(found)
}

/// Whether no requirement is undecided. A grid of which nothing is known will not be decided by more light.
fn is_decided(scene: &Scene, map: &IlluminationMap, grids: &[CalculationGrid]) -> bool {
    let reader = MapReader::new(scene, map);
    grids.iter().all(|grid| {
        let read = GridValues::of(grid.clone(), (scene, &reader));
        read.and_then(|read| read.figures).is_none_or(|figures| {
            of_grid(grid, &figures).all(|judged| judged.verdict != Verdict::Undecided)
        })
    })
}
