//! Reflection and refraction at smooth dielectrics (Born and Wolf, "Principles of optics", 1.5).

use isolux::geometry::{Direction, Normal};
use isolux::scene::{Dielectric, Pane};
use isolux::units::Rgb;

/// Shares of the luminance seen in the mirror direction and through the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interface {
    pub(super) reflected: Rgb,
    /// Share and direction; `None` under total reflection.
    pub(super) transmitted: Option<(Rgb, Direction)>,
}

impl Interface {
    /// What `direction` meets at a surface whose `normal` faces it; `inside` says that it travels
    /// in the solid.
    pub(super) fn new(
        glass: &Dielectric,
        direction: Direction,
        normal: Normal,
        inside: bool,
    ) -> Self {
        let cos = (-direction.cos(normal)).clamp(0.0, 1.0);
        if glass.thin {
            return Self::pane(glass, direction, cos);
        }
        // Refractive index of the far side over that of the near side.
        let eta = if inside { 1.0 / glass.ior } else { glass.ior };
        let sin2_far = (1.0 - cos * cos) / (eta * eta);
        let towards =
            direction * (1.0 / eta) + normal * (cos / eta - (1.0 - sin2_far).max(0.0).sqrt());
        let (true, Some(refracted)) = (sin2_far < 1.0, towards.direction()) else {
            return Self { reflected: Rgb::WHITE, transmitted: None };
        };
        let r = mean(fresnel(eta, cos));
        // Luminance over the square of the index is what refraction conserves.
        let passed = glass.transmittance * ((1.0 - r) / (eta * eta));
        Self { reflected: Rgb::grey(r), transmitted: Some((passed, refracted)) }
    }

    /// Two parallel faces with all reflections between them: what is transmitted goes straight on.
    fn pane(glass: &Dielectric, direction: Direction, cos: f64) -> Self {
        let Pane { reflectance, transmittance } = glass.pane(cos);
        Self { reflected: reflectance, transmitted: Some((transmittance, direction)) }
    }
}

/// Unpolarised light is half of each polarisation.
fn mean([one, other]: [f64; 2]) -> f64 {
    0.5 * (one + other)
}

/// Fresnel reflectance of both polarisations; `eta` is the index beyond over the index before, `cos`
/// the cosine of the angle of incidence.
fn fresnel(eta: f64, cos: f64) -> [f64; 2] {
    let cos2_far = 1.0 - (1.0 - cos * cos) / (eta * eta);
    if cos2_far <= 0.0 {
        return [1.0; 2];
    }
    let cos_far = cos2_far.sqrt();
    let parallel = (eta * cos - cos_far) / (eta * cos + cos_far);
    let perpendicular = (cos - eta * cos_far) / (cos + eta * cos_far);
    [parallel * parallel, perpendicular * perpendicular]
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Vector;

    fn glass(thin: bool) -> Dielectric {
        Dielectric { ior: 1.5, transmittance: Rgb::WHITE, thin }
    }

    #[test]
    fn glass_reflects_four_per_cent_at_normal_incidence() {
        let down = -Direction::Z;
        let solid = Interface::new(&glass(false), down, Normal::Z, false);
        // ((n - 1) / (n + 1))^2, and for the pane 2 r / (1 + r).
        assert!((solid.reflected.0[0] - 0.04).abs() < 1e-15);
        let pane = Interface::new(&glass(true), down, Normal::Z, false);
        assert!((pane.reflected.0[0] - 0.08 / 1.04).abs() < 1e-15);
        assert!((pane.reflected.0[0] + pane.transmitted.unwrap().0.0[0] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn refraction_obeys_snell_and_turns_back() {
        let towards = Vector::new(0.6, 0.0, -0.8).direction().unwrap();
        let into = Interface::new(&glass(false), towards, Normal::Z, false);
        let (share_in, inner) = into.transmitted.unwrap();
        assert!((inner.to_vector().x - 0.6 / 1.5).abs() < 1e-15);
        let (share_out, outer) =
            Interface::new(&glass(false), inner, Normal::Z, true).transmitted.unwrap();
        assert!((outer.to_vector() - towards.to_vector()).length() < 1e-15 * 4.0);
        // In and out again the index cancels: what is left is (1 - r)^2.
        let r = into.reflected.0[0];
        assert!(((share_in * share_out).0[0] - (1.0 - r) * (1.0 - r)).abs() < 1e-15 * 4.0);
    }

    #[test]
    fn beyond_the_critical_angle_all_is_reflected() {
        let towards = Vector::new(0.8, 0.0, -0.6).direction().unwrap();
        let inside = Interface::new(&glass(false), towards, Normal::Z, true);
        assert_eq!(inside, Interface { reflected: Rgb::WHITE, transmitted: None });
        assert_eq!(fresnel(1.5, 0.0), [1.0; 2]);
    }
}
