//! The exact values of the study's scenes, errors of maps by them, and the colours of charts.

use crate::{arrays, error, held::Map};
use isolux_compare::Readings;
use isolux_view::ColourMap;
use pyo3::prelude::*;
use std::sync::Arc;

/// Names of points, each with its weight in the mean error.
type Letters = Vec<(char, f64)>;

fn no_such_case(py: Python<'_>, case: &str) -> PyErr {
    error::of_argument(py, &format!("`{case}` has no exact values here; choose cube or sphere"))
}

/// Rows of `x y z nx ny nz lx`, those of the grid first; then letter and weight of each of the last rows, the points of the paper.
#[pyfunction]
pub(crate) fn exact<'py>(py: Python<'py>, case: &str) -> PyResult<(Bound<'py, PyAny>, Letters)> {
    let places =
        py.detach(|| isolux_compare::places(case)).ok_or_else(|| no_such_case(py, case))?;
    let right_lx: Vec<f64> = places.iter().map(|(_, lx)| *lx).collect();
    let named = Readings::of_values(case, &right_lx).ok_or_else(|| no_such_case(py, case))?;
    let row = |(at, lx): &(isolux::engine::ProbePoint, f64)| {
        let ([x, y, z], n) = (<[f64; 3]>::from(at.position), at.normal.to_vector());
        [x, y, z, n.x, n.y, n.z, *lx]
    };
    let rows = arrays::rows(py, places.iter().map(row).collect())?;
    Ok((rows, named.points.iter().map(|(point, weight)| (point.name, *weight)).collect()))
}

/// Of a map: the error at the points of the paper, that over the grid, the share of the grid within intervals of 95 %, and told over
/// true errors; none where it is not known.
#[pyfunction]
pub(crate) fn errors(
    py: Python<'_>,
    map: PyRef<'_, Map>,
    case: String,
) -> PyResult<[Option<f64>; 4]> {
    let held = Arc::clone(&map.held);
    let found = py.detach(|| Readings::of_map(&case, &held.0, &held.1));
    let found = found.ok_or_else(|| no_such_case(py, &case))?;
    let found = found.map_err(|wrong| error::of_argument(py, &wrong.to_string()))?;
    Ok([found.points_error(), found.grid_error(), found.covered(), found.told_over_true()])
}

/// The sRGB colours of a colour map from the lowest to the highest value.
#[pyfunction]
pub(crate) fn colours<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let map = match name {
        "viridis" => ColourMap::Viridis,
        "inferno" => ColourMap::Inferno,
        "turbo" => ColourMap::Turbo,
        _ => {
            let text = format!("`{name}` is no colour map; choose viridis, inferno or turbo");
            return Err(error::of_argument(py, &text));
        }
    };
    arrays::rows(py, map.table().to_vec())
}
