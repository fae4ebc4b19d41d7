//! Readings in the corners and on the edges of rooms, wherever these stand.

use crate::rooms::{glowing, inward_box, lamp, mirror, painted, rectangle, scene};
use isolux::engine::{
    ExactSettings, MapReader, PathTracer, ProbePoint, SolveRequest, Watch, solve,
};
use isolux::geometry::{Normal, Point, Vector};
use isolux::map::Illuminance;
use isolux::scene::Scene;
use std::f64::consts::PI;

const SIZE: [f64; 3] = [4.0, 5.0, 3.0];

/// Where a room stands and what it is multiplied by: at the origin, beside it, far away, in millimetres and in kilometres.
const STANDS: [(f64, f64); 5] = [(0.0, 1.0), (1.0, 1.0), (1000.0, 1.0), (0.0, 1e-3), (0.0, 1e3)];

/// The corners, the middles of the edges and of the faces of a room, as each of its walls has them.
fn places((at, scale): (f64, f64)) -> Vec<ProbePoint> {
    let mut found = Vec::new();
    for k in 0..27 {
        let third = [k / 9, k / 3 % 3, k % 3];
        let place = [0, 1, 2].map(|axis| at + scale * SIZE[axis] * f64::from(third[axis]) / 2.0);
        for axis in (0..3).filter(|&axis| third[axis] != 1) {
            let mut inwards = [0.0; 3];
            inwards[axis] = f64::from(1 - third[axis]);
            let normal = Vector::from(inwards).normal().expect("an axis");
            found.push(ProbePoint { position: Point::from(place), normal });
        }
    }
    found
}

fn room((at, scale): (f64, f64)) -> Scene {
    // Of 100 lm/m2; reflected nine parts in ten, that is 1000 lx everywhere.
    let high = SIZE.map(|side| at + scale * side);
    scene(inward_box([at; 3], high, 0), vec![glowing(100.0 / PI, 0.9)], vec![])
}

const LX: f64 = 1000.0;

/// Errors that a reading from a few dozen replicates is off by in one of twenty thousand.
const ERRORS: f64 = 4.8;

fn check(what: &str, at: &ProbePoint, reading: &Illuminance) {
    let (found, error) = (reading.illuminance_lx(), reading.standard_error_lx);
    let is_right = (found - LX).abs() < ERRORS * error + 1e-5 * LX;
    assert!(is_right, "{what}: {found} +- {error} at {:?} {:?}", at.position, at.normal);
    // In a wall three quarters of all light are missing: more than so many errors.
    assert!(error < 0.15 * LX, "{what}: {error}");
    let direct_lx = reading.direct_lx.luminance();
    assert!((direct_lx - 100.0).abs() < 1e-3, "{what}: {direct_lx} at {:?}", at.position);
}

#[test]
fn corners_of_an_evenly_lit_room_are_as_bright_as_its_walls() {
    for stand in STANDS {
        let room = room(stand);
        let request = SolveRequest { accuracy: Some(0.02), ..SolveRequest::default() };
        let map = solve(&room, &request, None, &mut |_| Watch::Continue).expect("a map").map;
        let (reader, tracer) = (MapReader::new(&room, &map), PathTracer::new(&room));
        let exact = ExactSettings { rays: 64, replicates: 32, seed: 1 };
        let paths = ExactSettings { rays: 32, replicates: 32, seed: 1 };
        for at in places(stand) {
            let read = reader.probe(at).expect("a reading");
            check(&format!("map at {stand:?}"), &at, &read);
            check(&format!("exact at {stand:?}"), &at, &reader.estimate(at, &exact));
            check(&format!("paths at {stand:?}"), &at, &tracer.estimate(at, &paths));
        }
    }
}

/// So dim that light reflected three times is not followed.
const DIM: f64 = 0.09;

/// Places on rims are moved inwards by 64 roundings of single precision.
const INWARDS: f64 = 64.0 * f32::EPSILON as f64;

#[test]
fn a_floor_between_mirrors_is_lit_by_all_images_up_to_its_corners() {
    for (at, scale) in STANDS {
        let [x, y, z] = SIZE.map(|side| scale * side);
        let mut shapes = inward_box([at; 3], [at + x, at + y, at + z], 1);
        // Without floor and ceiling.
        shapes.retain(|wall| wall.positions.iter().any(|p| p[2] != wall.positions[0][2]));
        shapes.push(rectangle([at; 3], [x, 0.0, 0.0], [0.0, y, 0.0], 0));
        let middle = [at + 0.5 * x, at + 0.5 * y, at + 0.5 * z];
        let cd = 100.0 * scale * scale;
        let room = scene(shapes, vec![painted(0.5), mirror(DIM)], vec![lamp(middle, cd)]);
        let tracer = PathTracer::new(&room);
        let settings = ExactSettings { rays: 1, replicates: 2, seed: 1 };
        for k in 0..9 {
            let [fx, fy] = [k / 3, k % 3].map(|k| f64::from(k) / 2.0);
            let position = Point::new(at + fx * x, at + fy * y, at);
            let read = tracer.estimate(ProbePoint { position, normal: Normal::Z }, &settings);
            let image = |m: i32| {
                let (i, j) = (m / 5 - 2, m % 5 - 2);
                let across = [(i, fx, x), (j, fy, y)]
                    .map(|(cell, share, side)| (f64::from(cell) + 0.5 - share) * side);
                let away2 = across[0].powi(2) + across[1].powi(2) + 0.25 * z * z;
                let count = i.abs() + j.abs();
                let share = if count > 2 { 0.0 } else { DIM.powi(count) };
                share * cd * 0.5 * z / away2.powf(1.5)
            };
            let (found, expected) = (read.direct_lx.luminance(), (0..25).map(image).sum::<f64>());
            // Light falls off by three parts of the way it comes from at the most.
            let moved = INWARDS * (at + SIZE[1] * scale) / (0.5 * z);
            let off = (found / expected - 1.0).abs();
            assert!(off < 1e-6 + 3.0 * moved, "{at} {scale} {fx} {fy}: {found} {expected}");
        }
    }
}
