//! Skies, the sun, and daylight coefficients.

use super::*;
use crate::engine::method::{Daylight, PathTracer};
use crate::engine::ray::ProbePoint;
use crate::engine::read::ExactSettings;
use crate::photometry::{GeneralSky, Sky, SkyPatches};
use isolux_geometry::Direction;
use std::f64::consts::PI;

/// A room of 4 x 5 x 3 m whose wall at y = 0 is open above one metre, below a sky.
fn room(sky: Sky, more: Vec<Luminaire>) -> Scene {
    let mut shapes = inward_box([4.0, 5.0, 3.0], 0);
    let is_front = |shape: &Shape| shape.positions.iter().all(|p| p[1] == 0.0);
    shapes.retain(|shape| !is_front(shape));
    shapes.push(rectangle([0.0; 3], [0.0, 0.0, 1.0], [4.0, 0.0, 0.0], 0));
    let kind = LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky };
    let sky = Luminaire { name: "sky".into(), group: 0, colour: Rgb::WHITE, kind };
    let luminaires = [vec![sky], more].concat();
    scene(shapes, vec![painted(Rgb::grey(0.5))], luminaires)
}

fn desk() -> ProbePoint {
    let normal = Vector::new(0.0, 0.0, 1.0).normal().unwrap();
    ProbePoint { position: Point::new(1.5, 2.5, 0.8), normal }
}

/// Coefficients times luminances are what paths below that sky bring. Both have noise: 4.5 standard errors of both together.
#[test]
fn daylight_coefficients_add_up_to_the_light_of_a_sky() {
    let sky = GeneralSky::cie(1, Direction::Z).unwrap().with_horizontal_lx(1e4).unwrap();
    let scene = room(Sky::General { sky, ground_cd_m2: 500.0 }, vec![]);
    let settings = ExactSettings { rays: 4096, ..ExactSettings::default() };
    let traced = PathTracer::new(&scene).estimate(desk(), &settings);
    let patches = SkyPatches::reinhart(4).unwrap();
    let daylight = Daylight::new(&scene).unwrap();
    let found = daylight.coefficients(desk(), &patches, &settings);
    let of = |coefficients: &[f64]| {
        let (ground, sky_of) = coefficients.split_last().unwrap();
        let one = |(patch, c): (usize, &f64)| c * sky.luminance_cd_m2(patches.middle(patch));
        ground * 500.0 + sky_of.iter().enumerate().map(one).sum::<f64>()
    };
    let direct: Vec<f64> = found.iter().map(|c| of(&c.direct)).collect();
    let indirect: Vec<f64> = found.iter().map(|c| of(&c.indirect)).collect();
    for (name, values, lx) in [
        ("direct", direct, traced.direct_lx.luminance()),
        ("indirect", indirect, traced.indirect_lx.luminance()),
    ] {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance =
            values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count * (count - 1.0));
        let error = (variance + traced.standard_error_lx.powi(2)).sqrt();
        // The luminance in the middle of a patch stands for its mean: to a thousandth.
        assert!((mean - lx).abs() < 4.5 * error + 1e-3 * lx, "{name}: {mean} {lx} +- {error}");
        assert!(error < 0.05 * lx, "{name}: {error} of {lx}");
    }
}

/// The sun gives its illuminance times the cosine where it is seen, and half of that where half its disc is.
#[test]
fn the_sun_is_a_disc() {
    // It stands over the sill, 1 m up and 2.5 m away, as seen from the desk.
    let sun = |elevation_deg: f64| {
        let (sin, cos) = libm::sincos(elevation_deg.to_radians());
        Vector::new(0.0, -cos, sin).direction().unwrap()
    };
    let edge_deg = libm::atan(0.2 / 2.5).to_degrees();
    let half_deg = 0.2665_f64;
    for (above_deg, share) in [(2.0, 1.0), (0.0, 0.5), (-1.0, 0.0)] {
        let towards = sun(edge_deg + above_deg);
        let kind = LuminaireKind::Directional {
            direction: -towards,
            illuminance_lx: 1e5,
            half_angle_rad: half_deg.to_radians(),
        };
        let disc = Luminaire { name: "sun".into(), group: 0, colour: Rgb::WHITE, kind };
        let none = Sky::General { sky: GeneralSky::uniform(0.0), ground_cd_m2: 0.0 };
        let scene = room(none, vec![disc]);
        let settings = ExactSettings { rays: 1024, ..ExactSettings::default() };
        let read = PathTracer::new(&scene).estimate(desk(), &settings);
        let expected = share * 1e5 * towards.to_vector().z;
        let off = (read.direct_lx.luminance() - expected).abs();
        // The upper half of the disc has a slightly larger cosine: by 0.42 of its half angle over the sine of the elevation.
        let tolerance = 4.5 * read.standard_error_lx + 0.5 * 1e5 * half_deg.to_radians();
        let allowed = if share == 0.5 { tolerance } else { 1e-3 * expected };
        assert!(off <= allowed, "{above_deg}: {} {expected}", read.direct_lx.luminance());
        let straight =
            Daylight::new(&scene).unwrap().share_of_sun(desk(), sun(edge_deg + above_deg));
        if share != 0.5 {
            assert!((straight - share * towards.to_vector().z).abs() < 1e-9, "{straight}");
        }
    }
}

/// A horizontal place below an open sky, and one that faces the horizon over a bright ground: the closed forms.
#[test]
fn open_places_have_the_light_of_half_the_sky() {
    let floor = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0);
    let sky = Sky::General { sky: GeneralSky::uniform(1000.0), ground_cd_m2: 200.0 };
    let kind = LuminaireKind::Sky { world_from_sky: Transform::IDENTITY, sky };
    let sky = Luminaire { name: "sky".into(), group: 0, colour: Rgb::WHITE, kind };
    let scene = scene(vec![floor], vec![painted(Rgb::BLACK)], vec![sky]);
    let tracer = PathTracer::new(&scene);
    let read = |normal: [f64; 3]| {
        let normal = Vector::from(normal).normal().unwrap();
        // So high that the floor hides nothing.
        let at = ProbePoint { position: Point::new(0.5, 0.5, 1e4), normal };
        let read = tracer.estimate(at, &ExactSettings::default());
        (read.direct_lx.luminance(), read.standard_error_lx)
    };
    let (upwards, _) = read([0.0, 0.0, 1.0]);
    assert!((upwards / (1000.0 * PI) - 1.0).abs() < 1e-9, "{upwards}");
    let (sideways, error) = read([1.0, 0.0, 0.0]);
    let off = (sideways - 600.0 * PI).abs();
    assert!(
        off <= 4.5 * error + 1e-9 * sideways && error < 0.02 * sideways,
        "{sideways} +- {error}"
    );
}
