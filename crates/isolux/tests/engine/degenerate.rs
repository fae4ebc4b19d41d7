//! Scenes at the edge of sense: a map or a refusal, in time, without panic.

use crate::rooms::{
    clear_glass, glowing, inward_box, lamp, mirror, outward_box, painted, rectangle, scene,
};
use crate::runs::{METHODS, assert_valid, coarse, ends, run};
use isolux::engine::{MapReader, ProbePoint, SolveError};
use isolux::geometry::{Normal, Point};
use isolux::map::{IlluminationMap, Method, Provenance};
use isolux::scene::{Finish, Luminaire, LuminaireKind, Material, Scene, Shape};
use isolux::units::Rgb;

fn floor(size: f64) -> Shape {
    rectangle([0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], 0)
}

fn lit(shapes: Vec<Shape>, position: [f64; 3]) -> Scene {
    scene(shapes, vec![painted(0.5), glowing(10.0, 0.5)], vec![lamp(position, 100.0)])
}

fn one_triangle(corners: [[f64; 3]; 3]) -> Vec<Shape> {
    let shape = Shape { positions: corners.to_vec(), triangles: vec![[0, 1, 2]], ..floor(1.0) };
    vec![shape]
}

fn room_of(size: f64, at: f64) -> Scene {
    let shapes = inward_box([at; 3], [at + size; 3], 0);
    lit(shapes, [at + 0.4 * size, at + 0.5 * size, at + 0.6 * size])
}

fn parallel(direction: [f64; 3]) -> Scene {
    let direction = isolux::geometry::Vector::from(direction).direction().expect("a direction");
    let sun = Luminaire {
        kind: LuminaireKind::Directional { direction, illuminance_lx: 1e5, half_angle_rad: 0.0 },
        ..lamp([0.0; 3], 0.0)
    };
    scene(vec![floor(1.0)], vec![painted(0.5)], vec![sun])
}

#[expect(clippy::too_many_lines, reason = "a table")]
fn table() -> Vec<(&'static str, Scene)> {
    let up = [0.3, 0.3, 1.0];
    let twice = || vec![floor(1.0), floor(1.0)];
    let facing_itself = {
        let mut back = floor(1.0);
        back.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        vec![floor(1.0), back]
    };
    let flat = Shape {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ..floor(1.0)
    };
    let panel_on_floor = rectangle([0.2, 0.2, 0.0], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0], 1);
    let pressed = {
        let mut panel = panel_on_floor.clone();
        panel.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        panel
    };
    vec![
        ("one triangle", lit(one_triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), up)),
        ("a sliver", lit(one_triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.5, 1e-5, 0.0]]), up)),
        ("one real and one flat triangle", lit(vec![flat], up)),
        ("coincident triangles", lit(twice(), up)),
        ("coincident triangles back to back", lit(facing_itself, up)),
        ("a room of a millimetre", room_of(1e-3, 0.0)),
        ("a room of ten kilometres", room_of(1e4, 0.0)),
        ("a room ten kilometres away", room_of(1.0, 1e4)),
        ("a room so far that its coordinates are rounded to a sixteenth", room_of(1.0, 1e6)),
        ("a lamp on the floor", lit(vec![floor(1.0)], [0.5, 0.5, 0.0])),
        ("a lamp at a vertex", lit(vec![floor(1.0)], [0.0; 3])),
        ("a lamp a nanometre above", lit(vec![floor(1.0)], [0.5, 0.5, 1e-9])),
        ("a lamp outside the room", lit(inward_box([0.0; 3], [1.0; 3], 0), [2.0, 0.5, 0.5])),
        ("a lamp behind the floor", lit(vec![floor(1.0)], [0.5, 0.5, -1.0])),
        ("a lamp far away", lit(vec![floor(1.0)], [0.0, 0.0, 1e7])),
        (
            "two lamps in one place",
            scene(vec![floor(1.0)], vec![painted(0.5)], vec![lamp(up, 1.0); 2]),
        ),
        ("a panel in the floor", lit(vec![floor(1.0), panel_on_floor], up)),
        ("a panel pressed on the floor", lit(vec![floor(1.0), pressed], up)),
        ("parallel light from above", parallel([0.0, 0.0, -1.0])),
        ("parallel light along the floor", parallel([1.0, 0.0, 0.0])),
        ("parallel light from below", parallel([0.0, 0.0, 1.0])),
        ("white walls", scene(vec![floor(1.0)], vec![painted(1.0)], vec![lamp(up, 1.0)])),
        (
            "black walls",
            scene(inward_box([0.0; 3], [1.0; 3], 0), vec![painted(0.0)], vec![lamp([0.5; 3], 1.0)]),
        ),
        ("the faintest light", scene(vec![floor(1.0)], vec![painted(0.5)], vec![lamp(up, 1e-300)])),
        ("the brightest light", scene(vec![floor(1.0)], vec![painted(0.5)], vec![lamp(up, 1e100)])),
        ("a mirror on the floor", {
            let sheet = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 1);
            scene(vec![floor(1.0), sheet], vec![painted(0.5), mirror(0.9)], vec![lamp(up, 1.0)])
        }),
        ("a pane on the floor", {
            let sheet = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 1);
            scene(
                vec![floor(1.0), sheet],
                vec![painted(0.5), clear_glass(1.5, true)],
                vec![lamp(up, 1.0)],
            )
        }),
    ]
}

#[test]
fn every_scene_ends_in_a_map() {
    for (name, scene) in table() {
        for method in METHODS {
            let map = run(&scene, &coarse(method, 150), 9).expect(name).map;
            assert_valid(&format!("{name}, {method:?}"), &map);
        }
    }
}

/// Half of the light of a lamp in a corner falls on a spot that no element resolves: a map with more light than there may be is refused.
#[test]
fn a_lamp_in_a_corner_ends_in_a_map_that_energy_allows_or_in_none() {
    let scene = lit(inward_box([0.0; 3], [1.0; 3], 0), [0.0; 3]);
    for method in METHODS {
        match run(&scene, &coarse(method, 150), 9) {
            Ok(solution) => assert_valid(&format!("{method:?}"), &solution.map),
            Err(SolveError::MoreThanEnergy { .. }) => {}
            Err(error) => panic!("{method:?}: {error}"),
        }
    }
}

#[test]
fn every_map_can_be_read_anywhere() {
    for (name, scene) in table() {
        let map = run(&scene, &coarse(Method::Hybrid, 150), 9).expect(name).map;
        let reader = MapReader::new(&scene, &map);
        let corners = scene.triangle(0).corners;
        for position in [
            corners[0],
            corners[0].lerp(corners[1], 0.5),
            scene.triangle(0).centroid(),
            Point::ORIGIN,
        ] {
            let place = ProbePoint { position, normal: scene.geometric_normal(0) };
            let turned = ProbePoint { normal: -Normal::Z, ..place };
            let read = reader.probe(place);
            assert!(read.is_none_or(|v| v.illuminance_lx().is_finite()), "{name}");
            reader.probe(turned);
        }
    }
}

#[test]
fn size_changes_light_by_the_inverse_square_alone() {
    let mean = |size: f64| {
        let map = run(&room_of(size, 0.0), &coarse(Method::Hybrid, 150), 16).expect("a map").map;
        let lx = map.values.iter().flatten().map(|v| v.illuminance_lx());
        lx.sum::<f64>() / map.values.len() as f64 * size * size
    };
    let one = mean(1.0);
    for size in [1e-3, 1e4] {
        // The same rays but for the rounding of coordinates, which sends a few elsewhere.
        assert!((mean(size) / one - 1.0).abs() < 2e-3, "{size}: {} {one}", mean(size));
    }
}

/// Maps by every method of a scene.
fn solved(make: fn() -> Scene) -> Vec<IlluminationMap> {
    let one = |method: Method| {
        // On threads of their own, which a run that does not end keeps to itself.
        let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let solve = move || threads.install(|| run(&make(), &coarse(method, 150), 9));
        let solution = ends(solve);
        solution.unwrap_or_else(|| panic!("{method:?} does not end")).expect("a map").map
    };
    METHODS.into_iter().map(one).collect()
}

/// The same, where so much light is given up that nothing is known.
fn check_given_up(make: fn() -> Scene) {
    for map in solved(make) {
        let Provenance { method, accuracy, complete, .. } = map.provenance;
        assert!(accuracy.is_none() && !complete, "{method:?}: {accuracy:?}");
    }
}

fn mirror_box() -> Scene {
    let mut shapes = inward_box([0.0; 3], [1.0; 3], 1);
    shapes.push(rectangle([-1.0, -1.0, -1.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], 0));
    scene(shapes, vec![painted(0.5), mirror(1.0)], vec![lamp([0.4, 0.5, 0.6], 100.0)])
}

#[test]

fn light_shut_in_by_ideal_mirrors_is_given_up() {
    check_given_up(mirror_box);
}

fn lamp_in_glass() -> Scene {
    let mut shapes = outward_box([0.0; 3], [1.0; 3], 1);
    shapes.push(rectangle([-1.0, -1.0, -1.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], 0));
    scene(shapes, vec![painted(0.5), clear_glass(1.5, false)], vec![lamp([0.4, 0.5, 0.6], 100.0)])
}

#[test]

fn light_caught_in_glass_is_given_up() {
    for map in solved(lamp_in_glass) {
        // Total reflection beyond 41.8 degrees keeps 1 - 3 (1 - cos 41.8) of all rays: a quarter.
        assert!(map.provenance.accuracy.is_none_or(|a| a.bias > 0.1), "{:?}", map.provenance);
    }
}

fn white_box() -> Scene {
    let white = Material::one_sided("white", Finish::diffuse(Rgb::WHITE));
    scene(inward_box([0.0; 3], [1.0; 3], 0), vec![white], vec![lamp([0.4, 0.5, 0.6], 100.0)])
}

#[test]

fn light_shut_in_by_white_walls_is_given_up() {
    check_given_up(white_box);
}
