//! Distributions against quadrature and against their own samples.

mod chi_square;
mod flux;
mod frame;
mod hostile;

use super::{AngleSystem, IntensityDistribution, PhotometricWeb, Symmetry};
use isolux_geometry::{Direction, Vector};
use std::sync::Arc;

/// The direction at C and gamma, degrees.
fn direction(c_deg: f64, gamma_deg: f64) -> Direction {
    let (sin_c, cos_c) = libm::sincos(c_deg.to_radians());
    let (sin_gamma, cos_gamma) = libm::sincos(gamma_deg.to_radians());
    Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma).direction().unwrap()
}

/// Uneven angles, a dark sector, zeros at the axis, light above the horizontal.
fn lopsided() -> PhotometricWeb {
    let planes = vec![10.0, 90.0, 95.0, 200.0, 300.0];
    let gammas = vec![0.0, 5.0, 30.0, 90.0, 91.0, 140.0];
    let candela = vec![
        0.0, 100.0, 900.0, 20.0, 0.0, 0.0, //
        0.0, 300.0, 100.0, 5.0, 70.0, 30.0, //
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, 50.0, 400.0, 400.0, 10.0, 200.0,
    ];
    PhotometricWeb::new(planes, gammas, candela).unwrap()
}

/// An axially symmetric table of f(gamma in degrees).
fn axial(gammas_deg: Vec<f64>, f: impl Fn(f64) -> f64) -> PhotometricWeb {
    let candela = gammas_deg.iter().map(|&g| f(g)).collect();
    PhotometricWeb::new(vec![0.0], gammas_deg, candela).unwrap()
}

fn quarter() -> PhotometricWeb {
    let candela = vec![500.0, 400.0, 0.0, 500.0, 300.0, 50.0, 500.0, 600.0, 100.0];
    let (planes, gammas) = (vec![0.0, 45.0, 90.0], vec![0.0, 45.0, 90.0]);
    PhotometricWeb::with_symmetry(planes, gammas, candela, Symmetry::AboutBoth).unwrap()
}

/// A lopsided beam in a system with its polar axis across.
fn floodlight(system: AngleSystem) -> PhotometricWeb {
    let planes = vec![30.0, 80.0, 95.0, 180.0];
    let poles = vec![0.0, 70.0, 90.0, 120.0];
    let candela = vec![
        5.0, 20.0, 50.0, 0.0, //
        5.0, 300.0, 900.0, 20.0, //
        5.0, 100.0, 700.0, 30.0, //
        5.0, 0.0, 10.0, 60.0,
    ];
    PhotometricWeb::in_system(system, planes, poles, candela).unwrap()
}

/// One of each kind, with names for messages.
fn every_kind() -> Vec<(&'static str, IntensityDistribution)> {
    use IntensityDistribution::*;
    let web = |web: PhotometricWeb| Web(Arc::new(web));
    vec![
        ("isotropic", Isotropic { intensity_cd: 100.0 }),
        ("even hemisphere", CosinePower { peak_cd: 80.0, exponent: 0.0 }),
        ("Lambertian", CosinePower { peak_cd: 80.0, exponent: 1.0 }),
        ("narrow beam", CosinePower { peak_cd: 5e4, exponent: 120.0 }),
        ("spot", Spot { peak_cd: 1000.0, inner_rad: 0.3, outer_rad: 0.8 }),
        ("spot without plateau", Spot { peak_cd: 1000.0, inner_rad: 0.0, outer_rad: 2.5 }),
        ("lopsided web", web(lopsided())),
        ("quarter web", web(quarter())),
        ("floodlight of type A", web(floodlight(AngleSystem::A))),
        ("floodlight of type B", web(floodlight(AngleSystem::B))),
        ("axial web", web(axial(vec![0.0, 20.0, 60.0, 180.0], |g| 180.0 - g))),
        ("web of one strip", web(axial(vec![0.0, 180.0], |_| 50.0))),
        (
            "closed web",
            web(PhotometricWeb::new(
                vec![0.0, 180.0, 360.0],
                vec![30.0, 60.0],
                vec![1.0, 4.0, 9.0, 1.0, 3.0, 4.0],
            )
            .unwrap()),
        ),
    ]
}
