//! Gradients compared with differences.

use super::{look, room, site};
use isolux_geometry::{Normal, Vector};

/// The number of rays of a replicate, which gives 16 rings. Coarser grids resolve changes near the horizon
/// less well.
const RAYS: u32 = 1024;

/// The error of a gradient from a grid of 16 rings and from noise. The worst of 12 gradients differs by 9 %
/// of the largest gradient at its place.
const TOLERANCE: f64 = 0.1;

const STEP_M: f64 = 0.1;
const TURN_RAD: f64 = 0.1;

const PLACES: [[f64; 3]; 3] = [[1.0, 1.0, 1e-4], [3.0, 2.0, 1e-4], [0.4, 0.3, 1e-4]];

/// The central differences of a function along the two axes.
fn differences(step: f64, value: impl Fn(usize, f64) -> f64) -> [f64; 2] {
    [0, 1].map(|axis| (value(axis, step) - value(axis, -step)) / (2.0 * step))
}

fn check(at: [f64; 3], gradient: [f64; 2], difference: [f64; 2]) {
    let largest = difference[0].hypot(difference[1]);
    for axis in 0..2 {
        let error = (gradient[axis] - difference[axis]).abs() / largest;
        assert!(error < TOLERANCE, "{at:?}, axis {axis}: {gradient:?}, not {difference:?}");
    }
}

#[test]
fn light_changes_along_the_floor_as_its_gradient_says() {
    let scene = room();
    let up = Normal::Z.to_vector();
    for at in PLACES {
        let own = look(&scene, &site(at, up), RAYS);
        let difference = differences(STEP_M, |axis, step| {
            let mut there = at;
            there[axis] += step;
            look(&scene, &site(there, up), RAYS).value().0[0]
        });
        check(at, [own.0[1][0], own.0[2][0]], difference);
    }
}

#[test]
fn light_changes_with_the_normal_as_its_gradient_says() {
    let scene = room();
    let up = Normal::Z.to_vector();
    let axes = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 1.0, 0.0)];
    for at in PLACES {
        let own = look(&scene, &site(at, up), RAYS);
        let difference = differences(TURN_RAD, |axis, turn| {
            let tilted = up + axes[axis].cross(up) * turn;
            look(&scene, &site(at, tilted), RAYS).value().0[0]
        });
        check(at, [own.0[4][0], own.0[5][0]], difference);
    }
}
