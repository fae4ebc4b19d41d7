//! Places of a surface that see each other.

use super::*;
use crate::elements::PlaceOnSide;
use crate::engine::{MapReader, SolveRequest, Watch, solve};

fn sees(scene: &Scene, [from, to]: [[f64; 3]; 2]) -> bool {
    let request = SolveRequest { accuracy: Some(0.5), ..SolveRequest::default() };
    let map = solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let [from, to] = [from, to].map(|at| {
        let SurfacePoint { triangle, back, u, v, .. } = front_at(scene, Point::from(at));
        PlaceOnSide { triangle, back, uv: [u, v] }
    });
    let reader = MapReader::new(scene, &map);
    assert_eq!(reader.sees(from, to), reader.sees(to, from));
    reader.sees(from, to)
}

fn lit(mut shapes: Vec<Shape>, more: Vec<Shape>) -> Scene {
    shapes.extend(more);
    let paint = Material::two_sided("paint", Finish::diffuse(Rgb::grey(0.5)));
    scene(shapes, vec![paint], vec![isotropic([0.5, 0.5, 2.0], 100.0)])
}

fn floor() -> Vec<Shape> {
    vec![rectangle([0.0; 3], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0)]
}

fn sheet(low: f64, high: f64) -> Shape {
    rectangle([1.37, 0.0, low], [0.0, 1.5, 0.0], [0.0, 0.0, high - low], 0)
}

#[test]
fn walls_part_floors_and_carpets_and_tables_do_not() {
    let across = [[1.2, 0.3, 0.0], [1.6, 0.6, 0.0]];
    let beside = [[1.2, 0.3, 0.0], [1.3, 0.6, 0.0]];
    let through_the_door = [[1.2, 1.7, 0.0], [1.6, 1.8, 0.0]];
    let wall = lit(floor(), vec![sheet(0.0, 2.5)]);
    assert_eq!(
        [across, beside, through_the_door].map(|ends| sees(&wall, ends)),
        [false, true, true]
    );
    assert!(sees(&lit(floor(), Vec::new()), across));
    assert!(sees(&lit(floor(), vec![sheet(0.0, 0.02)]), across), "the rim of a carpet");
    assert!(sees(&lit(floor(), vec![sheet(0.02, 0.8)]), across), "light comes below it");
}

#[test]
fn columns_do_not_part_themselves() {
    // Facets of a column, 22.5 degrees from each to the next.
    let corner = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::PI / 8.0;
        [2.0 + 0.3 * libm::cos(angle), 1.0 + 0.3 * libm::sin(angle), 0.0]
    };
    let facets: Vec<Shape> = (0..16)
        .map(|k| {
            let [a, b] = [corner(k), corner(k + 1)];
            rectangle(a, [b[0] - a[0], b[1] - a[1], 0.0], [0.0, 0.0, 2.0], 0)
        })
        .collect();
    let middle = |k: u32, z: f64| {
        let [a, b] = [corner(k), corner(k + 1)];
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), z]
    };
    let scene = lit(floor(), facets);
    for far in 1..=4 {
        assert!(sees(&scene, [middle(3, 1.0), middle(3 + far, 1.1)]), "{far}");
    }
}
