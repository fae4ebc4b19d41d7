//! A lamp over a pane of glass over a black floor, under a black ceiling.
//!
//! Unpolarized light is half of each polarization, and each goes its own way through both faces: with
//! the reflectance R of one face for it (Fresnel) and the share t left by one crossing of the pane on the way that light slants there,
//! the reflections inside sum to `T = (1 - R)^2 t / (1 - R^2 t^2)` and
//! `R' = R (1 + t T)`; the answer is the mean over the two polarizations (Born and Wolf, "Principles of
//! Optics", 1.5 and 7.6, without interference). Averaging R first is wrong by up to some per cent at
//! grazing angles. The pane is thin: light goes straight on, and the ceiling sees the image
//! of the lamp in it. Geometry is exact.

use crate::expectation::{Bound, Case, Expectation};
use crate::model::{Rectangle, isotropic};
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Normal, Point};
use isolux::scene::{Body, Dielectric, Finish, Material, SceneParts};
use isolux::units::Rgb;

const LAMP_CD: f64 = 1000.0;
const LAMP_M: [f64; 3] = [0.0, 0.0, 2.0];
const PANE_Z_M: f64 = 1.0;
const CEILING_Z_M: f64 = 3.0;
const IOR: f64 = 1.5;
/// Share left by one crossing of the tinted pane at right angles.
const TINT: Rgb = Rgb::new(0.9, 0.7, 0.4);

pub(super) fn cases() -> [Case; 2] {
    [
        Case {
            name: "glass_clear",
            notes: "a lamp through and in a clear pane: Fresnel, inner reflections summed",
            parts: || parts("glass_clear", Rgb::WHITE),
            expectations: || expectations(Rgb::WHITE),
        },
        Case {
            name: "glass_tinted",
            notes: "a lamp through and in a tinted pane",
            parts: || parts("glass_tinted", TINT),
            expectations: || expectations(TINT),
        },
    ]
}

fn parts(name: &str, transmittance: Rgb) -> SceneParts {
    let level = |z: f64| Rectangle::new([-4.0, -4.0, z], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]);
    let ceiling = Rectangle::new([-4.0, -4.0, CEILING_Z_M], [0.0, 8.0, 0.0], [8.0, 0.0, 0.0]);
    SceneParts {
        name: name.into(),
        shapes: vec![
            level(0.0).shape("floor", 0),
            ceiling.shape("ceiling", 0),
            level(PANE_Z_M).shape("pane", 1),
        ],
        materials: vec![Material::one_sided("black", Finish::BLACK), pane_material(transmittance)],
        luminaires: vec![isotropic("lamp", LAMP_M.into(), LAMP_CD)],
        ..SceneParts::default()
    }
}

/// Thin glass of index 1.5.
pub(super) fn pane_material(transmittance: Rgb) -> Material {
    let body = Body::Dielectric(Dielectric { ior: IOR, transmittance, thin: true });
    Material { name: "pane".into(), body }
}

/// What a pane does to unpolarized light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pane {
    /// Share that goes on.
    pub(super) transmitted: f64,
    /// Share that goes back.
    pub(super) reflected: f64,
}

/// Reflectances of one face for light polarized across and along the plane of incidence.
fn fresnel(cos_theta: f64) -> [f64; 2] {
    let sin2 = 1.0 - cos_theta * cos_theta;
    let cos_inside = (1.0 - sin2 / (IOR * IOR)).sqrt();
    let across = (cos_theta - IOR * cos_inside) / (cos_theta + IOR * cos_inside);
    let along = (IOR * cos_theta - cos_inside) / (IOR * cos_theta + cos_inside);
    [across * across, along * along]
}

/// At an angle of incidence, with the share left by one crossing at right angles. Light that slants in the glass goes a longer way through
/// it (Bouguer's law).
pub(super) fn pane(cos_theta: f64, straight_on: f64) -> Pane {
    let cos_inside = (1.0 - (1.0 - cos_theta * cos_theta) / (IOR * IOR)).sqrt();
    let t = libm::pow(straight_on, 1.0 / cos_inside);
    let [across, along] = fresnel(cos_theta).map(|r| {
        let transmitted = (1.0 - r) * (1.0 - r) * t / (1.0 - r * r * t * t);
        Pane { transmitted, reflected: r * (1.0 + t * transmitted) }
    });
    Pane {
        transmitted: 0.5 * (across.transmitted + along.transmitted),
        reflected: 0.5 * (across.reflected + along.reflected),
    }
}

fn expectations(transmittance: Rgb) -> Vec<Expectation> {
    let lamp = Point::from(LAMP_M);
    let image = Point::new(lamp.x, lamp.y, 2.0 * PANE_Z_M - lamp.z);
    // Lines from lamp and image to these places cross the pane within its borders.
    let offsets = [0.0, 0.3, 0.8, 1.5, 2.4, 3.2];
    let floor = offsets.map(|x| {
        let position = Point::new(x, -0.5 * x, 0.0);
        let (lx, cos_theta) = plain_lx(lamp, position);
        let at = ProbePoint { position, normal: Normal::Z };
        (at, transmittance.map(|t| lx * pane(cos_theta, t).transmitted))
    });
    let ceiling = offsets.map(|x| {
        let position = Point::new(x, -0.5 * x, CEILING_Z_M);
        let ((direct, _), (mirrored, cos_theta)) =
            (plain_lx(lamp, position), plain_lx(image, position));
        let at = ProbePoint { position, normal: (-Direction::Z).to_normal() };
        (at, transmittance.map(|t| direct + mirrored * pane(cos_theta, t).reflected))
    });
    floor
        .into_iter()
        .chain(ceiling)
        .flat_map(|(at, lx)| Expectation::direct_only(at, lx, Bound::EXACT_GEOMETRY))
        .collect()
}

/// Without the pane, on a horizontal surface: illuminance and cosine.
fn plain_lx(source: Point, at: Point) -> (f64, f64) {
    let d = source - at;
    let cos_theta = d.z.abs() / d.length();
    (LAMP_CD * cos_theta / d.length_squared(), cos_theta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    #[test]
    fn a_pane_of_plain_glass_passes_92_per_cent_head_on() {
        // R = ((1.5 - 1) / (1.5 + 1))^2 = 1/25, T = (1 - R) / (1 + R) = 12/13.
        let head_on = pane(1.0, 1.0);
        assert!((head_on.transmitted - 12.0 / 13.0).abs() < ROUNDING);
    }

    #[test]
    fn a_clear_pane_loses_nothing() {
        for k in 1..=20 {
            let p = pane(f64::from(k) / 20.0, 1.0);
            assert!((p.transmitted + p.reflected - 1.0).abs() < ROUNDING, "{k}");
        }
    }

    #[test]
    fn the_sums_are_those_of_the_bounces() {
        for (cos_theta, straight_on) in [(0.9, 0.7), (0.3, 1.0), (0.1, 0.4)] {
            // As long as the way is: Snell's angle in the glass.
            let inside_rad = libm::asin(libm::sin(libm::acos(cos_theta)) / IOR);
            let t = libm::pow(straight_on, 1.0 / libm::cos(inside_rad));
            let mut sums = [0.0; 2];
            for r in fresnel(cos_theta) {
                let (mut inside, mut reflected, mut transmitted) = ((1.0 - r) * t, r, 0.0);
                for _ in 0..200 {
                    transmitted += inside * (1.0 - r);
                    inside *= r * t;
                    reflected += inside * (1.0 - r);
                    inside *= r * t;
                }
                sums = [sums[0] + 0.5 * transmitted, sums[1] + 0.5 * reflected];
            }
            let closed = pane(cos_theta, straight_on);
            assert!((closed.transmitted - sums[0]).abs() < ROUNDING);
            assert!((closed.reflected - sums[1]).abs() < ROUNDING);
        }
    }
}
