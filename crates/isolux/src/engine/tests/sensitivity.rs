//! How light depends on reflectances, beside differences of light.

use super::*;
use crate::engine::{ExactSettings, PathTracer, ProbePoint, Sensitivity};
use isolux_geometry::Direction;

fn place() -> ProbePoint {
    ProbePoint { position: Point::new(1.0, 1.0, 0.8), normal: Direction::Z.to_normal() }
}

/// A closed room whose floor has a reflectance of its own.
fn room(walls: f64, floor: f64) -> Scene {
    let mut shapes = inward_box([4.0, 3.0, 2.5], 0);
    shapes.push(rectangle([0.0, 0.0, 0.001], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0], 1));
    let paints = vec![painted(Rgb::grey(walls)), painted(Rgb::grey(floor))];
    scene(shapes, paints, vec![isotropic([2.0, 1.5, 1.5], 100.0)])
}

fn settings() -> ExactSettings {
    ExactSettings { rays: 16_384, replicates: 16, seed: 1 }
}

fn sensitivity(of: &Scene, count: usize) -> Sensitivity {
    let class = |triangle: u32| of.material_index(triangle).min(count as u32 - 1);
    let classes: Vec<u32> = (0..of.triangle_count()).map(class).collect();
    PathTracer::new(of).sensitivity(place(), (&classes, count), &settings())
}

fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len() as f64
}

#[test]
fn derivatives_are_those_of_differences() {
    const STEP: f64 = 0.15;
    let found = sensitivity(&room(0.5, 0.3), 2);
    let light = |walls: f64, floor: f64| {
        PathTracer::new(&room(walls, floor)).estimate(place(), &settings())
    };
    let by_hand = |low: crate::map::Illuminance, high: crate::map::Illuminance| {
        let error_lx = libm::hypot(low.standard_error_lx, high.standard_error_lx);
        [high.illuminance_lx() - low.illuminance_lx(), error_lx].map(|lx| lx / (2.0 * STEP))
    };
    let walls = by_hand(light(0.5 * (1.0 - STEP), 0.3), light(0.5 * (1.0 + STEP), 0.3));
    let floor = by_hand(light(0.5, 0.3 * (1.0 - STEP)), light(0.5, 0.3 * (1.0 + STEP)));
    for (class, [right_lx, error_lx]) in [walls, floor].into_iter().enumerate() {
        let lx = mean(&found.by_class_lx[class]);
        assert!(
            error_lx < 0.05 * right_lx,
            "the comparison tells something: {error_lx} {right_lx}"
        );
        // The next term of the series is the square of the step, times what a few reflections make of it.
        let allowed_lx = SIGMAS * error_lx + 3.0 * STEP * STEP * right_lx;
        assert!(
            (lx - right_lx).abs() < allowed_lx,
            "class {class}: {lx}, {right_lx} by differences"
        );
    }
}

/// The sum over classes is that of one class of all surfaces, path by path.
#[test]
fn classes_share_what_all_surfaces_do() {
    let room = room(0.5, 0.3);
    let (apart, together) = (sensitivity(&room, 2), sensitivity(&room, 1));
    assert_eq!(apart.illuminance_lx, together.illuminance_lx);
    for replicate in 0..16 {
        let sum: f64 = apart.by_class_lx.iter().map(|class| class[replicate]).sum();
        let all = together.by_class_lx[0][replicate];
        assert!((sum - all).abs() < 1e-9 * all, "{sum} {all}");
    }
    let black = sensitivity(&self::room(0.0, 0.0), 2);
    assert!(black.by_class_lx.iter().flatten().all(|lx| *lx == 0.0));
}
