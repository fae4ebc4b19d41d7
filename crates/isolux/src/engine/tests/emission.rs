//! Particles leave in proportion to flux.

use super::*;
use crate::engine::light::{Emission, Emitted, LuminaireId};
use std::f64::consts::PI;

/// A lamp, a spot that is coloured, the sun, and a glowing square on the floor that faces up.
fn everything() -> Scene {
    let spot = IntensityDistribution::CosinePower { peak_cd: 200.0, exponent: 3.0 };
    let mut coloured = point([1.0, 0.0, 2.0], spot);
    coloured.colour = Rgb::new(2.0, 1.0, 0.0);
    let sun = LuminaireKind::Directional {
        direction: direction([0.0, 0.6, -0.8]),
        illuminance_lx: 5.0,
        half_angle_rad: 0.0,
    };
    scene(
        vec![
            rectangle([-2.0, -2.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], 0),
            rectangle([0.5, 0.5, 0.1], [1.0, 0.0, 0.0], [0.0, 0.5, 0.0], 1),
        ],
        vec![painted(Rgb::grey(0.5)), glowing(80.0)],
        vec![isotropic([0.0, 0.0, 1.0], 10.0), coloured, luminaire(sun)],
    )
}

fn emitted(scene: &Scene, count: u32) -> Vec<Emitted> {
    let emission = Emission::new(scene).unwrap();
    let sequence = Sequence::new(Key::new(1));
    (0..count).map(|k| emission.emit(&mut Dice::new(sequence, k)).unwrap()).collect()
}

#[test]
fn luminaires_emit_by_their_flux() {
    let scene = everything();
    let emission = Emission::new(&scene).unwrap();
    // The sun covers the sphere about the scene: half the diagonal of 4 x 4 x 0.1 m, a thousandth
    // added so that nothing is missed.
    let radius2 = (16.0 + 16.0 + 0.01) / 4.0 * 1.001 * 1.001;
    let coloured = Rgb::new(2.0, 1.0, 0.0).luminance() * 2.0 * PI * 200.0 / 4.0;
    let expected = [4.0 * PI * 10.0, coloured, 5.0 * PI * radius2, PI * 80.0 * 0.5];
    let whole: f64 = expected.iter().sum();
    assert!((emission.flux_lm() / whole - 1.0).abs() < 1e-6, "{} {whole}", emission.flux_lm());
    let count = 1 << 14;
    let mut counts = [0; 4];
    for particle in emitted(&scene, count) {
        let index = match particle.luminaire {
            LuminaireId::Luminaire(k) => k as usize,
            LuminaireId::Area(k) => 3 + k as usize,
        };
        counts[index] += 1;
        assert!((particle.colour.luminance() - 1.0).abs() < 1e-12);
    }
    for (share, found) in expected.map(|lm| lm / whole).into_iter().zip(counts) {
        // A net of points misses a share by far less than independent ones.
        let sigma = (share * (1.0 - share) / f64::from(count)).sqrt();
        assert!((f64::from(found) / f64::from(count) - share).abs() < SIGMAS * sigma);
    }
}

#[test]
fn particles_start_where_and_go_where_luminaires_shine() {
    let scene = everything();
    for particle in emitted(&scene, 4096) {
        let origin = particle.ray.origin;
        let way = particle.direction.to_vector();
        match particle.luminaire {
            LuminaireId::Luminaire(0) => assert_eq!(origin, Point::new(0.0, 0.0, 1.0)),
            LuminaireId::Luminaire(1) => assert!(way.z <= 0.0),
            LuminaireId::Luminaire(_) => {
                assert_eq!(particle.direction, direction([0.0, 0.6, -0.8]));
                // Before all of the scene.
                assert!((origin - Point::ORIGIN).dot(way) < -2.0);
            }
            LuminaireId::Area(_) => {
                let inside =
                    origin.x >= 0.5 && origin.x <= 1.5 && origin.y >= 0.5 && origin.y <= 1.0;
                assert!(inside && origin.z > 0.1 - 1e-6 && way.z >= 0.0, "{origin:?}");
            }
        }
    }
}

#[test]
fn a_surface_emits_by_the_cosine() {
    let shapes = vec![rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0)];
    let scene = scene(shapes, vec![glowing(10.0)], vec![]);
    let cosines = || emitted(&scene, 4096).into_iter().map(|e| e.direction.to_vector().z);
    // Means of the cosine and of its square: two thirds, one half.
    for (power, expected) in [(1, 2.0 / 3.0), (2, 0.5)] {
        let (mean, error) = mean_and_error(cosines().map(|c| c.powi(power)));
        assert!((mean - expected).abs() < SIGMAS * error, "{power}: {mean}");
    }
}

#[test]
fn without_light_nothing_is_emitted() {
    let floor = || vec![rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0)];
    let materials = || vec![painted(Rgb::grey(0.5))];
    assert!(Emission::new(&scene(floor(), materials(), vec![])).is_none());
    let dark = isotropic([0.0, 0.0, 1.0], 0.0);
    assert!(Emission::new(&scene(floor(), materials(), vec![dark])).is_none());
    let mut black = isotropic([0.0, 0.0, 1.0], 10.0);
    black.colour = Rgb::BLACK;
    assert!(Emission::new(&scene(floor(), materials(), vec![black])).is_none());
}
