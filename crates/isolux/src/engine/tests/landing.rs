//! Lamps close to surfaces: their light lands between the vertices of any first mesh.

use super::*;
use crate::engine::gather::Unlit;
use crate::engine::judge::Light;
use crate::engine::light::Lighting;
use crate::engine::method::PathTracer;
use crate::engine::pilot::pilot;
use crate::engine::ray::ProbePoint;
use crate::engine::read::{ExactSettings, MapReader};
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::Method;
use std::f64::consts::PI;

const ROOM_M: [f64; 3] = [4.0, 5.0, 2.8];
const REFLECTANCE: f64 = 0.7;
const FLUX_LM: f64 = 500.0;

/// A closed room with a lamp so far below its ceiling.
fn room(below_m: f64) -> Scene {
    let lamp = isotropic([1.9, 2.3, ROOM_M[2] - below_m], FLUX_LM / (4.0 * PI));
    scene(inward_box(ROOM_M, 0), vec![painted(Rgb::grey(REFLECTANCE))], vec![lamp])
}

#[test]
fn vertices_tell_of_light_that_lands_on_a_hand_s_breadth() {
    let scene = room(0.005);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let vertices = plan.mesh.elements.vertices().iter().zip(&plan.light.direct);
    let told_lm: f64 = vertices.map(|(vertex, lx)| vertex.area_m2 * lx.luminance()).sum();
    // All of it lands. Linear elements tell too much of a peak, by no more than the stored map may err.
    let may_err = usual_request().mesh_target;
    assert!((told_lm / FLUX_LM - 1.0).abs() < may_err, "{told_lm}");
    // Half of it on what no walls would tell.
    assert!(plan.light.backdrop.is_none());
}

/// So many that luminaires are chosen among: each lights a hand's breadth, all of them half of what light there is.
#[test]
fn vertices_tell_of_what_many_lamps_light_close_by() {
    const SIDE: usize = 25;
    let at = |k: usize, size_m: f64| size_m * (0.47 + k as f64) / SIDE as f64;
    let each_cd = FLUX_LM / (4.0 * PI * (SIDE * SIDE) as f64);
    let lamp = |k: usize| {
        let [x, y] = [at(k % SIDE, ROOM_M[0]), at(k / SIDE, ROOM_M[1])];
        isotropic([x, y, ROOM_M[2] - 0.02], each_cd)
    };
    let lamps = (0..SIDE * SIDE).map(lamp).collect();
    let scene = scene(inward_box(ROOM_M, 0), vec![painted(Rgb::grey(REFLECTANCE))], lamps);
    let lighting = Lighting::new(&scene);
    assert!(lighting.are_countless());
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let vertices = plan.mesh.elements.vertices().iter().zip(&plan.light.direct);
    let told_lm: f64 = vertices.map(|(vertex, lx)| vertex.area_m2 * lx.luminance()).sum();
    // As for one lamp.
    assert!((told_lm / FLUX_LM - 1.0).abs() < 0.02, "{told_lm}");
}

#[test]
fn rooms_are_as_bright_as_the_balance_of_light_has_them() {
    let scene = room(0.005);
    for seed in 1..4 {
        let request = SolveRequest { seed, ..SolveRequest::default() };
        let solution = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap();
        let map = solution.map;
        let of = map.elements.vertices().iter().zip(&map.values);
        let lm: f64 = of.map(|(v, value)| v.area_m2 * value.unwrap().indirect_lx.luminance()).sum();
        let expected_lm = FLUX_LM * REFLECTANCE / (1.0 - REFLECTANCE);
        let told = map.provenance.accuracy.unwrap().reached;
        // Errors are relative to twice the mean here; their mean is no larger than their root mean square.
        let most_lm = 2.0 * told * 2.0 * (FLUX_LM + expected_lm);
        assert!(told < 0.01 && (lm - expected_lm).abs() < most_lm, "{seed}: {lm} {expected_lm}");
    }
}

#[test]
fn spots_that_decide_what_errors_are_relative_to_are_told() {
    let spots = |below_m: f64, reflectance: f64| {
        let lamp = isotropic([1.9, 2.3, ROOM_M[2] - below_m], FLUX_LM / (4.0 * PI));
        let paint = vec![painted(Rgb::grey(reflectance))];
        let scene = scene(inward_box(ROOM_M, 0), paint, vec![lamp]);
        let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
        let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
        map.hot_spots()
    };
    // Half of the light lands on the ceiling, almost all of it within ten times as far as the lamp is away; a tenth is reflected.
    let told = spots(0.01, 0.1).unwrap();
    assert!(told.share > 0.42 && told.share < 0.46, "{told:?}");
    let (at, lx) = told.brightest;
    assert!((at - Point::new(1.9, 2.3, ROOM_M[2])).length() < 0.01 && lx > 1e5, "{told:?}");
    let all_m2 = 2.0 * (4.0 * 5.0 + 4.0 * 2.8 + 5.0 * 2.8);
    assert!((told.others_m2 / (0.99 * all_m2) - 1.0).abs() < 0.01, "{told:?}");
    let others_lm = told.others_lx * told.others_m2;
    assert!((others_lm / (FLUX_LM / 0.9 * (1.0 - told.share)) - 1.0).abs() < 0.05, "{told:?}");
    assert_eq!(spots(0.5, 0.1), None);
}

#[test]
fn wide_ground_without_light_makes_no_spot_of_a_room() {
    let mut shapes = inward_box(ROOM_M, 0);
    shapes.push(rectangle([-150.0, -150.0, -0.1], [300.0, 0.0, 0.0], [0.0, 300.0, 0.0], 0));
    let lamp = isotropic([1.9, 2.3, 1.5], FLUX_LM / (4.0 * PI));
    let scene = scene(shapes, vec![painted(Rgb::grey(0.5))], vec![lamp]);
    let request = SolveRequest { accuracy: Some(0.3), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let known = map.known_surface();
    let room_m2 = 2.0 * (4.0 * 5.0 + 4.0 * 2.8 + 5.0 * 2.8);
    assert!((known.lit_m2 / room_m2 - 1.0).abs() < 1e-3 && known.all_m2 > 9e4, "{known:?}");
    assert_eq!(map.hot_spots(), None);
}

/// Under a large sky one particle in a quarter of a million would come to a square metre: that none does tells nothing of its vertices.
#[test]
fn a_floor_that_no_particle_finds_below_a_large_sky_is_right_as_it_is() {
    const LUMINANCE_CD_M2: f64 = 100.0;
    let mut shapes = inward_box([200.0; 3], 1);
    shapes.push(rectangle([100.0, 100.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0));
    let materials = vec![painted(Rgb::grey(REFLECTANCE)), glowing(LUMINANCE_CD_M2)];
    let scene = scene(shapes, materials, vec![]);
    let lighting = Lighting::new(&scene);
    let plan = pilot(&scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    assert!(plan.mesh.elements.vertices().len() < 3000, "{}", plan.mesh.elements.vertices().len());
    let lit = |lx: &Rgb| (lx.luminance() / (PI * LUMINANCE_CD_M2) - 1.0).abs() < 0.02;
    assert!(plan.light.direct.iter().all(lit), "{:?}", plan.light.direct);
}

#[test]
fn paths_find_what_lamps_light_close_by() {
    // Without light sent out they find two thirds of it at some places and tell a fiftieth as error.
    let scene = room(0.01);
    let tracer = PathTracer::new(&scene);
    let request = SolveRequest { accuracy: Some(0.003), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let reader = MapReader::new(&scene, &map);
    for (k, [x, y]) in [[0.4, 0.5], [2.0, 2.5], [3.1, 4.4], [1.0, 3.0]].into_iter().enumerate() {
        let at = ProbePoint {
            position: Point::new(x, y, 0.0),
            normal: Vector::new(0.0, 0.0, 1.0).normal().unwrap(),
        };
        let found = tracer.estimate(at, &ExactSettings::default());
        let read = reader.probe(at).unwrap();
        let error = libm::hypot(found.standard_error_lx, read.standard_error_lx);
        let apart = (found.indirect_lx - read.indirect_lx).luminance();
        assert!(apart.abs() < 4.0 * error, "{k}: {found:?} {read:?}");
        assert!(found.standard_error_lx < 0.02 * found.illuminance_lx(), "{k}: {found:?}");
    }
}

/// Where two sheets meet in a plane that single precision does not have, rays end on the wrong side of where they start.
#[test]
fn paths_are_finite_where_sheets_meet_in_the_dark() {
    let mut shapes = inward_box([3.0; 3], 0);
    shapes.push(rectangle([0.6, 1.0, 2.95], [0.6, 0.0, 0.0], [0.0, 1.0, 0.0], 0));
    shapes.push(rectangle([1.2, 1.0, 2.8], [0.0, 1.0, 0.0], [0.0, 0.0, 0.15], 0));
    let paint = Material::two_sided("paint", Finish::diffuse(Rgb::grey(0.85)));
    let scene = scene(shapes, vec![paint], vec![isotropic([0.9, 1.5, 2.98], 100.0)]);
    let tracer = PathTracer::new(&scene);
    let down = Vector::new(0.0, 0.0, -1.0).normal().unwrap();
    for y in [1.5, 1.9999] {
        let at = ProbePoint { position: Point::new(1.2, y, 2.95), normal: down };
        let found = tracer.estimate(at, &ExactSettings::default());
        let (lx, error_lx) = (found.illuminance_lx(), found.standard_error_lx);
        assert!(lx > 0.0 && error_lx < lx, "{y}: {lx} {error_lx}");
    }
}

#[test]
fn errors_are_relative_to_no_more_than_twice_the_mean() {
    let of = |parts: &[(f64, f64)]| {
        let mut light = Light::default();
        parts.iter().for_each(|&(m2, lx)| light.add(m2, lx));
        light.reference_lx()
    };
    assert_eq!(of(&[]), 0.0);
    assert_eq!(of(&[(2.0, 0.0)]), 0.0);
    assert_eq!(of(&[(2.0, 5.0)]), 5.0);
    // Half of it dark: the root mean square.
    assert!((of(&[(2.0, 0.0), (2.0, 5.0)]) - 5.0 * 0.5_f64.sqrt()).abs() < 1e-12);
    // A hot spot: twice the mean.
    assert!((of(&[(99.9, 1.0), (0.1, 1e5)]) - 2.0 * 100.999).abs() < 1e-9);
}

/// Two rooms that do not see each other, one of them a thousand times as bright. Errors are relative to its light; rays of the other
/// read what lamps light below its ceiling all the same.
#[test]
fn lamps_below_the_ceiling_of_a_dim_room_are_resolved_where_rays_read_them() {
    const DIM_M: [f64; 3] = [9.0, 7.0, 3.0];
    let bright = isotropic([1.9, -7.3, 1.2], 1e3 * FLUX_LM);
    // Three at each of six places.
    let lamp = |k: usize| {
        let (row, column) = ((k % 3) as f64, (k / 3 % 2) as f64);
        isotropic([2.2 + 2.3 * row, 1.7 + 3.4 * column, DIM_M[2] - 0.2], FLUX_LM / 18.0)
    };
    let moved = |shape: Shape| {
        let positions = shape.positions.iter().map(|&[x, y, z]| [x, y - 10.0, z]).collect();
        Shape { positions, ..shape }
    };
    let rooms: Vec<Shape> = inward_box(ROOM_M, 0).into_iter().map(moved).collect();
    let rooms = rooms.into_iter().chain(inward_box(DIM_M, 0)).collect();
    let lamps = (0..18).map(lamp).chain([bright]).collect();
    let scene = scene(rooms, vec![painted(Rgb::grey(REFLECTANCE))], lamps);
    let tracer = PathTracer::new(&scene);
    let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
    let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
    let reader = MapReader::new(&scene, &map);
    let (mut read_lx, mut true_lx) = (0.0, 0.0);
    for [x, y] in [[0.4, 0.5], [2.0, 2.5], [3.1, 4.4], [1.0, 3.0]] {
        let normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
        let at = ProbePoint { position: Point::new(x, y, 0.8), normal };
        read_lx += reader.measure(at).unwrap().indirect_lx.luminance();
        true_lx += tracer.estimate(at, &ExactSettings::default()).indirect_lx.luminance();
    }
    assert!((read_lx / true_lx - 1.0).abs() < 0.05, "{read_lx} {true_lx}");
}

/// The light about a lamp on a ceiling, and at places of which many lie close to edges: rays that go on from there meet what it lights
/// no more often than the first ones.
#[test]
fn light_that_lands_about_a_lamp_on_a_vertex_of_a_ceiling_is_gathered_by_every_method() {
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    let desk = inward_box([1.6, 0.8, 0.05], 1).into_iter().map(|shape| {
        let positions = shape.positions.iter().map(|&[x, y, z]| [x + 1.0, y + 1.0, z + 0.7]);
        Shape { positions: positions.collect(), triangles: vec![[0, 2, 1], [0, 3, 2]], ..shape }
    });
    shapes.extend(desk);
    let paint = vec![painted(Rgb::grey(0.7)), painted(Rgb::grey(0.3))];
    // On the diagonal of both triangles, and on a vertex as soon as they are bisected.
    let scene = scene(shapes, paint, vec![isotropic([2.0, 2.0, 3.0], 3000.0 / (4.0 * PI))]);
    let tracer = PathTracer::new(&scene);
    let up = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let aside = Vector::new(1.0, 0.0, 0.0).normal().unwrap();
    let places = [
        ([0.25, 0.25, 0.0], up),
        ([0.75, 2.75, 0.0], up),
        ([3.25, 3.25, 0.0], up),
        ([2.25, 0.75, 0.0], up),
        ([0.05, 0.05, 0.0], up),
        ([2.1, 0.02, 0.0], up),
        ([0.0, 2.0, 0.08], aside),
        ([0.0, 0.02, 1.2], aside),
    ];
    let places = places.map(|(at, normal)| ProbePoint { position: Point::from(at), normal });
    let found = places.map(|at| tracer.estimate(at, &ExactSettings::default()));
    for (method, accuracy) in [(Method::Hybrid, 0.005), (Method::Cache, 0.01)] {
        let accuracy = Some(accuracy);
        let request = SolveRequest { method, accuracy, ..SolveRequest::default() };
        let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
        let reader = MapReader::new(&scene, &map);
        for (at, found) in places.iter().zip(&found) {
            let exact = reader.estimate(*at, &ExactSettings::default());
            for read in [reader.probe(*at).unwrap(), exact] {
                let error_lx = libm::hypot(read.standard_error_lx, found.standard_error_lx);
                let apart_lx = read.illuminance_lx() - found.illuminance_lx();
                // One in sixteen thousand is farther off.
                assert!(apart_lx.abs() < 4.0 * error_lx, "{method:?} {at:?}: {read:?} {found:?}");
                // What is told says something: the spot gives a fifth of the light.
                assert!(error_lx < 0.1 * found.illuminance_lx(), "{method:?} {at:?}: {read:?}");
            }
        }
    }
}
