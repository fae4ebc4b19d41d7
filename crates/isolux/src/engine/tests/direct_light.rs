//! Direct light against the formulas of photometry.

use super::fixed_point::corner_form_factor;
use super::*;
use crate::engine::light::Lighting;
use crate::engine::ray::SurfacePoint;
use crate::photometry::PhotometricWeb;
use isolux_geometry::Normal;
use std::f64::consts::PI;
use std::sync::Arc;

pub(super) fn facing(point: [f64; 3], normal: [f64; 3]) -> SurfacePoint {
    let normal = Vector::from(normal).normal().unwrap();
    SurfacePoint::in_space(Point::from(point), normal, 0.0)
}

/// Direct illuminance at a place in space, lx.
pub(super) fn lux(scene: &Scene, point: [f64; 3], normal: [f64; 3]) -> f64 {
    Lighting::new(scene).illuminance(&facing(point, normal), &mut dice(1)).luminance()
}

/// A floor to have a scene at all, and what else there is.
fn over_floor(mut shapes: Vec<Shape>, luminaires: Vec<Luminaire>) -> Scene {
    shapes.push(rectangle([-9.0, -9.0, -1.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0));
    scene(shapes, vec![painted(Rgb::grey(0.5)), glowing(1000.0)], luminaires)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found} for {expected}");
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const DOWN: [f64; 3] = [0.0, 0.0, -1.0];

#[test]
fn points_light_by_the_inverse_square_and_the_cosine() {
    let scene = over_floor(vec![], vec![isotropic([1.0, 2.0, 3.0], 500.0)]);
    let d2: f64 = 1.0 + 4.0 + 9.0;
    close(lux(&scene, [0.0; 3], UP), 500.0 * 3.0 / d2.powf(1.5), 1e-12);
    close(lux(&scene, [0.0; 3], [1.0, 0.0, 0.0]), 500.0 / d2.powf(1.5), 1e-12);
    assert_eq!(lux(&scene, [0.0; 3], DOWN), 0.0);
    // Below the floor.
    assert_eq!(lux(&scene, [0.0, 0.0, -2.0], UP), 0.0);
}

#[test]
fn colours_scale_and_sources_add() {
    let mut red = isotropic([0.0, 0.0, 2.0], 100.0);
    red.colour = Rgb::new(3.0, 0.5, 0.0);
    let scene = over_floor(vec![], vec![red, isotropic([0.0, 0.0, 4.0], 100.0)]);
    let found = Lighting::new(&scene).illuminance(&facing([0.0; 3], UP), &mut dice(1));
    for (c, colour) in [3.0, 0.5, 0.0].into_iter().enumerate() {
        close(found.0[c], 25.0 * colour + 6.25, 1e-12);
    }
}

#[test]
fn spots_light_within_their_cones() {
    let (inner_rad, outer_rad) = (0.3_f64, 0.6_f64);
    let spot = IntensityDistribution::Spot { peak_cd: 800.0, inner_rad, outer_rad };
    let scene = over_floor(vec![], vec![point([0.0, 0.0, 2.0], spot)]);
    let at = |gamma: f64| lux(&scene, [2.0 * libm::tan(gamma), 0.0, 0.0], UP);
    let plain = |gamma: f64| 800.0 / 4.0 * libm::pow(libm::cos(gamma), 3.0);
    close(at(0.0), plain(0.0), 1e-12);
    close(at(0.29), plain(0.29), 1e-12);
    let ramp =
        (libm::cos(0.45) - libm::cos(outer_rad)) / (libm::cos(inner_rad) - libm::cos(outer_rad));
    close(at(0.45), plain(0.45) * ramp * ramp, 1e-12);
    assert_eq!(at(0.61), 0.0);
}

fn lopsided() -> IntensityDistribution {
    let candela = vec![100.0, 200.0, 0.0, 100.0, 400.0, 0.0, 100.0, 50.0, 0.0, 100.0, 10.0, 30.0];
    let web =
        PhotometricWeb::new(vec![0.0, 90.0, 180.0, 270.0], vec![0.0, 45.0, 90.0], candela).unwrap();
    IntensityDistribution::Web(Arc::new(web))
}

#[test]
fn webs_turn_with_their_luminaire() {
    let distance2 = 2.0;
    // Upright: C0 along +x, nadir down; then C90 along +y, and so on.
    let upright = over_floor(vec![], vec![point([0.0, 0.0, 1.0], lopsided())]);
    for (place, candela) in [
        ([1.0, 0.0, 0.0], 200.0),
        ([0.0, 1.0, 0.0], 400.0),
        ([-1.0, 0.0, 0.0], 50.0),
        ([0.0, -1.0, 0.0], 10.0),
    ] {
        close(lux(&upright, place, UP), candela / distance2 * 0.5_f64.sqrt(), 1e-12);
    }
    // Aimed along +x with C0 up: nadir -z goes to +x, x to +z.
    let world_from_luminaire = Transform {
        columns: [
            Vector::new(0.0, 0.0, 1.0),
            Vector::new(0.0, 1.0, 0.0),
            Vector::new(-1.0, 0.0, 0.0),
        ],
        translation: Vector::ZERO,
    };
    let aimed = over_floor(
        vec![],
        vec![luminaire(LuminaireKind::Point {
            position: Point::new(0.0, 0.0, 5.0),
            world_from_luminaire,
            intensity: lopsided(),
            area: None,
        })],
    );
    for (place, candela) in [
        ([2.0, 0.0, 5.0], 100.0 * distance2 / 4.0 * 2.0_f64.sqrt()),
        ([1.0, 0.0, 6.0], 200.0),
        ([1.0, 1.0, 5.0], 400.0),
        ([1.0, 0.0, 4.0], 50.0),
    ] {
        let found = lux(&aimed, place, [-1.0, 0.0, 0.0]);
        close(found, candela / distance2 * 0.5_f64.sqrt(), 1e-12);
    }
}

#[test]
fn parallel_light_depends_on_the_angle_alone() {
    let kind = LuminaireKind::Directional {
        direction: direction([0.6, 0.0, -0.8]),
        illuminance_lx: 1e5,
        half_angle_rad: 0.0,
    };
    // A roof over x < 0, a metre up: its shadow ends at x = 0.75.
    let roof = rectangle([-5.0, -5.0, 1.0], [5.0, 0.0, 0.0], [0.0, 10.0, 0.0], 0);
    let scene = over_floor(vec![roof], vec![luminaire(kind)]);
    close(lux(&scene, [3.0, 1.0, 0.0], UP), 0.8e5, 1e-12);
    close(lux(&scene, [3.0, 1.0, 0.0], [-1.0, 0.0, 0.0]), 0.6e5, 1e-12);
    assert_eq!(lux(&scene, [0.74, 0.0, 0.0], UP), 0.0);
    assert!(lux(&scene, [0.76, 0.0, 0.0], UP) > 0.0);
    assert_eq!(lux(&scene, [3.0, 0.0, 0.0], DOWN), 0.0);
}

/// A glowing square of 2 x 2 m at a height, facing down.
fn panel(height: f64) -> Shape {
    rectangle([-1.0, -1.0, height], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], 1)
}

#[test]
fn surfaces_light_by_their_form_factor() {
    for height in [0.01, 0.5, 2.0, 50.0] {
        let scene = over_floor(vec![panel(height)], vec![]);
        let centre = 4.0 * corner_form_factor(1.0, 1.0, height);
        close(lux(&scene, [0.0; 3], UP), PI * 1000.0 * centre, RAY_ROUNDING);
        let corner = corner_form_factor(2.0, 2.0, height);
        close(lux(&scene, [1.0, 1.0, 0.0], UP), PI * 1000.0 * corner, RAY_ROUNDING);
        // It shines on one side only.
        assert_eq!(lux(&scene, [0.0, 0.0, height + 1.0], DOWN), 0.0);
    }
}

/// Form factor of a rectangle that stands on the plane of a receiver, `a` high and `b` long, from a
/// point at distance `c` from its end (Howell, B-4).
fn upright_form_factor(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / b, c / b);
    let root = (x * x + y * y).sqrt();
    (libm::atan(1.0 / y) - y / root * libm::atan(1.0 / root)) / (2.0 * PI)
}

#[test]
fn of_surfaces_that_cross_the_horizon_the_part_above_lights() {
    // Standing at x = 0 from far below to above the plane of the receiver.
    for (low, high) in [(0.0, 1.5), (-0.5, 1.5), (-0.9, 0.3)] {
        let wall = rectangle([0.0, -2.0, low], [0.0, 4.0, 0.0], [0.0, 0.0, high - low], 1);
        let scene = over_floor(vec![wall], vec![]);
        let expected = 2.0 * PI * 1000.0 * upright_form_factor(high, 2.0, 0.7);
        close(lux(&scene, [0.7, 0.0, 0.0], UP), expected, RAY_ROUNDING);
    }
    let below = rectangle([0.0, -2.0, -0.9], [0.0, 4.0, 0.0], [0.0, 0.0, 0.8], 1);
    assert_eq!(lux(&over_floor(vec![below], vec![]), [0.7, 0.0, 0.0], UP), 0.0);
}

#[test]
fn half_a_surface_in_shadow_gives_the_other_half() {
    // A black screen close above the receiver hides the half x < 0 of the panel, to the middle.
    let screen = rectangle([-8.0, -8.0, 0.01], [8.0, 0.0, 0.0], [0.0, 16.0, 0.0], 0);
    let scene = over_floor(vec![panel(1.0), screen], vec![]);
    let lighting = Lighting::new(&scene);
    let at = facing([0.0; 3], UP);
    let one = |seed| lighting.illuminance(&at, &mut dice(seed)).luminance();
    let (mean, error) = mean_and_error((0..2000).map(one));
    let expected = PI * 1000.0 * 2.0 * corner_form_factor(1.0, 1.0, 1.0);
    assert!((mean - expected).abs() < SIGMAS * error, "{mean} +- {error} for {expected}");
}

#[test]
fn a_surface_of_many_triangles_is_the_surface() {
    // Enough triangles that points of it are drawn by area.
    let n = 48;
    let mut fine = Shape { material: 1, ..Shape::default() };
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let at = |k: i32| -1.0 + 2.0 * f64::from(k) / f64::from(n);
        let first = fine.positions.len() as u32;
        for (k, l) in [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)] {
            fine.positions.push([at(k), at(l), 1.0]);
        }
        fine.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    let scene = over_floor(vec![fine], vec![]);
    let lighting = Lighting::new(&scene);
    let at = facing([0.2, 0.3, 0.0], UP);
    let one = |seed| lighting.illuminance(&at, &mut dice(seed)).luminance();
    let (mean, error) = mean_and_error((0..400).map(one));
    let part = |x: f64, y: f64| corner_form_factor(x, y, 1.0);
    let whole = part(0.8, 0.7) + part(1.2, 0.7) + part(0.8, 1.3) + part(1.2, 1.3);
    let expected = PI * 1000.0 * whole;
    assert!((mean - expected).abs() < SIGMAS * error, "{mean} +- {error} for {expected}");
}

#[test]
fn surfaces_are_measured_again_and_again() {
    let lamp = || vec![isotropic([0.0, 0.0, 2.0], 10.0)];
    assert!(Lighting::new(&over_floor(vec![], lamp())).is_measured_once());
    assert!(!Lighting::new(&over_floor(vec![panel(1.0)], lamp())).is_measured_once());
    assert_eq!(Lighting::new(&over_floor(vec![panel(1.0)], lamp())).source_count(), 2);
    assert!(!Lighting::new(&over_floor(vec![], lamp())).leaves_caustics());
}

#[test]
fn both_normals_must_see_the_light() {
    let scene = over_floor(vec![], vec![isotropic([1.0, 0.0, 0.5], 100.0)]);
    let lighting = Lighting::new(&scene);
    let tilted = Vector::new(-0.6, 0.0, 0.8).normal().unwrap();
    let flat = facing([0.0; 3], UP);
    for (shading, geometric, lit) in
        [(Normal::Z, Normal::Z, true), (tilted, Normal::Z, false), (Normal::Z, tilted, false)]
    {
        let at = SurfacePoint { shading, geometric, ..flat };
        assert_eq!(lighting.illuminance(&at, &mut dice(1)).luminance() > 0.0, lit);
    }
}
