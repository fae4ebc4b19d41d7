//! Beneath a rug a centimetre above the floor: next to no light, and never less than none.

use crate::rooms::{inward_box, lamp, rectangle, scene};
use crate::runs::run;
use isolux::engine::{MapReader, ProbePoint, SolveRequest};
use isolux::geometry::{Normal, Point};
use isolux::map::Method;
use isolux::scene::{Finish, Material, Scene};
use isolux::units::Rgb;
use std::f64::consts::PI;

/// A room of 4 x 4 x 3 m with a rug of 2 x 2 m in the middle of its floor, and a lamp of 1000 lm under its ceiling.
fn room(lamp_m: f64) -> Scene {
    let mut shapes = inward_box([0.0; 3], [4.0, 4.0, 3.0], 0);
    shapes.push(rectangle([1.0, 1.0, 0.01], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], 1));
    let paint =
        |reflectance: f64| Material::two_sided("paint", Finish::diffuse(Rgb::grey(reflectance)));
    scene(shapes, vec![paint(0.5), paint(0.2)], vec![lamp([2.0, 2.0, lamp_m], 1000.0 / (4.0 * PI))])
}

/// The rug's back is a plane surface, too, and the walls that it hides are none that tell what is seen beneath it.
#[test]
fn no_reading_beneath_a_rug_is_negative() {
    for (lamp_m, method) in [(3.0, Method::Hybrid), (2.5, Method::Hybrid), (2.5, Method::Cache)] {
        let scene = room(lamp_m);
        let request = SolveRequest { method, accuracy: Some(0.02), ..SolveRequest::default() };
        let map = run(&scene, &request, 16).expect("it has light").map;
        let lowest = map
            .values
            .iter()
            .flatten()
            .map(|v| [v.direct_lx, v.caustic_lx, v.indirect_lx].map(Rgb::min_channel));
        assert!(lowest.flatten().all(|lx| lx >= 0.0));
        let reader = MapReader::new(&scene, &map);
        for k in 0..64 {
            let [x, y] = [k % 8, k / 8].map(|k| 0.25 + 0.5 * f64::from(k));
            let at = ProbePoint { position: Point::new(x, y, 0.0), normal: Normal::Z };
            let read = reader.probe(at).expect("it is on the floor");
            assert!(read.indirect_lx.min_channel() >= 0.0, "{at:?}: {read:?}");
            let is_beneath = [x, y].iter().all(|c| (c - 2.0).abs() < 1.0);
            if is_beneath {
                // By complete paths 0.00 to 0.01 lx; what others read is some 20.
                let off_lx = read.illuminance_lx() - 0.01;
                assert!(off_lx <= 3.3 * read.standard_error_lx, "{at:?}: {read:?}");
                // A hundredth of that is known everywhere.
                assert!(read.standard_error_lx < 0.2, "{at:?}: {read:?}");
            }
        }
    }
}
