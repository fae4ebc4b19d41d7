//! Sheets that stand across elements.

use super::*;
use crate::elements::Vertex;
use crate::engine::gather::{Unlit, known_at, known_on_side};
use crate::engine::light::Lighting;
use crate::engine::occlusion::{Barriers, Side};
use crate::engine::pilot::pilot;
use crate::engine::ray::ProbePoint;
use crate::engine::read::{ExactSettings, MapReader};
use crate::engine::{SolveRequest, Watch, solve};
use crate::map::Method;
use crate::scene::{Body, Dielectric};

/// Where no vertices are, and where bisection of rooms 3 m long makes them.
const SHEET_X: f64 = 1.37;
const MIDDLE_X: f64 = 1.5;

/// Two rooms that share floor, ceiling and walls, parted by a sheet of so much height.
fn rooms(sheet_x: f64, height: f64) -> Scene {
    parted(sheet_x, height, painted(Rgb::grey(0.6)))
}

fn parted(sheet_x: f64, height: f64, sheet: Material) -> Scene {
    let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
    shapes.push(rectangle([sheet_x, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, height], 1));
    let lamps = vec![isotropic([0.7, 1.0, 1.5], 100.0), isotropic([2.2, 1.0, 1.5], 1.0)];
    scene(shapes, vec![painted(Rgb::grey(0.6)), sheet], lamps)
}

/// Of places of the floor within 10 cm of the sheet, how many read vertices on or beyond it.
fn reading_beyond(scene: &Scene, sheet_x: f64) -> usize {
    let lighting = Lighting::new(scene);
    let plan = pilot(scene, &lighting, &usual_request(), &Unlit::default(), &mut |_| true);
    let key = Key::new(9);
    let reads_beyond = |k: &u64| {
        let [x, y] = [0, 1].map(|n| key.with(2 * k + n).uniform());
        let at = Point::new(sheet_x - 0.1 + 0.2 * x, 0.1 + 1.8 * y, 0.0);
        let surface = front_at(scene, at);
        let SurfacePoint { triangle, u, v, .. } = surface;
        let place =
            plan.mesh.elements.place(plan.mesh.level, triangle, false, [u, v]).expect("it is lit");
        let corners = plan.mesh.elements.corners(place);
        // As rays read it.
        let one_side = |cut| known_on_side(corners, &plan.mesh.standings, cut);
        let read = plan.mesh.cuts.of_node(place.node()).and_then(one_side);
        let read = read.or_else(|| {
            known_at(&plan.mesh.elements, plan.mesh.level, &plan.mesh.standings, &surface)
        });
        let read = read.expect("it is lit");
        let beyond = |&(vertex, weight): &(u32, f64)| {
            let of = plan.mesh.elements.vertices()[vertex as usize].position;
            weight > 0.0 && (of.x - sheet_x) * (at.x - sheet_x) <= 0.0
        };
        read.iter().any(beyond)
    };
    (0..400).filter(reads_beyond).count()
}

#[test]
fn nobody_reads_what_lies_beyond_a_sheet() {
    // The corners of elements that touch a wall are blocked there by it, too: a few are not told.
    let beyond = reading_beyond(&rooms(SHEET_X, 2.5), SHEET_X);
    assert!(beyond <= 8, "{beyond} of 400");
    // What lies on the floor does not part light.
    let low = reading_beyond(&rooms(SHEET_X, 0.01), SHEET_X);
    assert!(low > 100, "{low} of 400");
}

#[test]
fn nobody_reads_vertices_that_a_sheet_stands_on() {
    let beyond = reading_beyond(&rooms(MIDDLE_X, 2.5), MIDDLE_X);
    assert_eq!(beyond, 0, "of 400");
    let low = reading_beyond(&rooms(MIDDLE_X, 0.01), MIDDLE_X);
    assert!(low > 100, "{low} of 400");
}

#[test]
fn no_light_is_read_where_nothing_is_known_beyond_a_sheet() {
    for x in [SHEET_X, MIDDLE_X] {
        let mut shapes = inward_box([3.0, 2.0, 2.5], 0);
        shapes.push(rectangle([x, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.5], 1));
        let paint = || painted(Rgb::grey(0.8));
        let lamp = isotropic([0.7, 1.0, 1.5], 100.0);
        let scene = scene(shapes, vec![paint(), paint()], vec![lamp]);
        let map =
            solve(&scene, &SolveRequest::default(), None, &mut |_| Watch::Continue).unwrap().map;
        let reader = MapReader::new(&scene, &map);
        for at in [[x + 0.1, 0.5, 0.0], [x + 0.4, 1.3, 0.0], [2.6, 1.0, 0.0]] {
            let normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
            let at = ProbePoint { position: Point::from(at), normal };
            let read = reader.estimate(at, &ExactSettings::default());
            assert_eq!(read.indirect_lx, Rgb::BLACK, "{x}: {at:?}");
        }
    }
}

/// Its sides stand where bisection makes vertices of the floor.
#[test]
fn no_light_comes_into_a_block_that_stands_on_vertices() {
    let mut shapes = inward_box([4.0, 4.0, 3.0], 0);
    let up = [0.0, 0.0, 1.5];
    for (corner, along) in [
        ([1.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        ([2.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
        ([2.0, 2.0, 0.0], [-1.0, 0.0, 0.0]),
        ([1.0, 2.0, 0.0], [0.0, -1.0, 0.0]),
    ] {
        shapes.push(rectangle(corner, along, up, 0));
    }
    shapes.push(rectangle([1.0, 1.0, 1.5], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0));
    let paint = Material::two_sided("paint", Finish::diffuse(Rgb::grey(0.8)));
    let scene = scene(shapes, vec![paint], vec![isotropic([3.2, 2.0, 2.8], 400.0)]);
    for method in [Method::Hybrid, Method::Radiosity] {
        let request = SolveRequest { method, accuracy: Some(0.05), ..SolveRequest::default() };
        let map = solve(&scene, &request, None, &mut |_| Watch::Continue).unwrap().map;
        let within = |p: Point| [p.x, p.y].iter().all(|&c| c > 1.0 && c < 2.0) && p.z < 1.5;
        let vertices = map.elements.vertices().iter().zip(&map.values);
        let is_inside = |v: &Vertex| within(v.position) && v.normal.to_vector().z > 0.0;
        let inside = vertices.filter(|(vertex, _)| is_inside(vertex));
        let (count, lit) = inside.fold((0, 0), |(count, lit), (_, value)| {
            (count + 1, lit + usize::from(value.is_some()))
        });
        assert!(count > 0, "{method:?}: no vertex lies inside");
        assert_eq!(lit, 0, "{method:?}: of {count} inside");
    }
}

#[test]
fn panes_part_light() {
    let glass = Dielectric { ior: 1.5, transmittance: Rgb::grey(0.5), thin: true };
    let pane = || Material { name: "pane".into(), body: Body::Dielectric(glass) };
    for x in [SHEET_X, MIDDLE_X] {
        let beyond = reading_beyond(&parted(x, 2.5, pane()), x);
        assert!(beyond <= 8, "{beyond} of 400 at {x}");
    }
}

#[test]
fn a_corner_is_told_from_the_others_by_the_line_between() {
    let scene = rooms(SHEET_X, 2.5);
    let mut subdivision = crate::elements::Subdivision::new(&scene);
    subdivision.bisect_to(0.5, usize::MAX);
    let elements = subdivision.elements();
    let sides: Vec<Side> = Side::of_all(&elements).collect();
    // Bright on one side.
    let is_there = |v: &crate::elements::Vertex| v.position.x < SHEET_X;
    let light: Vec<Rgb> =
        elements.vertices().iter().map(|v| Rgb::grey(f64::from(is_there(v)))).collect();
    let cuts = Barriers::of_map(&scene, &elements, &light);
    let (mut cut, mut crossed) = (0, 0);
    for side in &sides {
        let corners = elements.node(side.node).vertices;
        let xs = corners.map(|v| elements.vertices()[v as usize].position.x);
        let z = corners.map(|v| elements.vertices()[v as usize].position.z);
        crossed += usize::from(
            z == [0.0; 3] && xs.iter().any(|&x| x < SHEET_X) && xs.iter().any(|&x| x > SHEET_X),
        );
        let Some(of) = cuts.of_node(side.node) else { continue };
        cut += usize::from(z == [0.0; 3]);
        for weights in [[0.8, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.8], [0.2, 0.4, 0.4]] {
            let x: f64 = weights.iter().zip(xs).map(|(w, x)| w * x).sum();
            let own = of.side(weights);
            for k in 0..3 {
                assert_eq!(own[k], (xs[k] < SHEET_X) == (x < SHEET_X), "{xs:?} {weights:?}");
            }
        }
    }
    assert!(cut > 3 && cut <= crossed, "{cut} of {crossed}");
}
