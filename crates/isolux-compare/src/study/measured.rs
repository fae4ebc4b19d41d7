//! By how much maps of the scenes with exact answers are wrong, as the study measures it.

use crate::case::{cube, sphere};
use crate::measure::{
    MeasureError, MeasuredPoint, cube_grid, measure_cube, measure_sphere, sphere_grid,
};
use crate::metric::{Pair, relative_l2_distance, weighted_rms_relative_difference};
use isolux::engine::ProbePoint;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// The error of a map whose right values are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The points of the study: A to F of CUBE, the centre of SPHERE.
    pub points: Vec<MeasuredPoint>,
    /// The study's error: of CUBE the weighted root mean square of the relative differences at its six points (2.1), of SPHERE the
    /// relative difference at its point (2.2).
    pub error: f64,
    /// Root mean square difference over a grid of places of equal area, over the root mean square of the right values.
    pub grid: f64,
    /// Share of the places of the grid whose intervals of 95 % hold the right value; `None` where the map does not know its error.
    pub covered: Option<f64>,
    /// Root mean square of the standard errors told there, over that of the true errors.
    pub told_over_true: Option<f64>,
}

/// The error of a map of the case `cube` or `sphere`; `None` of any other.
pub fn measure(
    case: &str,
    scene: &Scene,
    map: &IlluminationMap,
) -> Option<Result<Measured, MeasureError>> {
    let (points, error, grid) = match case {
        "cube" => match measure_cube(scene, map) {
            Ok(of) => (of.points, of.points_error, of.grid),
            Err(problem) => return Some(Err(problem)),
        },
        "sphere" => match measure_sphere(scene, map) {
            Ok(of) => (vec![of.centre], of.centre_error, of.grid),
            Err(problem) => return Some(Err(problem)),
        },
        _ => return None,
    };
    Some(Ok(Measured {
        points,
        error,
        grid: grid.relative_l2,
        covered: grid.covered,
        told_over_true: grid.told_over_true,
    }))
}

/// The places that [`measure`] reads in the case `cube` or `sphere`, with their right values in lx: those of the grid, then the points of the study; `None`
/// of any other.
pub fn places(case: &str) -> Option<Vec<(ProbePoint, f64)>> {
    let (mut places, points) = match case {
        "cube" => {
            (cube_grid().to_vec(), cube::TABLE_1.map(|p| cube::floor_point(p.x, p.y)).to_vec())
        }
        "sphere" => (sphere_grid(), vec![sphere::centre()]),
        _ => return None,
    };
    let reference = cube::reference::cube_reference;
    let right_lx = |at: &ProbePoint| match case {
        "cube" => {
            let [x, y] = [at.position.x, at.position.y].map(|x| x / cube::HALF_EDGE_M);
            reference().at(x, y).total_lx()
        }
        _ => sphere::total_lx(at),
    };
    places.extend(points.iter().map(|at| (*at, right_lx(at))));
    Some(places)
}

/// The error of a renderer that makes no map, by what it finds at [`places`], lx; `None` of another case, or of another number of places.
pub fn measure_places(case: &str, found_lx: &[f64]) -> Option<Measured> {
    let places = places(case)?;
    if places.len() != found_lx.len() {
        return None;
    }
    let pairs: Vec<Pair> = places
        .iter()
        .zip(found_lx)
        .map(|(&(_, reference), &measured)| Pair { reference, measured })
        .collect();
    let named: Vec<(char, f64)> = match case {
        "cube" => cube::TABLE_1.iter().map(|point| (point.name, point.weight)).collect(),
        _ => vec![('C', 1.0)],
    };
    let (grid, points) = pairs.split_at(pairs.len() - named.len());
    let weighted: Vec<(Pair, f64)> =
        points.iter().zip(&named).map(|(&pair, &(_, weight))| (pair, weight)).collect();
    let point = |(pair, &(name, _)): (&Pair, &(char, f64))| MeasuredPoint {
        name,
        expected_lx: pair.reference,
        measured_lx: pair.measured,
        standard_error_lx: None,
    };
    Some(Measured {
        points: points.iter().zip(&named).map(point).collect(),
        error: weighted_rms_relative_difference(&weighted)?,
        grid: relative_l2_distance(grid)?,
        covered: None,
        told_over_true: None,
    })
}

/// The flux that lands on the surfaces of the case `cube` or `sphere` over that which the luminaire emits: in a closed box of one reflectance `1/(1 - rho)`, on
/// an octant the mean illuminance of places of equal area times its area.
pub fn right_landing(case: &str, scene: &Scene) -> Option<f64> {
    match case {
        "cube" => Some(1.0 / (1.0 - cube::REFLECTANCE)),
        "sphere" => {
            let places = sphere_grid();
            let mean_lx = places.iter().map(|(_, lx)| lx).sum::<f64>() / places.len() as f64;
            Some(mean_lx * FRAC_PI_2 / scene.luminous_flux_lm())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::engine::{MapReader, SolveRequest, Watch, solve};
    use isolux::scene::Scene;

    #[test]
    fn a_map_and_what_is_read_of_it_err_alike() {
        for case in ["cube", "sphere"] {
            let scene = Scene::assemble(crate::builtin(case).unwrap()).unwrap();
            let request = SolveRequest { accuracy: Some(0.1), ..SolveRequest::default() };
            let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
            let reader = MapReader::new(&scene, &map);
            let read = |(at, _): &(ProbePoint, f64)| reader.probe(*at).unwrap().illuminance_lx();
            let found_lx: Vec<f64> = places(case).unwrap().iter().map(read).collect();
            let [by_map, by_places] = [
                measure(case, &scene, &map).unwrap().unwrap(),
                measure_places(case, &found_lx).unwrap(),
            ];
            // The same sums in another order, over a thousand places.
            let is_same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs();
            assert!(is_same(by_map.error, by_places.error) && is_same(by_map.grid, by_places.grid));
            assert_eq!(measure_places(case, &found_lx[1..]), None);
        }
        assert!(places("hall").is_none());
    }
}
