//! Places that light cannot reach, and sheets that it reaches from both sides.

use crate::rooms::{clear_glass, inward_box, lamp, outward_box, painted, rectangle, scene};
use crate::runs::{METHODS, assert_valid, run};
use isolux::elements::Vertex;
use isolux::engine::{ExactSettings, MapReader, ProbePoint, SolveRequest};
use isolux::geometry::{Normal, Point, Ray, Vector};
use isolux::map::{Illuminance, IlluminationMap, Method};
use isolux::scene::{Finish, Material, Scene};
use isolux::units::Rgb;

/// A closed box from (1.1, 1.1, 0) to (2.3, 2.3, 1), on the floor of a room.
const FOOT: [f64; 2] = [1.1, 2.3];

fn standing(material: Material) -> Scene {
    let mut shapes = inward_box([0.0; 3], [4.0, 4.0, 3.0], 0);
    shapes.extend(outward_box([FOOT[0], FOOT[0], 0.0], [FOOT[1], FOOT[1], 1.0], 1));
    scene(shapes, vec![painted(0.5), material], vec![lamp([3.0, 3.0, 2.5], 1000.0)])
}

fn map(scene: &Scene, method: Method) -> IlluminationMap {
    let request = SolveRequest { method, accuracy: Some(0.02), ..SolveRequest::default() };
    let map = run(scene, &request, 10).expect("the scene has light").map;
    assert_valid("hidden", &map);
    map
}

fn is_under_box(vertex: &Vertex) -> bool {
    let within = |c: f64| c > FOOT[0] + 1e-3 && c < FOOT[1] - 1e-3;
    let p = vertex.position;
    p.z == 0.0 && vertex.normal == Normal::Z && within(p.x) && within(p.y)
}

fn check_unknown_under(box_of: Material) {
    let scene = standing(box_of);
    for method in METHODS {
        let map = map(&scene, method);
        let under = map.elements.vertices().iter().zip(&map.values);
        let under: Vec<_> = under.filter(|(v, _)| is_under_box(v)).collect();
        assert!(under.len() >= 9, "the mesh is too coarse to tell: {}", under.len());
        let known = under.iter().filter(|(_, value)| value.is_some()).count();
        assert_eq!(known, 0, "{method:?}: of {}", under.len());
    }
}

#[test]
fn the_floor_under_a_box_is_unknown() {
    check_unknown_under(painted(0.5));
}

#[test]
fn the_floor_under_a_box_painted_inside_is_unknown() {
    check_unknown_under(painted_inside());
}

fn painted_inside() -> Material {
    Material::two_sided("painted", Finish::diffuse(Rgb::grey(0.5)))
}

fn at_floor(scene: &Scene, map: &IlluminationMap, x: f64, y: f64) -> Illuminance {
    let down = Ray::new(Point::new(x, y, 0.01), -Normal::Z.to_direction());
    let hit = scene.bvh().closest_hit(&down).expect("a floor");
    map.interpolate(hit.triangle, hit.back, f64::from(hit.u), f64::from(hit.v)).expect("known")
}

/// On the lit side of the box, from the foot on: gathered afresh and as the map has it.
fn check_beside(box_of: Material) {
    let scene = standing(box_of);
    let map = map(&scene, Method::Hybrid);
    let reader = MapReader::new(&scene, &map);
    for (y, distance) in
        [(1.4, 0.005), (1.7, 0.005), (1.7, 0.02), (2.0, 0.05), (1.7, 0.1), (1.4, 0.2)]
    {
        let (x, read) = (FOOT[1] + distance, at_floor(&scene, &map, FOOT[1] + distance, y));
        let place = ProbePoint { position: Point::new(x, y, 0.0), normal: Normal::Z };
        let exact = reader.estimate(place, &ExactSettings::default());
        let (read_lx, exact_lx) = (read.illuminance_lx(), exact.illuminance_lx());
        // Five standard errors of vertices, and three times the error the map is made for: places
        // by a contact are its worst.
        let error = libm::hypot(read.standard_error_lx, exact.standard_error_lx);
        assert!(
            (read_lx - exact_lx).abs() < 5.0 * error + 0.06 * exact_lx,
            "{distance} m from the foot: {read_lx} for {exact_lx} +- {error}"
        );
    }
}

#[test]
fn the_floor_beside_a_box_is_not_darkened() {
    check_beside(painted(0.5));
}

#[test]
fn the_floor_beside_a_box_painted_inside_is_not_darkened() {
    check_beside(painted_inside());
}

/// A cabinet on the wall at y = 8: a back panel 4 cm before the wall, and boards of 3 cm that run
/// through it to the wall every 30 cm both ways. The first bisections of the panel, 1.2 m a side, to
/// the half metre of elements in such a room have all their vertices in wood. A pane closes it.
fn cabinet() -> Scene {
    let mut shapes = inward_box([0.0; 3], [8.0, 8.0, 3.0], 0);
    shapes.push(rectangle([1.0, 7.96, 0.5], [1.2, 0.0, 0.0], [0.0, 0.0, 1.2], 0));
    let mut board = |low: [f64; 2], high: [f64; 2]| {
        let (low, high) = ([low[0], 7.7, low[1]], [high[0], 8.0, high[1]]);
        shapes.extend(outward_box(low, high, 0));
    };
    for at in [0.0, 0.3, 0.6, 0.9, 1.2] {
        board([0.985, 0.485 + at], [2.215, 0.515 + at]);
        board([0.985 + at, 0.485], [1.015 + at, 1.715]);
    }
    shapes.push(rectangle([1.0, 7.71, 0.5], [1.2, 0.0, 0.0], [0.0, 0.0, 1.2], 1));
    let materials = vec![painted(0.5), clear_glass(1.5, true)];
    scene(shapes, materials, vec![lamp([2.0, 5.0, 2.9], 1000.0)])
}

#[test]
fn the_back_of_a_cabinet_is_lit_between_its_boards() {
    let scene = cabinet();
    let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
    let map = run(&scene, &request, 10).expect("the scene has light").map;
    let reader = MapReader::new(&scene, &map);
    for (x, z) in [(1.15, 0.65), (1.45, 0.95), (1.75, 1.25), (1.45, 0.65)] {
        let normal = Vector::new(0.0, -1.0, 0.0).normal().expect("a direction");
        let place = ProbePoint { position: Point::new(x, 7.96, z), normal };
        let exact = reader.estimate(place, &ExactSettings::default());
        let read = reader.probe(place).expect("known");
        let (read_lx, exact_lx) = (read.indirect_lx.luminance(), exact.indirect_lx.luminance());
        // Compartments that the lamp does not shine into, on a mesh for five per cent of the whole scene.
        assert!((read_lx / exact_lx - 1.0).abs() < 0.3, "{x} {z}: {read_lx} for {exact_lx}");
    }
}

#[test]
fn both_sides_of_a_sheet_have_their_own_light() {
    let sheet = Material::two_sided("sheet", Finish::diffuse(Rgb::grey(0.3)));
    let shapes = vec![rectangle([-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 0)];
    let lamps = vec![lamp([0.0, 0.0, 1.0], 100.0), lamp([0.0, 0.0, -2.0], 100.0)];
    let scene = scene(shapes, vec![sheet], lamps);
    for method in METHODS {
        let map = map(&scene, method);
        let mean = |up: bool| {
            let side = |v: &Vertex| (v.normal.to_vector().z > 0.0) == up;
            let values = map.elements.vertices().iter().zip(&map.values);
            let near = |v: &Vertex| v.position.x.abs() < 0.2 && v.position.y.abs() < 0.2;
            let lx: Vec<f64> = values
                .filter(|(v, _)| side(v) && near(v))
                .map(|(_, value)| value.expect("both sides are lit").illuminance_lx())
                .collect();
            lx.iter().sum::<f64>() / lx.len() as f64
        };
        // Within 20 cm of the middle, by the inverse square and the cosine: 0.92 to 1 of the peak; and the noise
        // of particles.
        let (above, below) = (mean(true), mean(false));
        assert!(above > 90.0 && above < 103.0, "{method:?}: {above} lx above");
        assert!(below > 23.0 && below < 26.5, "{method:?}: {below} lx below");
    }
}
