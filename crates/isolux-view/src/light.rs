//! The colour of the light of a scene, and how far eyes adapt to it.

use crate::colorimetry::XYZ_FROM_REC709;
use isolux::scene::{Luminaire, LuminaireKind, Scene};
use isolux::units::Rgb;
use std::f64::consts::PI;

/// The adapting luminance of eyes in a room, cd/m2: a fifth of what white paper has in 300 lx.
const ADAPTING_CD_M2: f64 = 20.0;
/// Distances from the colours of black bodies, in CIE 1960 uv, up to which eyes adapt as to those, and from which on a colour looks coloured
/// (CIE 015:2018 gives no colour temperature from there on).
const NEAR_WHITES: [f64; 2] = [0.02, 0.05];
/// Reciprocal temperatures of white light, in 1e-6 / K: from 12 500 K to 1600 K.
const MIREDS: std::ops::RangeInclusive<u32> = 80..=625;

/// The colour of the light of a scene, of luminance 1: the mean over its luminaires by their flux. Light from far away counts by what falls
/// through the box around the scene, in the mean over all directions. `None` for a scene without light.
pub fn colour_of_light(scene: &Scene) -> Option<Rgb> {
    let sum: Rgb = light_of_groups(scene).into_iter().sum();
    (sum.luminance() > 0.0 && sum.is_finite()).then(|| sum.chromaticity())
}

/// The light of the luminaires of each group, lm in three channels; surfaces that shine are in the first, and so are all luminaires of a
/// scene without groups. Whoever dims groups adds them up, each times its factor.
pub fn light_of_groups(scene: &Scene) -> Vec<Rgb> {
    let mut light = vec![Rgb::BLACK; scene.groups().len().max(1)];
    for of in scene.area_luminaires() {
        light[0] += of.luminance_cd_m2.chromaticity() * of.luminous_flux_lm();
    }
    let flux_lm = |of: &Luminaire| match &of.kind {
        LuminaireKind::Point { intensity, .. } => intensity.luminous_flux_lm(),
        LuminaireKind::Directional { illuminance_lx, .. } => illuminance_lx * mean_shadow_m2(scene),
        LuminaireKind::Sky { sky, .. } => 4.0 * PI * sky.mean_cd_m2() * mean_shadow_m2(scene),
    };
    for of in scene.luminaires() {
        light[of.group as usize] += of.colour * flux_lm(of);
    }
    light
}

/// The mean area of the shadow of the box around a scene: a quarter of its surface (Cauchy 1841).
fn mean_shadow_m2(scene: &Scene) -> f64 {
    scene.bvh().mesh().bounds().map_or(0.0, |(low, high)| {
        let size = high - low;
        0.5 * (size.x * size.y + size.y * size.z + size.z * size.x)
    })
}

/// The degree to which eyes in a room adapt to light: D of CIECAM02 (CIE 159:2004) in an average surround, and less the more coloured
/// the light is.
pub(crate) fn degree_of_eyes(light: Rgb) -> f64 {
    let degree = 1.0 - libm::exp(-(ADAPTING_CD_M2 + 42.0) / 92.0) / 3.6;
    let [near, far] = NEAR_WHITES;
    degree * ((far - from_whites(light)) / (far - near)).clamp(0.0, 1.0)
}

/// The distance of a colour from those of black bodies, in CIE 1960 uv.
fn from_whites(light: Rgb) -> f64 {
    let [x, y, z] = XYZ_FROM_REC709.apply(light.chromaticity().0);
    let sum = x + 15.0 * y + 3.0 * z;
    let (u, v) = (4.0 * x / sum, 6.0 * y / sum);
    let off = |mired: u32| {
        let (pu, pv) = black_body_uv(1e6 / f64::from(mired));
        libm::hypot(u - pu, v - pv)
    };
    MIREDS.map(off).fold(f64::INFINITY, f64::min)
}

/// The chromaticity of a black body in CIE 1960 uv, to 1e-4 between 1000 and 15 000 K (Krystek 1985, "An algorithm to calculate correlated
/// colour temperature").
fn black_body_uv(t: f64) -> (f64, f64) {
    let quadratic = |a: f64, b: f64, c: f64| a + b * t + c * t * t;
    let u = quadratic(0.860_117_757, 1.541_182_54e-4, 1.286_412_12e-7)
        / quadratic(1.0, 8.424_202_35e-4, 7.081_451_63e-7);
    let v = quadratic(0.317_398_726, 4.228_062_45e-5, 4.204_816_91e-8)
        / quadratic(1.0, -2.897_418_16e-5, 1.614_560_53e-7);
    (u, v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_bodies_and_daylight_are_whites_and_colours_are_not() {
        // Illuminant A is a black body of 2856 K: x = 0.44757, y = 0.40745, u = 0.2560, v = 0.3495.
        let (u, v) = black_body_uv(2856.0);
        assert!((u - 0.2560).abs() < 2e-4 && (v - 0.3495).abs() < 2e-4, "{u} {v}");
        for white in [Rgb::WHITE, Rgb::new(1.8, 0.86, 0.19)] {
            assert!(degree_of_eyes(white) > 0.85, "{white:?}");
        }
        for colour in [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.1, 1.0, 0.1), Rgb::new(0.0, 0.0, 1.0)] {
            assert!(degree_of_eyes(colour) == 0.0, "{colour:?}");
        }
    }
}
