//! What a pane of glass does to light (Born and Wolf, "Principles of Optics", 1.5 and 7.6, without interference).

use super::Dielectric;
use crate::units::Rgb;

/// Reflectance and transmittance of a pane for unpolarized light, with all inner reflections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    /// The share that goes back.
    pub reflectance: Rgb,
    /// The share that goes on.
    pub transmittance: Rgb,
}

impl Dielectric {
    /// A pane of two parallel faces, at the cosine of the angle of incidence. For each polarization, with the reflectance R of a face and
    /// the share t left by one crossing, `T = (1 - R)^2 t / (1 - R^2 t^2)` is transmitted and `R (1 + t T)` reflected. The result is the
    /// mean of the two polarizations. Light that slants in the glass goes a longer way, and t is the power of what is left at right angles.
    pub fn pane(&self, cos: f64) -> Pane {
        let faces = fresnel(cos, self.ior);
        let crossing = self.crossing(cos);
        let transmitted = |r: f64, t: f64| {
            let lost = 1.0 - r * r * t * t;
            if lost > 0.0 { (1.0 - r) * (1.0 - r) * t / lost } else { 0.0 }
        };
        Pane {
            reflectance: crossing.map(|t| mean(faces.map(|r| r * (1.0 + t * transmitted(r, t))))),
            transmittance: crossing.map(|t| mean(faces.map(|r| transmitted(r, t)))),
        }
    }

    /// The share left by one crossing. An index of one is that of a film, which has no thickness.
    fn crossing(&self, cos: f64) -> Rgb {
        let sin2 = (1.0 - cos * cos) / (self.ior * self.ior);
        if self.ior == 1.0 || self.transmittance == Rgb::WHITE || sin2 >= 1.0 {
            return self.transmittance;
        }
        let way = 1.0 / (1.0 - sin2).sqrt();
        self.transmittance.map(|t| libm::pow(t, way))
    }
}

/// Mean of the two polarizations.
pub(crate) fn mean([a, b]: [f64; 2]) -> f64 {
    0.5 * (a + b)
}

/// Fresnel reflectance for both polarizations, from the side of index 1 to that of index `ior`.
pub(crate) fn fresnel(cos: f64, ior: f64) -> [f64; 2] {
    let cos = cos.clamp(0.0, 1.0);
    let sin2 = (1.0 - cos * cos) / (ior * ior);
    if sin2 >= 1.0 {
        return [1.0; 2];
    }
    let inside = (1.0 - sin2).sqrt();
    let perpendicular = (cos - ior * inside) / (cos + ior * inside);
    let parallel = (ior * cos - inside) / (ior * cos + inside);
    [perpendicular * perpendicular, parallel * parallel]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By bounces: each inner crossing leaves the power of what is left at right angles, each face its own share.
    #[test]
    fn slanting_light_goes_a_longer_way() {
        let glass = Dielectric { ior: 1.5, transmittance: Rgb::grey(0.8), thin: true };
        for deg in [0.0_f64, 30.0, 60.0, 85.0] {
            let (sine, cos) = libm::sincos(deg.to_radians());
            let t = libm::pow(0.8, 1.0 / libm::cos(libm::asin(sine / 1.5)));
            let by_bounces = fresnel(cos, 1.5).map(|r| {
                (0..60)
                    .map(|k| (1.0 - r) * t * libm::pow(r * t, 2.0 * f64::from(k)) * (1.0 - r))
                    .sum()
            });
            let found = glass.pane(cos).transmittance.luminance();
            assert!((found - mean(by_bounces)).abs() < 1e-12, "{deg}: {found}");
        }
        let film = Dielectric { ior: 1.0, ..glass };
        assert!((film.pane(0.3).transmittance.luminance() - 0.8).abs() < 1e-12);
    }
}
