//! Things that are sunk into floors, and walls that stand on the edges of floors.

use super::*;
use crate::elements::Vertex;
use crate::engine::gather::Unlit;
use crate::engine::judge::check_points;
use crate::engine::light::Lighting;
use crate::engine::pilot::pilot;
use crate::engine::ray::ProbePoint;
use crate::engine::read::MapReader;
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::{IlluminationMap, Standing};

const SUNK: f64 = 0.01;

fn both_sides(reflectance: f64) -> Material {
    Material::two_sided("paint", Finish::diffuse(Rgb::grey(reflectance)))
}

/// A floor in the open and a lamp, with a box of 80 cm whose sides go on for a centimetre below it.
fn box_in_a_floor() -> Scene {
    let mut shapes = vec![rectangle([-2.0, -2.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], 0)];
    let up = [0.0, 0.0, 0.8 + SUNK];
    for (corner, along) in [
        ([-0.37, -0.43, -SUNK], [0.8, 0.0, 0.0]),
        ([0.43, -0.43, -SUNK], [0.0, 0.8, 0.0]),
        ([0.43, 0.37, -SUNK], [-0.8, 0.0, 0.0]),
        ([-0.37, 0.37, -SUNK], [0.0, -0.8, 0.0]),
    ] {
        shapes.push(rectangle(corner, along, up, 0));
    }
    shapes.push(rectangle([-0.37, -0.43, 0.8], [0.8, 0.0, 0.0], [0.0, 0.8, 0.0], 0));
    scene(shapes, vec![both_sides(0.6)], vec![isotropic([1.2, -1.1, 1.6], 100.0)])
}

fn solved(scene: &Scene, accuracy: f64) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(accuracy), ..SolveRequest::default() };
    solve(scene, &request, None, &mut |_| Watch::Continue).unwrap().map
}

#[test]
fn sides_of_a_sunk_box_are_read_from_above_the_floor() {
    let scene = box_in_a_floor();
    let map = solved(&scene, 0.05);
    let below = map.elements.vertices().iter().zip(&map.values);
    let mut count = 0;
    let is_outside = |normal: Vector, at: Point| {
        normal.x * (at.x - 0.03) + normal.y * (at.y + 0.03) > 0.0 && at.z < -0.5 * SUNK
    };
    let is_below = |vertex: &Vertex| is_outside(vertex.normal.to_vector(), vertex.position);
    for (vertex, value) in below.filter(|(vertex, _)| is_below(vertex)) {
        // Corners of the box see nothing but the dark below the floor.
        count += 1;
        assert_ne!(
            value.map(|v| v.standing),
            Some(Standing::Open),
            "{:?} {value:?}",
            vertex.position
        );
    }
    assert!(count > 0, "no vertex lies below the floor");
    // The side towards the lamp, 1 cm above the floor and 20 cm.
    let bare = |z: f64| {
        let at = front_at(&scene, Point::new(0.1, -0.43, z));
        map.interpolate(at.triangle, false, at.u, at.v).expect("it is lit").illuminance_lx()
    };
    let (low, high) = (bare(0.01), bare(0.2));
    // By the distance to the lamp and its angle direct light differs by a sixth.
    assert!(low > 0.7 * high, "{low} {high}");
}

#[test]
fn nothing_is_known_of_the_floor_below_a_box() {
    let scene = box_in_a_floor();
    let map = solved(&scene, 0.05);
    let reader = MapReader::new(&scene, &map);
    let up = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    let read =
        |x: f64, y: f64| reader.probe(ProbePoint { position: Point::new(x, y, 0.0), normal: up });
    for along in [-0.3, 0.0, 0.3] {
        for inside in [0.005, 0.02, 0.1] {
            let hidden = read(along, -0.43 + inside);
            assert!(hidden.is_none(), "{along} {inside}: {hidden:?}");
            assert!(read(along, -0.43 - inside).is_some_and(|v| v.illuminance_lx() > 1.0));
        }
    }
}

#[test]
fn check_points_judge_cut_elements_as_rays_read_them() {
    let rays_only = |scene: &Scene| {
        let lighting = Lighting::new(scene);
        let plan = pilot(scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
        let checks = check_points::draw(&plan, 8, Key::new(2));
        check_points::places(&checks, true) - 2 * checks.len()
    };
    let lamps = || vec![isotropic([0.7, 1.0, 1.5], 100.0), isotropic([2.2, 1.0, 1.5], 1.0)];
    let room = || inward_box([3.0, 2.0, 2.5], 0);
    let mut parted = room();
    parted.push(rectangle([1.37, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.5], 0));
    let scene = |shapes: Vec<Shape>| scene(shapes, vec![painted(Rgb::grey(0.6))], lamps());
    assert!(rays_only(&scene(parted)) > 0, "no element is cut");
    assert_eq!(rays_only(&scene(room())), 0);
}

#[test]
fn what_an_earlier_pilot_found_unlit_is_not_asked_again_and_changes_nothing() {
    let scene = box_in_a_floor();
    let lighting = Lighting::new(&scene);
    let plan = |unlit: &Unlit| pilot(&scene, &lighting, &usual_request(), unlit, &mut |_| true);
    let first = plan(&Unlit::default());
    let second = plan(&first.unlit);
    let [found, found_again] = [&first.unlit.0, &second.unlit.0];
    assert!(found.values().any(|&places| places != 0), "all that is hidden sees light");
    assert_eq!(found, found_again);
    assert_eq!(first.mesh.elements, second.mesh.elements);
    assert_eq!(first.light.direct, second.light.direct);
    assert_eq!(first.mesh.standings, second.mesh.standings);
}

/// Two rooms whose floors, ceilings and side walls end at the sheet between them.
#[test]
fn a_sheet_on_the_edges_of_two_rooms_parts_them() {
    let (width, depth, height) = (1.5, 2.0, 2.5);
    let mut shapes = Vec::new();
    for x in [0.0, width] {
        let (u, v, w) = ([width, 0.0, 0.0], [0.0, depth, 0.0], [0.0, 0.0, height]);
        shapes.push(rectangle([x, 0.0, 0.0], u, v, 0));
        shapes.push(rectangle([x, 0.0, height], v, u, 0));
        shapes.push(rectangle([x, 0.0, 0.0], w, u, 0));
        shapes.push(rectangle([x, depth, 0.0], u, w, 0));
    }
    for x in [0.0, width, 2.0 * width] {
        shapes.push(rectangle([x, 0.0, 0.0], [0.0, depth, 0.0], [0.0, 0.0, height], 0));
    }
    let lamp = isotropic([0.7, 1.0, 1.5], 100.0);
    let scene = scene(shapes, vec![both_sides(0.7)], vec![lamp]);
    let map = solved(&scene, 0.02);
    // In the middle of the floor beyond no light is read, wherever vertices lie.
    for (x, y) in [(width + 0.02, 0.5), (width + 0.1, 1.3), (width + 0.7, 1.0)] {
        let at = front_at(&scene, Point::new(x, y, 0.0));
        let read = map.interpolate(at.triangle, false, at.u, at.v);
        assert!(read.is_none_or(|read| read.illuminance_lx() == 0.0), "{x} {y}: {read:?}");
    }
    let at = front_at(&scene, Point::new(width - 0.02, 0.5, 0.0));
    assert!(
        map.interpolate(at.triangle, false, at.u, at.v).is_some_and(|v| v.illuminance_lx() > 1.0)
    );
}

/// A closed room of 4 x 4 x 3 m with a lamp of 300 cd, below the ground beside a yard of so many metres in the sun.
fn room_and_yard(yard_m: f64) -> Scene {
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    shapes.push(rectangle([10.0, 0.0, 0.0], [yard_m, 0.0, 0.0], [0.0, yard_m, 0.0], 1));
    let mut lamps = vec![isotropic([2.0, 2.0, 1.5], 300.0)];
    for k in 0..9 {
        let at = |k: usize| yard_m * (k as f64 + 0.5) / 3.0;
        lamps.push(isotropic([10.0 + at(k % 3), at(k / 3), 30.0], 3e7));
    }
    scene(shapes, vec![painted(Rgb::grey(0.7)), painted(Rgb::grey(0.2))], lamps)
}

#[test]
fn a_dim_room_beside_a_bright_yard_keeps_its_light() {
    let scene = room_and_yard(100.0);
    let map = solved(&scene, 0.01);
    let vertices = map.elements.vertices().iter().zip(&map.values);
    let in_room = vertices.filter(|(vertex, _)| vertex.position.x < 5.0);
    let (mut area_m2, mut flux_lm) = (0.0, 0.0);
    for (vertex, value) in in_room {
        area_m2 += vertex.area_m2;
        flux_lm += vertex.area_m2 * value.expect("it is lit").illuminance_lx();
    }
    assert!((area_m2 - 80.0).abs() < 1e-6, "{area_m2}");
    // What comes in is absorbed.
    let expected = 4.0 * std::f64::consts::PI * 300.0 / 0.3;
    // Errors are told relative to light a hundred times as bright; with two elements a wall a tenth was missing.
    assert!((flux_lm / expected - 1.0).abs() < 0.03, "{} of what there is", flux_lm / expected);
}
