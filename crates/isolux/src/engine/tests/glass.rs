//! Fresnel, Snell, and what is left of the light.

use super::*;
use crate::engine::ray::{Scattered, SurfacePoint, refract, specular_step};
use crate::scene::{Body, Dielectric};
use isolux_geometry::{Direction, Normal};

const ANGLES_DEG: [f64; 7] = [0.0, 10.0, 40.0, 56.31, 70.0, 85.0, 89.9];

fn glass(ior: f64, thin: bool) -> Dielectric {
    Dielectric { ior, transmittance: Rgb::WHITE, thin }
}

/// A place on the plane z = 0, seen from above or, as its back, from below.
fn place(back: bool) -> SurfacePoint {
    let up = if back { -Normal::Z } else { Normal::Z };
    SurfacePoint {
        triangle: 0,
        back,
        u: 0.3,
        v: 0.3,
        point: Point::ORIGIN,
        geometric: up,
        shading: up,
        away_m: 1e-6,
    }
}

/// Arriving at that side.
fn incoming(angle_deg: f64, back: bool) -> Direction {
    let (s, c) = libm::sincos(angle_deg.to_radians());
    direction([s, 0.0, if back { c } else { -c }])
}

/// The two ways on: reflected and transmitted, with their weights times their chances.
fn split(glass: &Dielectric, angle_deg: f64, back: bool) -> [Option<(Direction, Rgb)>; 2] {
    let (at, incoming) = (place(back), incoming(angle_deg, back));
    let picks = 4096;
    let mut found: [Option<(Direction, Rgb, f64)>; 2] = [None; 2];
    for k in 0..picks {
        let pick = (f64::from(k) + 0.5) / f64::from(picks);
        let Scattered { direction, weight, .. } = refract(glass, &at, incoming, pick);
        let through = usize::from(direction.cos(at.geometric) < 0.0);
        let (_, _, count) = found[through].get_or_insert((direction, weight, 0.0));
        *count += 1.0 / f64::from(picks);
    }
    found.map(|f| f.map(|(direction, weight, chance)| (direction, weight * chance)))
}

/// Chances are seen to one in so many.
const PICK: f64 = 1.0 / 4096.0;

fn share(part: Option<(Direction, Rgb)>) -> f64 {
    part.map_or(0.0, |(_, weight)| weight.luminance())
}

#[test]
fn clear_glass_loses_nothing() {
    for (ior, back) in
        [(1.5, false), (1.5, true), (1.33, false), (2.4, true), (0.8, false), (1.0, false)]
    {
        for thin in [false, true] {
            for angle_deg in ANGLES_DEG {
                let [reflected, through] = split(&glass(ior, thin), angle_deg, back);
                let whole = share(reflected) + share(through);
                // Either part is its weight, one, times its chance.
                assert!((whole - 1.0).abs() < 1e-12, "{ior} {back} {thin} {angle_deg}: {whole}");
            }
        }
    }
}

#[test]
fn reflectance_is_fresnels() {
    // Four per cent head-on; at Brewster's angle, atan 1.5, half of ((n2 - 1) / (n2 + 1))2, as the
    // parallel part is gone; all at grazing.
    let half_of_one = 0.5 * (1.25_f64 / 3.25).powi(2);
    for (angle_deg, expected) in [(0.0, 0.04), (56.309_932, half_of_one), (89.999_99, 1.0)] {
        let [reflected, _] = split(&glass(1.5, false), angle_deg, false);
        assert!((share(reflected) - expected).abs() < PICK, "{angle_deg}: {}", share(reflected));
    }
}

#[test]
fn reflectance_is_the_same_from_both_ends_of_the_way() {
    for ior in [1.33, 1.5, 2.4] {
        for angle_deg in [5.0_f64, 30.0, 60.0, 80.0] {
            let inside_deg = libm::asin(libm::sin(angle_deg.to_radians()) / ior).to_degrees();
            let [from_outside, _] = split(&glass(ior, false), angle_deg, false);
            let [from_inside, _] = split(&glass(ior, false), inside_deg, true);
            let difference = share(from_outside) - share(from_inside);
            assert!(difference.abs() < 1.01 * PICK, "{ior} {angle_deg}: {difference}");
        }
    }
}

#[test]
fn light_bends_after_snell_and_not_in_panes() {
    for ior in [1.33, 1.5, 0.8] {
        for back in [false, true] {
            for angle_deg in ANGLES_DEG {
                let sine = libm::sin(angle_deg.to_radians());
                let relative = if back { 1.0 / ior } else { ior };
                let [_, through] = split(&glass(ior, false), angle_deg, back);
                if sine / relative >= 1.0 {
                    assert!(through.is_none(), "{ior} {back} {angle_deg}: beyond total reflection");
                } else if let Some((direction, _)) = through {
                    let v = direction.to_vector();
                    assert!(
                        (v.x - sine / relative).abs() < 1e-12,
                        "{ior} {back} {angle_deg}: {v:?}"
                    );
                    assert!(v.y == 0.0 && (v.length() - 1.0).abs() < 1e-12);
                }
                let [reflected, straight] = split(&glass(ior, true), angle_deg, back);
                let incoming = incoming(angle_deg, back);
                assert!(straight.is_none_or(|(d, _)| d == incoming));
                let mirrored = incoming.reflect(Normal::Z);
                assert!(reflected.is_none_or(|(d, _)| (d.dot(mirrored) - 1.0).abs() < 1e-12));
            }
        }
    }
}

#[test]
fn a_clear_pane_passes_what_both_faces_and_their_echoes_leave() {
    let cos = |deg: f64| libm::cos(deg.to_radians());
    for ior in [1.33, 1.5, 1.9] {
        // Head-on both polarizations are one: (1 - R) / (1 + R) = 2 n / (n2 + 1).
        let head_on = glass(ior, true).pane(1.0).transmittance.luminance();
        assert!((head_on - 2.0 * ior / (ior * ior + 1.0)).abs() < 1e-12);
        let passed =
            ANGLES_DEG.map(|deg| glass(ior, true).pane(cos(deg)).transmittance.luminance());
        assert!(passed.windows(2).all(|w| w[1] < w[0] + 0.02), "{passed:?}");
        assert!(glass(ior, true).pane(0.0).transmittance.luminance().abs() < 1e-12);
    }
}

#[test]
fn tinted_glass_absorbs() {
    let tint = Rgb::new(0.9, 0.4, 0.0);
    for thin in [false, true] {
        let tinted = Dielectric { transmittance: tint, ..glass(1.5, thin) };
        for angle_deg in ANGLES_DEG {
            let [reflected, through] = split(&tinted, angle_deg, false);
            let weight = |part: Option<(Direction, Rgb)>| part.map_or(Rgb::BLACK, |(_, w)| w);
            let (reflected, through) = (weight(reflected), weight(through));
            for c in 0..3 {
                let whole = reflected.0[c] + through.0[c];
                // Chances are rounded to picks; weights of a rare way are large.
                assert!(whole < 1.0 + 4.0 * PICK, "{thin} {angle_deg}: {whole}");
                assert!(through.0[c] < tint.0[c] + 4.0 * PICK);
            }
            assert_eq!(through.0[2], 0.0);
        }
    }
}

#[test]
fn roulette_changes_no_mean() {
    // Mean throughput after one step, against the shares themselves.
    let tinted = Dielectric { transmittance: Rgb::new(0.8, 0.5, 0.2), ..glass(1.5, true) };
    let body = Body::Dielectric(tinted);
    for carried in [Rgb::WHITE, Rgb::new(0.05, 0.3, 0.02)] {
        for angle_deg in [0.0, 60.0, 80.0] {
            let (at, incoming) = (place(false), incoming(angle_deg, false));
            let step = |seed| specular_step(&body, &at, incoming, carried, &mut dice(seed));
            let [reflected, through] = split(&tinted, angle_deg, false);
            for c in 0..3 {
                let values = (0..20_000).map(|k| step(k).map_or(0.0, |s| s.weight.0[c]));
                let (mean, error) = mean_and_error(values);
                let part = |p: Option<(Direction, Rgb)>| p.map_or(0.0, |(_, w)| w.0[c]);
                let expected = part(reflected) + part(through);
                let allowed = SIGMAS * error + 2.0 * PICK;
                assert!((mean - expected).abs() < allowed, "{angle_deg} {c}: {mean} {expected}");
            }
        }
    }
}

#[test]
fn the_ray_goes_on_from_the_side_it_leaves() {
    for back in [false, true] {
        for pick in [0.0, 0.999] {
            let at = place(back);
            let at = SurfacePoint { point: Point::new(10.0, 0.0, 0.0), ..at };
            let next = refract(&glass(1.5, false), &at, incoming(30.0, back), pick);
            let side = next.ray.origin.z.signum();
            let leaves = next.direction.to_vector().z.signum();
            assert_eq!(side, leaves, "{back} {pick}");
            assert_eq!(next.ray.skip, Some(at.triangle));
        }
    }
}
