//! Where readers gather, and where they take the map's word.

use crate::rooms::{inward_box, lamp, outward_box, painted, scene};
use crate::runs::run;
use isolux::engine::{ExactSettings, MapReader, ProbePoint, SolveRequest};
use isolux::geometry::{Normal, Point};
use isolux::map::{Illuminance, IlluminationMap};
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

/// Two rooms alike that see nothing of each other, the second with a ten-millionth of the light of the first, and a third without any.
fn rooms_apart() -> Scene {
    let shapes = [0.0, 10.0, 20.0].map(|x| inward_box([x, 0.0, 0.0], [x + 4.0, 5.0, 3.0], 0));
    let lamps = vec![lamp([2.0, 2.0, 2.0], 1e7), lamp([12.0, 2.0, 2.0], 1.0)];
    scene(shapes.into_iter().flatten().collect(), vec![painted(0.7)], lamps)
}

/// Errors are those of the light of a room: it has the values of the bright one, and errors like it.
#[test]
fn a_dim_room_has_errors_of_its_own() {
    let scene = rooms_apart();
    let map = map(&scene, 0.01);
    let reader = MapReader::new(&scene, &map);
    let exact = |at| reader.estimate(at, &ExactSettings::default());
    let on_floor = [(2.5, 1.2), (0.05, 0.05), (3.9, 4.9), (1.0, 1.0), (2.0, 4.0)];
    let (mut worst, mut outside) = (0.0_f64, 0);
    for (x, y) in on_floor {
        let place = |x| ProbePoint { position: Point::new(x, y, 0.0), normal: Normal::Z };
        let [bright, dim, dark] = [0.0, 10.0, 20.0].map(|off| place(x + off));
        let probed = |at| reader.probe(at).expect("it is on a lit floor");
        for read in [&probed as &dyn Fn(_) -> Illuminance, &exact] {
            let [bright, dim] = [bright, dim].map(read);
            let [bright_lx, dim_lx] = [bright, dim].map(|read| read.illuminance_lx());
            let told = [bright, dim].map(|read| read.standard_error_lx);
            let error_lx = (1e-7 * told[0]).hypot(told[1]);
            outside += usize::from((dim_lx - 1e-7 * bright_lx).abs() > 1.96 * error_lx);
            worst = worst.max(told[1] / dim_lx).max(told[0] / bright_lx);
        }
        // No way leads there: the map has no light for it, and an estimate no error.
        assert!(reader.probe(dark).is_none_or(|dark| dark.standard_error_lx == 0.0));
        let dark = exact(dark);
        assert_eq!([dark.illuminance_lx(), dark.standard_error_lx], [0.0; 2], "{dark:?}");
    }
    // Of ten intervals of 95 % more than two miss once in ninety times (binomial).
    assert!(outside <= 2, "{outside} of 10 intervals do not hold the light of the bright room");
    // Of a scene that errs by 1 % single places, in corners with half of its light, err by a few times as much.
    assert!(worst < 0.05, "told to err by {worst} of the light there");
}
