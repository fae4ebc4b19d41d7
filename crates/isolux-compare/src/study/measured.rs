//! By how much maps of the scenes with exact answers are wrong, as the study measures it.

use crate::case::cube;
use crate::measure::{MeasureError, MeasuredPoint, measure_cube, measure_sphere, sphere_grid};
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
