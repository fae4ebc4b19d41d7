//! The errors of maps of CUBE and SPHERE, as the paper measures them.

use crate::case::{cube, sphere};
use crate::metric::{Pair, relative_l2_distance, weighted_rms_relative_difference};
use isolux::engine::{MapReader, ProbePoint};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Places along each side of the grid over a face of CUBE.
const CUBE_GRID: u32 = 32;
/// Places along each side of the grid over the octant of SPHERE.
const SPHERE_GRID: u32 = 16;

/// Why there is no error.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// The map has no value at a place.
    #[error("the map has no value at ({}, {}, {}); is it a map of this scene?", .0[0], .0[1], .0[2])]
    Unknown([f64; 3]),
}

/// One place of a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredPoint {
    /// Letter in the paper's table.
    pub name: char,
    /// The exact total, lx.
    pub expected_lx: f64,
    /// As probed, lx.
    pub measured_lx: f64,
    /// Standard error of the measured value, lx; `None` where the map does not know it.
    pub standard_error_lx: Option<f64>,
}

/// Errors over a grid of places.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GridError {
    /// Relative L2 distance (the paper's, 3.3).
    pub relative_l2: f64,
    /// Root mean square of relative differences.
    pub rms_relative: f64,
    /// Share of the places whose intervals of 95 % hold the truth; `None` where the map does not know its error.
    pub covered: Option<f64>,
    /// Root mean square of the standard errors told, over that of the true errors; `None` likewise.
    pub told_over_true: Option<f64>,
    /// Number of places.
    pub places: usize,
}

/// How far a map of CUBE is from the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CubeError {
    /// The points of Table 1.
    pub points: Vec<MeasuredPoint>,
    /// Weighted root mean square of their relative differences, the paper's error.
    pub points_error: f64,
    /// Over the middles of 32 x 32 cells of one face.
    pub grid: GridError,
}

/// How far a map of SPHERE is from the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SphereError {
    /// The paper's point.
    pub centre: MeasuredPoint,
    /// Its relative difference, without sign.
    pub centre_error: f64,
    /// Over 16 x 16 places of equal area.
    pub grid: GridError,
}

/// The error of a map of CUBE.
pub fn measure_cube(scene: &Scene, map: &IlluminationMap) -> Result<CubeError, MeasureError> {
    let reader = MapReader::new(scene, map);
    let reference = cube::reference::cube_reference();
    let points = cube::TABLE_1
        .iter()
        .map(|p| {
            let expected_lx = reference.at(p.x, p.y).total_lx();
            measured(&reader, p.name, cube::floor_point(p.x, p.y), expected_lx)
        })
        .collect::<Result<Vec<_>, _>>()?;
    let weighted: Vec<(Pair, f64)> =
        points.iter().map(pair).zip(cube::TABLE_1.iter().map(|p| p.weight)).collect();
    let points_error = weighted_rms_relative_difference(&weighted).unwrap_or(f64::NAN);
    Ok(CubeError { points, points_error, grid: grid_error(&reader, cube_grid())? })
}

/// The error of a map of SPHERE.
pub fn measure_sphere(scene: &Scene, map: &IlluminationMap) -> Result<SphereError, MeasureError> {
    let at = sphere::centre();
    let reader = MapReader::new(scene, map);
    let centre = measured(&reader, 'C', at, sphere::total_lx(&at))?;
    let grid = sphere_grid();
    Ok(SphereError {
        centre,
        centre_error: (centre.measured_lx / centre.expected_lx - 1.0).abs(),
        grid: grid_error(&reader, &grid)?,
    })
}

/// 16 x 16 places of equal area over SPHERE and their exact totals, lx.
pub fn sphere_grid() -> Vec<(ProbePoint, f64)> {
    sphere::grid(SPHERE_GRID).into_iter().map(|at| (at, sphere::total_lx(&at))).collect()
}

/// Middles of the 32 x 32 cells of the floor of CUBE and their exact totals in lx, computed once.
pub fn cube_grid() -> &'static [(ProbePoint, f64)] {
    static GRID: LazyLock<Vec<(ProbePoint, f64)>> = LazyLock::new(|| {
        let reference = cube::reference::cube_reference();
        let half = CUBE_GRID / 2;
        let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(half);
        let quarter: Vec<f64> = (0..half * half)
            .into_par_iter()
            .map(|k| {
                // Symmetric in x and y: the smaller triangle is enough.
                let (i, j) = (k / half, k % half);
                if i <= j { reference.at(middle(i), middle(j)).total_lx() } else { 0.0 }
            })
            .collect();
        let value = |i: u32, j: u32| quarter[(i.min(j) * half + i.max(j)) as usize];
        let mut grid = Vec::new();
        for i in 0..half {
            for j in 0..half {
                for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                    grid.push((cube::floor_point(sx * middle(i), sy * middle(j)), value(i, j)));
                }
            }
        }
        grid
    });
    &GRID
}

fn measured(
    reader: &MapReader,
    name: char,
    at: ProbePoint,
    expected_lx: f64,
) -> Result<MeasuredPoint, MeasureError> {
    let found = reader.probe(at).ok_or(MeasureError::Unknown(at.position.into()))?;
    let measured_lx = found.illuminance_lx();
    let standard_error_lx = Some(found.standard_error_lx).filter(|error| error.is_finite());
    Ok(MeasuredPoint { name, expected_lx, measured_lx, standard_error_lx })
}

fn pair(point: &MeasuredPoint) -> Pair {
    Pair { reference: point.expected_lx, measured: point.measured_lx }
}

fn grid_error(reader: &MapReader, grid: &[(ProbePoint, f64)]) -> Result<GridError, MeasureError> {
    let places = grid
        .par_iter()
        .map(|&(at, expected_lx)| measured(reader, ' ', at, expected_lx))
        .collect::<Result<Vec<MeasuredPoint>, MeasureError>>()?;
    let pairs: Vec<Pair> = places.iter().map(pair).collect();
    let even: Vec<(Pair, f64)> = pairs.iter().map(|&p| (p, 1.0)).collect();
    Ok(GridError {
        relative_l2: relative_l2_distance(&pairs).unwrap_or(f64::NAN),
        rms_relative: weighted_rms_relative_difference(&even).unwrap_or(f64::NAN),
        covered: covered(&places),
        told_over_true: told_over_true(&places),
        places: pairs.len(),
    })
}

/// The quantile of the normal distribution that intervals of 95 % reach to on either side.
const IN_95_OF_100: f64 = 1.96;

/// The share of places that lie within their intervals of 95 %; `None` where one of them does not know its own.
fn covered(places: &[MeasuredPoint]) -> Option<f64> {
    let holds = |place: &MeasuredPoint| {
        let reach_lx = IN_95_OF_100 * place.standard_error_lx?;
        Some((place.measured_lx - place.expected_lx).abs() <= reach_lx)
    };
    let held = places.iter().map(holds).collect::<Option<Vec<bool>>>()?;
    Some(held.iter().filter(|held| **held).count() as f64 / held.len().max(1) as f64)
}

/// Root mean square of what is told over that of what is true; `None` where all are right, or one of them tells nothing.
fn told_over_true(places: &[MeasuredPoint]) -> Option<f64> {
    let told = places.iter().map(|p| Some(p.standard_error_lx?.powi(2))).sum::<Option<f64>>()?;
    let wrong = places.iter().map(|p| (p.measured_lx - p.expected_lx).powi(2)).sum::<f64>();
    (wrong > 0.0).then(|| (told / wrong).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_covers_the_face_and_holds_the_mean() {
        let grid = cube_grid();
        assert_eq!(grid.len(), 32 * 32);
        let mean_lx = grid.iter().map(|(_, lx)| lx).sum::<f64>() / grid.len() as f64;
        let expected_lx = cube::reference::cube_reference().mean_illuminance_lx();
        // The midpoint rule of 32 cells is second order: (1 / 32)^2 with a curvature of order one.
        assert!((mean_lx / expected_lx - 1.0).abs() < 1e-3, "{mean_lx} {expected_lx}");
    }
}
