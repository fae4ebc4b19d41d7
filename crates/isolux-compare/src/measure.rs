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

/// What is found at the places of the case `cube` or `sphere`.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    /// Over places of equal area: the middles of 32 x 32 cells of a face of CUBE, 16 x 16 places of SPHERE.
    pub grid: Vec<MeasuredPoint>,
    /// At the points of the paper: A to F of CUBE, the centre of SPHERE; each with its weight.
    pub points: Vec<(MeasuredPoint, f64)>,
}

/// A point of the paper: its letter, its weight and where it is.
fn points(case: &str) -> Option<Vec<(char, f64, ProbePoint)>> {
    match case {
        "cube" => {
            let point = |p: &cube::TablePoint| (p.name, p.weight, cube::floor_point(p.x, p.y));
            Some(cube::TABLE_1.iter().map(point).collect())
        }
        "sphere" => Some(vec![('C', 1.0, sphere::centre())]),
        _ => None,
    }
}

/// Where the case `cube` or `sphere` is read, with the right values in lx: the places of the grid, then the points of the paper; `None` of any other.
pub fn places(case: &str) -> Option<Vec<(ProbePoint, f64)>> {
    let points = points(case)?;
    let mut places = if case == "cube" { cube_grid().to_vec() } else { sphere_grid() };
    let right_lx = |at: &ProbePoint| match case {
        "cube" => {
            let [x, y] = [at.position.x, at.position.y].map(|x| x / cube::HALF_EDGE_M);
            cube::reference::cube_reference().at(x, y).total_lx()
        }
        _ => sphere::total_lx(at),
    };
    places.extend(points.iter().map(|(_, _, at)| (*at, right_lx(at))));
    Some(places)
}

impl Readings {
    /// Of a map; `None` of a case without right values.
    pub fn of_map(
        case: &str,
        scene: &Scene,
        map: &IlluminationMap,
    ) -> Option<Result<Self, MeasureError>> {
        let reader = MapReader::new(scene, map);
        let read = |&(at, expected_lx): &(ProbePoint, f64)| measured(&reader, at, expected_lx);
        let all = places(case)?.par_iter().map(read).collect::<Result<Vec<_>, MeasureError>>();
        all.map(|all| Self::parted(case, all)).transpose()
    }

    /// Of what is found at [`places`], lx, by a renderer that makes no map; `None` of another case, or of another number of places.
    pub fn of_values(case: &str, found_lx: &[f64]) -> Option<Self> {
        let places = places(case)?;
        let found = |((_, expected_lx), measured_lx): (&(ProbePoint, f64), &f64)| MeasuredPoint {
            name: ' ',
            expected_lx: *expected_lx,
            measured_lx: *measured_lx,
            standard_error_lx: None,
        };
        let all = places.iter().zip(found_lx).map(found).collect();
        (places.len() == found_lx.len()).then(|| Self::parted(case, all)).flatten()
    }

    /// Readings at [`places`], the points of the paper last.
    fn parted(case: &str, mut all: Vec<MeasuredPoint>) -> Option<Self> {
        let named = points(case)?;
        let last = all.split_off(all.len() - named.len());
        let name = |(point, (name, weight, _))| (MeasuredPoint { name, ..point }, weight);
        Some(Self { grid: all, points: last.into_iter().zip(named).map(name).collect() })
    }

    /// The root mean square of the relative differences at the points of the paper, by their weights (2.1).
    pub fn points_error(&self) -> Option<f64> {
        let weighted: Vec<(Pair, f64)> =
            self.points.iter().map(|(point, weight)| (pair(point), *weight)).collect();
        weighted_rms_relative_difference(&weighted)
    }

    /// The relative L2 distance over the grid (the paper's, 3.3).
    pub fn grid_error(&self) -> Option<f64> {
        let pairs: Vec<Pair> = self.grid.iter().map(pair).collect();
        relative_l2_distance(&pairs)
    }

    /// The share of the places of the grid that lie within their intervals of 95 %; `None` where one of them does not know its own.
    pub fn covered(&self) -> Option<f64> {
        let holds = |place: &MeasuredPoint| {
            let reach_lx = IN_95_OF_100 * place.standard_error_lx?;
            Some((place.measured_lx - place.expected_lx).abs() <= reach_lx)
        };
        let held = self.grid.iter().map(holds).collect::<Option<Vec<bool>>>()?;
        Some(held.iter().filter(|held| **held).count() as f64 / held.len().max(1) as f64)
    }

    /// Root mean square of what is told over the grid, over that of what is true; `None` where all are right, or one of them tells nothing.
    pub fn told_over_true(&self) -> Option<f64> {
        let told = |p: &MeasuredPoint| Some(p.standard_error_lx?.powi(2));
        let told = self.grid.iter().map(told).sum::<Option<f64>>()?;
        let wrong = self.grid.iter().map(|p| (p.measured_lx - p.expected_lx).powi(2)).sum::<f64>();
        (wrong > 0.0).then(|| (told / wrong).sqrt())
    }
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
    at: ProbePoint,
    expected_lx: f64,
) -> Result<MeasuredPoint, MeasureError> {
    let found = reader.probe(at).ok_or(MeasureError::Unknown(at.position.into()))?;
    let measured_lx = found.illuminance_lx();
    let standard_error_lx = Some(found.standard_error_lx).filter(|error| error.is_finite());
    Ok(MeasuredPoint { name: ' ', expected_lx, measured_lx, standard_error_lx })
}

fn pair(point: &MeasuredPoint) -> Pair {
    Pair { reference: point.expected_lx, measured: point.measured_lx }
}

/// The quantile of the normal distribution that intervals of 95 % reach to on either side.
const IN_95_OF_100: f64 = 1.96;

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
