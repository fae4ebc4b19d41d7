//! Scenes with points and the right illuminance there, for the scripts of `benchmarks/peers` that ask other renderers.

mod json;
mod points;

use crate::builtin;
use crate::case::{cube, find, sphere};
use crate::expectation::Case;
use crate::measure::{cube_grid, places, sphere_grid};
use crate::study::{self, LitPlace};
use isolux::engine::ProbePoint;
use isolux::geometry::{Point, Vector};
use points::{ExactPoint, PointSet};
use serde_json::Value;

/// The scene of a name with all its sets of points; `None` of a scene for which there are none.
pub fn scene(name: &str) -> Option<Value> {
    let parts = builtin(name).ok().or_else(|| find(name).map(|case| (case.parts)()))?;
    Some(json::scene(&parts, &point_sets(name)?))
}

/// The name of the set of points all over a scene, or of all places of a case.
pub const WHOLE: &str = "map";

/// The name of the set of points that readings of CUBE and SPHERE hold.
pub const OF_THE_STUDY: &str = "study";

/// The map of the whole scene first, then the places of the paper, then those that readings hold.
fn point_sets(scene: &str) -> Option<Vec<PointSet>> {
    let (map, paper): (Vec<ExactPoint>, Vec<ExactPoint>) = match scene {
        "hall" => return Some(vec![hall_map()]),
        "cube" => (cube_map(), cube_table()),
        "sphere" => {
            let at = sphere::centre();
            let centre = ExactPoint::of((at, sphere::total_lx(&at)));
            (sphere_grid().into_iter().map(ExactPoint::of).collect(), vec![centre])
        }
        name => return find(name).map(|case| vec![case_map(&case)]),
    };
    let of_the_study = places(scene)?.into_iter().map(ExactPoint::of).collect();
    Some(vec![
        PointSet::exact(WHOLE, map),
        PointSet::exact("paper", paper),
        PointSet::exact(OF_THE_STUDY, of_the_study),
    ])
}

/// The places of the reference that were chosen by area. Relative errors would make the darkest corner count as
/// much as a desk: weights turn them into errors relative to the root mean square of the light.
fn hall_map() -> PointSet {
    /// Gaps of a millimetre between solids, where one side is meant and the other hit.
    const LEAST_LX: f64 = 0.3;
    let text = include_str!("../../../../benchmarks/hall/reference.csv");
    let (mut points, mut squared, mut own) = (Vec::new(), 0.0, 0.0);
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |k: usize| fields[k].parse::<f64>().expect("the reference holds numbers");
        let (expected_lx, own_lx) = (number(6), number(9));
        if fields[10] != "area" || expected_lx < LEAST_LX {
            continue;
        }
        let normal = Vector::new(number(3), number(4), number(5)).normal();
        let at = ProbePoint {
            position: [0, 1, 2].map(number).into(),
            normal: normal.expect("normals have a direction"),
        };
        points.push(ExactPoint { at, expected_lx, weight: expected_lx * expected_lx });
        squared += expected_lx * expected_lx;
        own += own_lx * own_lx;
    }
    let own_error = (own / squared).sqrt();
    PointSet { name: "map", points, own_error, has_caustics: false }
}

/// All places of a case whose whole light is known and not nothing. What the scene as tessellated is off by is the values' own error.
fn case_map(case: &Case) -> PointSet {
    let places = study::lit_places(case);
    let points = places.iter().map(|of| ExactPoint::of((of.at, of.expected_lx))).collect();
    let own = |of: &LitPlace| (of.bound_lx / of.expected_lx).powi(2);
    let own_error = libm::sqrt(places.iter().map(own).sum::<f64>() / places.len().max(1) as f64);
    PointSet { own_error, ..PointSet::exact(WHOLE, points) }
}

/// The grid of the floor on all six faces.
fn cube_map() -> Vec<ExactPoint> {
    let faces = (0..3).flat_map(|axis| [-1.0, 1.0].map(|side| (axis, side)));
    faces
        .flat_map(|(axis, side)| {
            cube_grid().iter().filter_map(move |&(floor, expected_lx)| {
                let at = on_face(floor.position, axis, side)?;
                Some(ExactPoint::of((at, expected_lx)))
            })
        })
        .collect()
}

/// A place of the floor moved to the same place of a face perpendicular to an axis.
fn on_face(floor: Point, axis: usize, side: f64) -> Option<ProbePoint> {
    let mut position = [0.0; 3];
    position[axis] = side * cube::HALF_EDGE_M;
    position[(axis + 1) % 3] = floor.x;
    position[(axis + 2) % 3] = floor.y;
    let mut inward = [0.0; 3];
    inward[axis] = -side;
    Some(ProbePoint { position: position.into(), normal: Vector::from(inward).normal()? })
}

/// Points A to F.
fn cube_table() -> Vec<ExactPoint> {
    let reference = cube::reference::cube_reference();
    cube::TABLE_1
        .iter()
        .map(|p| {
            let expected_lx = reference.at(p.x, p.y).total_lx();
            ExactPoint { at: cube::floor_point(p.x, p.y), expected_lx, weight: p.weight }
        })
        .collect()
}
