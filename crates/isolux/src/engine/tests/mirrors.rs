//! Virtual luminaires, panes, and what neither covers.

use super::direct_light::{facing, lux};
use super::*;
use crate::engine::light::Lighting;
use crate::photometry::PhotometricWeb;
use crate::scene::{Body, Dielectric};
use std::sync::Arc;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn mirror(reflectance: f64) -> Material {
    Material::one_sided("mirror", Finish::mirror(Rgb::grey(reflectance)))
}

fn clear_pane() -> Dielectric {
    Dielectric { ior: 1.5, transmittance: Rgb::new(0.9, 0.8, 0.5), thin: true }
}

fn materials() -> Vec<Material> {
    let glass = |glass| Material { name: "glass".into(), body: Body::Dielectric(glass) };
    let solid = Dielectric { thin: false, ..clear_pane() };
    vec![painted(Rgb::grey(0.5)), mirror(0.8), glass(clear_pane()), glass(solid), glowing(1000.0)]
}

fn floor() -> Shape {
    rectangle([-9.0, -9.0, -1.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 0)
}

/// A mirror at x = 0 that reflects towards +x, from y = -1 to 1 and z = 0 to 2.
fn wall() -> Shape {
    rectangle([0.0, -1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], 1)
}

fn inverse_square(intensity_cd: f64, to: [f64; 3]) -> f64 {
    let d2: f64 = to.iter().map(|c| c * c).sum();
    intensity_cd * to[2] / d2.powf(1.5)
}

#[test]
fn a_mirror_adds_the_image() {
    let scene = scene(vec![floor(), wall()], materials(), vec![isotropic([1.0, 0.0, 1.5], 100.0)]);
    // From (1, 0.2, 0) the image at (-1, 0, 1.5) is seen through (0, 0.1, 0.75) of the mirror.
    let (real, image) =
        (inverse_square(100.0, [0.0, -0.2, 1.5]), inverse_square(100.0, [-2.0, -0.2, 1.5]));
    let found = lux(&scene, [1.0, 0.2, 0.0], UP);
    let expected = real + 0.8 * image;
    assert!((found - expected).abs() < RAY_ROUNDING * expected, "{found} {expected}");
    // From (2, 5, 0) the line to the image passes the mirror's plane at y = 5 / 3: beside it.
    let found = lux(&scene, [2.0, 5.0, 0.0], UP);
    let expected = inverse_square(100.0, [-1.0, -5.0, 1.5]);
    assert!((found - expected).abs() < RAY_ROUNDING * expected, "{found} {expected}");
}

#[test]
fn behind_a_mirror_is_nothing() {
    let scene = scene(vec![floor(), wall()], materials(), vec![isotropic([-1.0, 0.0, 0.5], 100.0)]);
    assert_eq!(Lighting::new(&scene).source_count(), 1);
    // And the back of the mirror shades.
    assert_eq!(lux(&scene, [1.0, 0.0, 0.2], [-1.0, 0.0, 0.0]), 0.0);
}

#[test]
fn images_are_seen_by_way_of_the_mirror_alone() {
    // A screen between mirror and receiver, another between luminaire and mirror.
    let lamp = || vec![isotropic([1.0, 0.0, 1.5], 100.0)];
    let screens = [
        ("before the receiver", rectangle([0.5, -0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.6], 0)),
        ("before the luminaire", rectangle([0.5, -0.5, 0.8], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], 0)),
    ];
    for (name, screen) in screens {
        let scene = scene(vec![floor(), wall(), screen], materials(), lamp());
        let found = lux(&scene, [1.0, 0.2, 0.0], UP);
        let real = inverse_square(100.0, [0.0, -0.2, 1.5]);
        assert!((found - real).abs() < RAY_ROUNDING * real, "{name}: {found} {real}");
    }
}

#[test]
fn two_mirrors_in_a_corner_make_three_images() {
    let second = rectangle([0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [3.0, 0.0, 0.0], 1);
    let mut first = wall();
    first.positions = vec![[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 3.0, 2.0], [0.0, 0.0, 2.0]];
    let scene =
        scene(vec![floor(), first, second], materials(), vec![isotropic([1.0, 0.5, 1.0], 100.0)]);
    let found = lux(&scene, [0.7, 0.8, 0.0], UP);
    let at = |x: f64, y: f64| inverse_square(100.0, [x - 0.7, y - 0.8, 1.0]);
    let expected = at(1.0, 0.5) + 0.8 * (at(-1.0, 0.5) + at(1.0, -0.5)) + 0.64 * at(-1.0, -0.5);
    assert!((found - expected).abs() < RAY_ROUNDING * expected, "{found} {expected}");
}

#[test]
fn the_image_of_a_luminaire_is_left_handed() {
    // 400 cd towards +y and 10 cd towards -y, seen in a mirror at y = 0 from above.
    let candela = vec![100.0, 100.0, 100.0, 400.0, 100.0, 50.0, 100.0, 10.0];
    let planes = vec![0.0, 90.0, 180.0, 270.0];
    let web = PhotometricWeb::new(planes, vec![0.0, 90.0], candela).unwrap();
    let lamp = point([0.0, 1.0, 0.0], IntensityDistribution::Web(Arc::new(web)));
    let wall = rectangle([-9.0, 0.0, -0.5], [0.0, 0.0, 9.0], [18.0, 0.0, 0.0], 1);
    let scene = scene(vec![floor(), wall], materials(), vec![lamp]);
    // Towards the mirror the luminaire sends 10 cd; at three metres, by way of the mirror.
    let found = lux(&scene, [0.0, 2.0, 0.0], [0.0, -1.0, 0.0]);
    let expected = 400.0 + 0.8 * 10.0 / 9.0;
    assert!((found - expected).abs() < RAY_ROUNDING * expected, "{found} {expected}");
}

#[test]
fn parallel_light_and_surfaces_have_images_too() {
    let kind = LuminaireKind::Directional {
        direction: direction([-0.6, 0.0, -0.8]),
        illuminance_lx: 1000.0,
        half_angle_rad: 0.0,
    };
    let sunny = scene(vec![floor(), wall()], materials(), vec![luminaire(kind)]);
    // From x = 0.5 the image of the sun is seen at (0, 0, 0.67).
    let found = lux(&sunny, [0.5, 0.0, 0.0], UP);
    assert!((found - 1800.0 * 0.8).abs() < RAY_ROUNDING * found, "{found}");
    // From x = 2 it would be seen at a height of 2.67, above the mirror.
    let found = lux(&sunny, [2.0, 0.0, 0.0], UP);
    assert!((found - 1000.0 * 0.8).abs() < RAY_ROUNDING * found, "{found}");
    // A small glowing square near the mirror, facing down: almost a point of 1000 cd/m2 x 4 cm2.
    let small = rectangle([0.49, -0.01, 1.0], [0.0, 0.02, 0.0], [0.02, 0.0, 0.0], 4);
    let lit = scene(vec![floor(), wall(), small], materials(), vec![]);
    let lighting = Lighting::new(&lit);
    let (mean, error) = mean_and_error(
        (0..200)
            .map(|k| lighting.illuminance(&facing([0.5, 0.0, 0.0], UP), &mut dice(k)).luminance()),
    );
    // Cosines at both ends: height over distance.
    let (real, image) = (0.4, 0.4 / (1.0 + 1.0_f64).powi(2));
    let expected = real + 0.8 * image;
    // Its size of 2 cm at 1 m: the square of a hundredth, and the images' sampling error.
    assert!((mean - expected).abs() < 3e-4 * expected + SIGMAS * error, "{mean} {expected}");
}

#[test]
fn panes_leave_their_transmittance() {
    let lamp = || vec![isotropic([0.0, 0.0, 2.0], 100.0)];
    let sheet = |z: f64| rectangle([-9.0, -9.0, z], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 2);
    let cos = 2.0 / (4.0_f64 + 2.25).sqrt();
    let passed = clear_pane().pane(cos).transmittance;
    for (panes, shapes) in
        [(1, vec![floor(), sheet(1.0)]), (2, vec![floor(), sheet(0.5), sheet(1.0)])]
    {
        let scene = scene(shapes, materials(), lamp());
        let found = Lighting::new(&scene).illuminance(&facing([1.5, 0.0, 0.0], UP), &mut dice(1));
        let open = inverse_square(100.0, [1.5, 0.0, 2.0]);
        for c in 0..3 {
            let expected = open * passed.0[c].powi(panes);
            // The way through each pane has the rounding of the direction.
            let rounding = f64::from(panes) * RAY_ROUNDING * expected;
            assert!((found.0[c] - expected).abs() < rounding, "{panes} {c}: {found:?} {expected}");
        }
    }
}

#[test]
fn a_mirror_behind_a_pane_is_seen_through_it_twice() {
    let lamp = vec![isotropic([1.0, 0.0, 1.5], 100.0)];
    let sheet = rectangle([0.2, -9.0, -0.9], [0.0, 18.0, 0.0], [0.0, 0.0, 9.0], 2);
    let scene = scene(vec![floor(), wall(), sheet], materials(), lamp);
    let found = Lighting::new(&scene).illuminance(&facing([1.0, 0.2, 0.0], UP), &mut dice(1));
    let to_image = [-2.0, -0.2, 1.5_f64];
    let cos = 2.0 / to_image.iter().map(|c| c * c).sum::<f64>().sqrt();
    let passed = clear_pane().pane(cos).transmittance;
    for c in 0..3 {
        let image = 0.8 * inverse_square(100.0, to_image) * passed.0[c] * passed.0[c];
        let expected = inverse_square(100.0, [0.0, -0.2, 1.5]) + image;
        assert!((found.0[c] - expected).abs() < RAY_ROUNDING * expected, "{c}: {found:?}");
    }
}

/// Light of a glowing square that reaches a place beside it through a pane, over that without pane.
fn share_through_pane(pane_z: f64, x: f64) -> (f64, f64) {
    let square = rectangle([-0.5, -0.5, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], 4);
    let sheet = rectangle([-9.0, -9.0, pane_z], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 2);
    let place = facing([x, 0.0, 0.0], UP);
    let mean = |shapes| {
        let scene = scene(shapes, materials(), vec![]);
        let lighting = Lighting::new(&scene);
        let one = |k| lighting.illuminance(&place, &mut dice(k)).0[0];
        mean_and_error((0..60).map(one))
    };
    let (through, error) = mean(vec![floor(), square.clone(), sheet]);
    let (open, _) = mean(vec![floor(), square]);
    (through / open, error / open)
}

/// Over the square the angle changes: its ends bound the transmittance.
fn check_shine(pane_z: f64, x: f64) {
    let (share, error) = share_through_pane(pane_z, x);
    let near = (x.abs() - 0.5).max(0.0);
    let far = libm::hypot(x.abs() + 0.5, 0.5);
    let [high, low] = [near, far].map(|side| {
        let cos = 1.0 / libm::hypot(side, 1.0);
        clear_pane().pane(cos).transmittance.0[0]
    });
    let slack = SIGMAS * error + RAY_ROUNDING;
    assert!(
        share > low - slack && share < high + slack,
        "{pane_z} {x}: {share} of {low} to {high}"
    );
}

#[test]
fn surfaces_shine_through_panes() {
    for pane_z in [0.1, 0.5, 0.999] {
        [0.0, 0.3].into_iter().for_each(|x| check_shine(pane_z, x));
    }
}

#[test]
fn surfaces_shine_through_panes_at_an_angle() {
    for pane_z in [0.1, 0.5, 0.999] {
        [1.0, 2.0, 4.0, 8.0].into_iter().for_each(|x| check_shine(pane_z, x));
    }
}

#[test]
fn solid_glass_is_left_to_particles() {
    let sheet = rectangle([-9.0, -9.0, 1.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], 3);
    let scene = scene(vec![floor(), sheet], materials(), vec![isotropic([0.0, 0.0, 2.0], 100.0)]);
    assert_eq!(lux(&scene, [0.5, 0.0, 0.0], UP), 0.0);
    assert!(Lighting::new(&scene).leaves_caustics());
}

#[test]

fn chains_of_mirrors_too_long_for_images_are_left_to_particles() {
    let facing_walls = [
        rectangle([0.0, -2.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], 1),
        rectangle([1.0, -2.0, 0.0], [0.0, 0.0, 4.0], [0.0, 4.0, 0.0], 1),
    ];
    let mut shapes = vec![floor()];
    shapes.extend(facing_walls);
    let opaque = materials().into_iter().take(2).collect();
    let scene = scene(shapes, opaque, vec![isotropic([0.5, 0.0, 3.0], 100.0)]);
    assert!(Lighting::new(&scene).leaves_caustics());
}

#[test]
fn a_mirror_with_one_turned_corner_is_curved() {
    for turned in 0..3 {
        let mut normals = vec![[0.0, 0.0, 1.0]; 3];
        normals[turned] = [0.5, 0.0, 1.0];
        let curved = Shape {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: Some(normals),
            triangles: vec![[0, 1, 2]],
            material: 1,
            ..Shape::default()
        };
        let scene =
            scene(vec![floor(), curved], materials(), vec![isotropic([0.3, 0.3, 3.0], 100.0)]);
        let lighting = Lighting::new(&scene);
        assert!(lighting.source_count() == 1 && lighting.leaves_caustics(), "corner {turned}");
    }
}
