//! Complete paths over glass and gloss, where no virtual luminaires help, by the balance of light in closed rooms.

use super::{SIGMAS, glowing, inward_box, isotropic, mean_and_error, painted, rectangle, scene};
use crate::engine::{ExactSettings, PathTracer, ProbePoint};
use crate::map::Illuminance;
use crate::sampling::Key;
use crate::scene::{Body, Dielectric, Luminaire, Material, Scene, Shape};
use crate::units::Rgb;
use isolux_geometry::{Point, Vector};

const SIZE: [f64; 3] = [4.0, 5.0, 3.0];
const REFLECTANCE: f64 = 0.6;
const WALLS_M2: f64 = 2.0 * (4.0 * 5.0 + 4.0 * 3.0 + 5.0 * 3.0);

/// A pane that neither absorbs nor scatters, half of a mirror.
fn pane() -> Material {
    let glass = Dielectric { ior: 4.0, transmittance: Rgb::WHITE, thin: true };
    Material { name: "pane".into(), body: Body::Dielectric(glass) }
}

fn room_with_pane(more: Vec<Shape>, lamps: Vec<Luminaire>) -> Scene {
    let mut shapes = inward_box(SIZE, 0);
    shapes.push(rectangle([1.0, 1.0, 0.6], [2.0, 0.0, 0.8], [0.0, 3.0, 0.3], 1));
    shapes.extend(more);
    scene(shapes, vec![painted(Rgb::grey(REFLECTANCE)), pane(), glowing(1000.0)], lamps)
}

/// Values at places of the walls, drawn by area.
fn at_walls(scene: &Scene, part: impl Fn(&Illuminance) -> f64) -> (f64, f64) {
    let tracer = PathTracer::new(scene);
    let settings = ExactSettings { rays: 16, replicates: 4, seed: 1 };
    let value = |k: u64| {
        let random = |j: u64| Key::new(11).with(k).with(j).uniform();
        // Triangles of the box come first, two a face.
        let areas: Vec<f64> = (0..12).map(|t| scene.triangle(t).area()).collect();
        let mut left = random(0) * WALLS_M2;
        let triangle = areas.iter().position(|area| {
            left -= area;
            left < 0.0
        });
        let triangle = triangle.unwrap_or(11) as u32;
        let (root, b) = (random(1).sqrt(), random(2));
        let position: Point = scene.triangle(triangle).point(root * (1.0 - b), root * b);
        let normal = scene.geometric_normal(triangle);
        part(&tracer.estimate(ProbePoint { position, normal }, &settings))
    };
    mean_and_error((0..12_000).map(value))
}

/// All light lands on the walls at first, by whatever way, so that reflected light is that times rho / (1 - rho).
#[test]
fn light_of_points_that_comes_over_glass_is_reflected_by_walls() {
    let lamp = isotropic([1.2, 1.5, 2.2], 100.0);
    let scene = room_with_pane(Vec::new(), vec![lamp]);
    let tracer = PathTracer::new(&scene);
    assert!(tracer.leaves_caustics());
    let (mean, error) = at_walls(&scene, |found| found.indirect_lx.luminance());
    let flux_lm = 4.0 * std::f64::consts::PI * 100.0;
    let expected = flux_lm / WALLS_M2 * REFLECTANCE / (1.0 - REFLECTANCE);
    assert!((mean - expected).abs() < SIGMAS * error, "{mean} +- {error} for {expected}");
    // What a pane reflects is some per cent of all light, which this can tell.
    assert!(error < 0.01 * expected, "{error}");
}

/// Of emitting surfaces paths find all light, that which the pane reflects onto walls included.
#[test]
#[ignore = "slow: cargo xtask test --all"]
fn light_of_emitting_surfaces_that_comes_over_glass_is_found() {
    let panel = rectangle([1.0, 1.0, 2.9], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], 2);
    let scene = room_with_pane(vec![panel], Vec::new());
    assert!(!PathTracer::new(&scene).leaves_caustics());
    let (mean, error) = at_walls(&scene, Illuminance::illuminance_lx);
    let flux_lm = std::f64::consts::PI * 1000.0;
    let absorbed = [-1.0, 1.0].map(|side| at_panel(&scene, side));
    let balance = |of_panel: f64| (flux_lm - of_panel) / WALLS_M2 / (1.0 - REFLECTANCE);
    let expected = balance(absorbed[0].0 + absorbed[1].0);
    let error = absorbed.iter().fold(error, |sum, (_, error)| sum.hypot(error / WALLS_M2));
    assert!((mean - expected).abs() < SIGMAS * error, "{mean} +- {error} for {expected}");
    let (caustic, noise) = at_walls(&scene, |found| found.caustic_lx.luminance());
    // What would be missing is far more than the noise.
    assert!(caustic > 2.0 * SIGMAS * error && caustic > SIGMAS * noise, "{caustic} +- {noise}");
}

/// What falls on a square metre of the panel, from below or from above, lx.
fn at_panel(scene: &Scene, side: f64) -> (f64, f64) {
    let tracer = PathTracer::new(scene);
    let settings = ExactSettings { rays: 64, replicates: 4, seed: 1 };
    let value = |k: u64| {
        let random = |j: u64| Key::new(12).with(k).with(j).uniform();
        let position = Point::new(1.0 + random(0), 1.0 + random(1), 2.9 + side * 1e-3);
        let normal = Vector::new(0.0, 0.0, side).normal().unwrap();
        tracer.estimate(ProbePoint { position, normal }, &settings).illuminance_lx()
    };
    mean_and_error((0..400).map(value))
}
