//! By how much maps of the scenes with exact answers are wrong, as the study measures it.

use crate::case::cube;
use crate::measure::{MeasuredPoint, Readings, sphere_grid};
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

impl Measured {
    /// By readings.
    pub fn of(readings: &Readings) -> Option<Self> {
        Some(Self {
            points: readings.points.iter().map(|(point, _)| *point).collect(),
            error: readings.points_error()?,
            grid: readings.grid_error()?,
            covered: readings.covered(),
            told_over_true: readings.told_over_true(),
        })
    }
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
    use crate::measure::places;
    use isolux::engine::{MapReader, ProbePoint, SolveRequest, Watch, solve};

    #[test]
    fn a_map_and_what_is_read_of_it_err_alike() {
        for case in ["cube", "sphere"] {
            let scene = Scene::assemble(crate::builtin(case).unwrap()).unwrap();
            let request = SolveRequest { accuracy: Some(0.1), ..SolveRequest::default() };
            let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
            let reader = MapReader::new(&scene, &map);
            let read = |(at, _): &(ProbePoint, f64)| reader.probe(*at).unwrap().illuminance_lx();
            let found_lx: Vec<f64> = places(case).unwrap().iter().map(read).collect();
            let by_map = Readings::of_map(case, &scene, &map).unwrap().unwrap();
            let by_values = Readings::of_values(case, &found_lx).unwrap();
            let [by_map, by_places] = [by_map, by_values].map(|of| Measured::of(&of).unwrap());
            // The same sums in another order, over a thousand places.
            let is_same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs();
            assert!(is_same(by_map.error, by_places.error) && is_same(by_map.grid, by_places.grid));
            assert_eq!(Readings::of_values(case, &found_lx[1..]), None);
        }
        assert!(places("hall").is_none());
    }
}
