//! The closed forms of the flux against sums over the sphere.

use super::*;
use std::f64::consts::PI;

/// Midpoint rule in gamma and C, degrees apart as given.
fn quadrature(distribution: &IntensityDistribution, per_degree: u32) -> f64 {
    let step = 1.0 / f64::from(per_degree);
    let mut sum = 0.0;
    for g in 0..180 * per_degree {
        let gamma = (f64::from(g) + 0.5) * step;
        let ring: f64 = (0..360 * per_degree)
            .map(|c| distribution.intensity_cd(direction((f64::from(c) + 0.5) * step, gamma)))
            .sum();
        sum += ring * libm::sin(gamma.to_radians());
    }
    sum * step.to_radians() * step.to_radians()
}

#[test]
fn flux_is_the_integral_of_intensity() {
    for (name, distribution) in every_kind() {
        let (exact, sum) = (distribution.luminous_flux_lm(), quadrature(&distribution, 2));
        // The midpoint rule's leading error, h^2 / 24 times the slope of intensity times sine at
        // the axis, is (n + 1) h^2 / 24 of a beam cos^n: 3.9e-4 for the narrow one.
        assert!((exact - sum).abs() < 4e-4 * exact, "{name}: {exact} against {sum}");
    }
}

#[test]
fn a_constant_table_has_the_flux_of_the_sphere() {
    for gammas in [vec![0.0, 180.0], (0..=180).map(f64::from).collect(), vec![0.0, 1e-3, 180.0]] {
        let flux = axial(gammas, |_| 7.0).luminous_flux_lm();
        // 180 additions of rounded weights.
        assert!((flux - 28.0 * PI).abs() < 28.0 * PI * 180.0 * f64::EPSILON, "{flux}");
    }
}

#[test]
fn a_fine_table_of_a_cosine_approaches_its_flux_quadratically() {
    let error = |step_deg: f64| {
        let count = (90.0 / step_deg).round() as usize;
        let gammas = (0..=count).map(|k| 90.0 * k as f64 / count as f64).collect();
        let web = axial(gammas, |g| 1000.0 * libm::cos(g.to_radians()).max(0.0));
        1000.0 * PI - web.luminous_flux_lm()
    };
    let (coarse, fine) = (error(5.0), error(2.5));
    assert!(coarse > 0.0, "chords lie below the cosine");
    // Second order: 4, up to the next term, a thousandth of it at these steps.
    assert!((coarse / fine - 4.0).abs() < 0.01, "{coarse} / {fine}");
}

#[test]
fn symmetric_halves_and_quarters_have_the_flux_of_the_whole() {
    let gammas = vec![0.0, 40.0, 90.0];
    let row = |c: f64| {
        let side = libm::cos(c.to_radians());
        [100.0, 50.0 + 20.0 * side * side, 10.0 * side * side]
    };
    let table = |planes: &[f64], symmetry| {
        let candela = planes.iter().flat_map(|&c| row(c)).collect();
        PhotometricWeb::with_symmetry(planes.to_vec(), gammas.clone(), candela, symmetry).unwrap()
    };
    let every = |from: i32, to: i32| (from..=to).map(|k| f64::from(15 * k)).collect::<Vec<_>>();
    let whole = table(&every(0, 24), Symmetry::None).luminous_flux_lm();
    for (planes, symmetry) in [
        (every(0, 23), Symmetry::None),
        (every(0, 12), Symmetry::AboutC0C180),
        (every(6, 18), Symmetry::AboutC90C270),
        (every(0, 6), Symmetry::AboutBoth),
    ] {
        let flux = table(&planes, symmetry).luminous_flux_lm();
        // Rounding of cosines that should be equal and of a hundred additions.
        assert!((flux - whole).abs() < 1e-13 * whole, "{symmetry:?}: {flux} against {whole}");
    }
}

#[test]
fn cones_hold_their_share_of_the_flux() {
    let even = axial(vec![0.0, 30.0, 180.0], |_| 7.0);
    for (gamma, share) in [(0.0, 0.0), (10.0, 0.5 - 0.5 * libm::cos(10.0_f64.to_radians()))]
        .into_iter()
        .chain([(90.0, 0.5), (180.0, 1.0)])
    {
        let flux = even.flux_below_lm(gamma);
        // Sums of rounded weights.
        assert!((flux - 28.0 * PI * share).abs() < 1e-13 * 28.0 * PI, "{gamma}: {flux}");
    }
    for web in [lopsided(), quarter(), floodlight(AngleSystem::A)] {
        let whole = web.luminous_flux_lm();
        assert!((web.flux_below_lm(180.0) - whole).abs() < 1e-13 * whole);
        assert!(web.flux_below_lm(60.0) < web.flux_below_lm(60.1));
    }
    // Nothing lies below the angles given.
    assert_eq!(axial(vec![30.0, 60.0], |_| 5.0).flux_below_lm(29.0), 0.0);
}

#[test]
fn scaling_scales_everything() {
    for (name, distribution) in every_kind() {
        let scaled = distribution.scaled(0.25);
        // A power of two: exact.
        assert_eq!(scaled.luminous_flux_lm(), 0.25 * distribution.luminous_flux_lm(), "{name}");
        assert_eq!(scaled.max_intensity_cd(), 0.25 * distribution.max_intensity_cd(), "{name}");
        assert_eq!(scaled.sample([0.3, 0.6]), distribution.sample([0.3, 0.6]), "{name}");
        let dark = distribution.scaled(0.0);
        assert_eq!((dark.luminous_flux_lm(), dark.sample([0.5, 0.5])), (0.0, None), "{name}");
    }
}
