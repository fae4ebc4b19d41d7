//! Mirrors and microfacets.

use super::*;
use crate::engine::ray::{SurfacePoint, reflect, specular_share, specular_step};
use crate::sampling::Ggx;
use crate::scene::{Body, Gloss};
use isolux_geometry::{Direction, Normal};
use std::f64::consts::PI;

pub(super) const ANGLES_DEG: [f64; 6] = [0.0, 25.0, 50.0, 70.0, 84.0, 89.0];

pub(super) fn place() -> SurfacePoint {
    SurfacePoint {
        triangle: 0,
        back: false,
        u: 0.3,
        v: 0.3,
        point: Point::ORIGIN,
        geometric: Normal::Z,
        shading: Normal::Z,
        away_m: 1e-6,
    }
}

pub(super) fn incoming(angle_deg: f64) -> Direction {
    let (s, c) = libm::sincos(angle_deg.to_radians());
    direction([0.6 * s, 0.8 * s, -c])
}

fn finish(diffuse: Rgb, mirror: Rgb, f0: Rgb, alpha: f64) -> Finish {
    Finish { mirror, gloss: Some(Gloss { f0, alpha }), ..Finish::diffuse(diffuse) }
}

/// Mean weight of a channel after one step with roulette, and its standard error.
fn reflected(finish: &Finish, angle_deg: f64, channel: usize) -> (f64, f64) {
    let body = Body::Opaque { front: finish.clone(), back: Finish::BLACK };
    let incoming = incoming(angle_deg);
    let step = |k: u64| {
        let mut dice = Dice::new(Sequence::new(Key::new(k)), 0);
        specular_step(&body, &place(), incoming, Rgb::WHITE, &mut dice)
    };
    mean_and_error((0..8000).map(|k| step(k).map_or(0.0, |s| s.weight.0[channel])))
}

#[test]
fn a_mirror_reflects_its_reflectance_at_every_angle() {
    let mirror = Finish::mirror(Rgb::new(0.9, 0.6, 0.0));
    for angle_deg in ANGLES_DEG {
        let incoming = incoming(angle_deg);
        assert_eq!(specular_share(&mirror, &place(), incoming), 0.9);
        let next = reflect(&mirror, &place(), incoming, 0.5, [0.0; 2]).unwrap();
        assert!(next.mirrored);
        assert_eq!(next.direction, incoming.reflect(Normal::Z));
        for (found, expected) in next.weight.0.into_iter().zip([1.0, 0.6 / 0.9, 0.0]) {
            assert!((found - expected).abs() < 1e-15);
        }
    }
}

/// Reflectance of rough microfacets by the midpoint rule over directions of reflection: Fresnel,
/// distribution and masking from both sides (Walter et al. 2007, eq. 20).
fn by_quadrature(f0: f64, alpha: f64, view: Vector) -> f64 {
    let (rings, sectors) = (400, 400);
    let ggx = Ggx { alpha };
    let mut sum = 0.0;
    for i in 0..rings {
        let z = (f64::from(i) + 0.5) / f64::from(rings);
        for j in 0..sectors {
            let (s, c) = libm::sincos(2.0 * PI * (f64::from(j) + 0.5) / f64::from(sectors));
            let sine = (1.0 - z * z).sqrt();
            let out = Vector::new(sine * c, sine * s, z);
            let half = (view + out).direction().unwrap().to_vector();
            let fresnel = f0 + (1.0 - f0) * libm::pow(1.0 - half.dot(view), 5.0);
            let smith = ggx.masking(view) * ggx.masking(out);
            sum += fresnel * ggx.distribution(half) * smith / (4.0 * view.z);
        }
    }
    sum * 2.0 * PI / f64::from(rings * sectors)
}

#[test]
fn gloss_reflects_what_its_distribution_says() {
    for (f0, alpha) in [(0.04, 0.5), (0.5, 0.3), (1.0, 1.0)] {
        let finish = finish(Rgb::BLACK, Rgb::BLACK, Rgb::grey(f0), alpha);
        for angle_deg in [0.0, 25.0, 50.0, 70.0, 84.0] {
            let view = (-incoming(angle_deg)).to_vector();
            let (mean, error) = reflected(&finish, angle_deg, 1);
            let expected = by_quadrature(f0, alpha, view);
            // The rule is good to 1e-4 where the distribution is as wide as here.
            let allowed = SIGMAS * error + 1e-3 * expected;
            assert!(
                (mean - expected).abs() < allowed,
                "{f0} {alpha} {angle_deg}: {mean} {expected}"
            );
        }
    }
}

#[test]
fn no_finish_gives_more_than_it_gets() {
    let whites = [
        ("white gloss", finish(Rgb::BLACK, Rgb::BLACK, Rgb::WHITE, 0.2)),
        ("gloss on paint", finish(Rgb::grey(0.9), Rgb::BLACK, Rgb::grey(0.04), 0.3)),
        ("gloss on white", finish(Rgb::grey(0.96), Rgb::BLACK, Rgb::grey(0.04), 0.01)),
        ("all three", finish(Rgb::grey(0.3), Rgb::grey(0.4), Rgb::grey(0.3), 0.4)),
        (
            "coloured",
            finish(Rgb::new(0.9, 0.1, 0.5), Rgb::new(0.0, 0.8, 0.2), Rgb::new(0.1, 0.1, 0.3), 0.6),
        ),
    ];
    for (name, finish) in whites {
        for angle_deg in ANGLES_DEG {
            for c in 0..3 {
                let (specular, error) = reflected(&finish, angle_deg, c);
                let whole = finish.diffuse.colour.0[c] + specular;
                assert!(whole < 1.0 + SIGMAS * error + 1e-12, "{name} {angle_deg} {c}: {whole}");
            }
        }
    }
}

#[test]
fn mirror_and_gloss_add() {
    let (mirror, f0) = (Rgb::new(0.3, 0.4, 0.2), Rgb::new(0.2, 0.1, 0.3));
    let both = finish(Rgb::BLACK, mirror, f0, 0.4);
    let gloss = finish(Rgb::BLACK, Rgb::BLACK, f0, 0.4);
    check_sum(&both, &gloss, mirror);
}

fn check_sum(both: &Finish, gloss: &Finish, mirror: Rgb) {
    for angle_deg in [0.0, 40.0, 65.0] {
        for c in 0..3 {
            let ((sum, a), (alone, b)) =
                (reflected(both, angle_deg, c), reflected(gloss, angle_deg, c));
            let allowed = SIGMAS * libm::hypot(a, b);
            let expected = alone + mirror.0[c];
            assert!((sum - expected).abs() < allowed, "{angle_deg} {c}: {sum} for {expected}");
        }
    }
}

#[test]
fn mirror_and_gloss_of_different_colours_add() {
    let (mirror, f0) = (Rgb::new(0.5, 0.0, 0.0), Rgb::new(0.0, 0.4, 0.0));
    let both = finish(Rgb::BLACK, mirror, f0, 0.4);
    let gloss = finish(Rgb::BLACK, Rgb::BLACK, f0, 0.4);
    check_sum(&both, &gloss, mirror);
}

#[test]
fn nothing_goes_below_the_surface() {
    let rough = finish(Rgb::BLACK, Rgb::grey(0.3), Rgb::grey(0.5), 1.0);
    // A shading normal turned by 40 degrees from the surface.
    let tilted = SurfacePoint { shading: Vector::new(0.6, 0.0, 0.8).normal().unwrap(), ..place() };
    for angle_deg in ANGLES_DEG {
        for k in 0..500 {
            let mut dice = dice(k);
            let ([pick, _], square) = (dice.pair(), dice.pair());
            let next = reflect(&rough, &tilted, incoming(angle_deg), pick, square);
            assert!(next.is_none_or(|s| s.direction.to_vector().z > 0.0));
        }
    }
}

#[test]
fn paint_has_no_specular_part() {
    let paint = Body::Opaque { front: Finish::diffuse(Rgb::WHITE), back: Finish::BLACK };
    let next = specular_step(&paint, &place(), incoming(30.0), Rgb::WHITE, &mut dice(1));
    assert!(next.is_none());
}
