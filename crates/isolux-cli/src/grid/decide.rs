//! The map of a scene that decides what is required of its grids.

use super::requirement::{Judged, are_there};
use crate::failure::{Failure, Outcome};
use crate::solving;
use isolux::engine::SolveRequest;
use isolux::map::{IlluminationMap, Verdict};
use isolux::scene::{CalculationGrid, Scene};
use std::path::Path;

/// Accuracies with which requirements are tried to be decided, one after the other: each costs some four times the one before. What
/// is undecided at the last is too near its bound.
const ACCURACIES: [f64; 5] = [0.04, 0.02, 0.01, 0.005, 0.0025];

/// What is required, judged on a map.
type Judge<'a> = &'a dyn Fn(&IlluminationMap) -> Result<Vec<Judged>, Failure>;

/// The map of a scene: as accurate as asked or, with requirements and no accuracy, as accurate as they need to be decided.
pub(crate) fn decided(
    (scene, source): (&Scene, &Path),
    accuracy: Option<f64>,
    (grids, judge): (&[CalculationGrid], Judge<'_>),
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
        let judged = judge(&found.0)?;
        let is_decided = judged.iter().all(|judged| judged.verdict != Verdict::Undecided);
        if is_decided || found.1 != Outcome::Done {
            break;
        }
        found = solved(Some(accuracy))?;
    }
    Ok(found)
}
