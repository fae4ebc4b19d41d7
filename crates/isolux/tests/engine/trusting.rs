//! Where readers gather, and where they take the map's word.

use crate::rooms::{inward_box, lamp, outward_box, painted, scene};
use crate::runs::run;
use isolux::engine::{MapReader, ProbePoint, SolveRequest};
use isolux::geometry::{Normal, Point};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;

/// A room with a box in it.
fn room(reflectance: f64) -> Scene {
    let mut shapes = inward_box([0.0; 3], [4.0, 5.0, 3.0], 0);
    shapes.extend(outward_box([1.0, 1.0, 0.0], [2.0, 1.6, 0.7], 0));
    scene(shapes, vec![painted(reflectance)], vec![lamp([2.0, 2.5, 1.5], 500.0)])
}

fn map(scene: &Scene, accuracy: f64) -> IlluminationMap {
    let request = SolveRequest { accuracy: Some(accuracy), ..SolveRequest::default() };
    let map = run(scene, &request, 40).expect("the scene has light").map;
    assert!(map.provenance.complete, "{:?}", map.provenance);
    map
}

fn gathers_in_gaps_alone(map: &IlluminationMap) -> bool {
    map.provenance.fresh.expect("it is told where to gather").in_gaps_alone
}

/// Indirect light of the floor 10 cm from the box: as read, and as interpolated.
fn at_the_box(scene: &Scene, map: &IlluminationMap) -> [f64; 2] {
    let reader = MapReader::new(scene, map);
    let at = ProbePoint { position: Point::new(1.5, 0.9, 0.0), normal: Normal::Z };
    let both = [reader.probe(at), reader.interpolated(at)];
    both.map(|value| value.expect("it is on the floor").indirect_lx.luminance())
}

/// Between dark walls indirect light is a fiftieth of all: interpolated it is off by far less than noise.
#[test]
fn between_dark_walls_nothing_is_gathered() {
    let scene = room(0.05);
    let map = map(&scene, 0.02);
    assert!(gathers_in_gaps_alone(&map), "{:?}", map.provenance);
    let [read, interpolated] = at_the_box(&scene, &map);
    assert!(read > 0.0 && read == interpolated, "{read} {interpolated}");
}

/// Between bright walls most of the error lies at edges and at what stands about.
#[test]
fn at_what_stands_between_bright_walls_light_is_gathered() {
    let scene = room(0.8);
    let map = map(&scene, 0.02);
    assert!(!gathers_in_gaps_alone(&map), "{:?}", map.provenance);
    let [read, interpolated] = at_the_box(&scene, &map);
    assert!(read > 0.0 && read != interpolated, "{read} {interpolated}");
}
