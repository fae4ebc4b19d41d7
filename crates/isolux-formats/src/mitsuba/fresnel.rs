//! Fresnel's equations for unpolarized light, and their mean over a hemisphere.

/// Steps of the mean: its error is below 1e-5 for the indices of glass and metals.
const STEPS: u32 = 512;

/// Reflectance of a conductor of index eta + i k at the cosine of the angle of incidence (Born and
/// Wolf, Principles of Optics, 14.2).
pub(super) fn conductor(cos: f64, eta: f64, k: f64) -> f64 {
    let (cos2, sin2) = (cos * cos, 1.0 - cos * cos);
    let t0 = eta * eta - k * k - sin2;
    let a2_b2 = (t0 * t0 + 4.0 * eta * eta * k * k).sqrt();
    let a = (0.5 * (a2_b2 + t0)).max(0.0).sqrt();
    let s = (a2_b2 + cos2 - 2.0 * a * cos) / (a2_b2 + cos2 + 2.0 * a * cos);
    let (u, v) = (cos2 * a2_b2 + sin2 * sin2, 2.0 * a * cos * sin2);
    let p = s * (u - v) / (u + v);
    0.5 * (s + p)
}

/// Reflectance between media of relative index `ior`, the cosine on the outer side; 1 beyond the
/// critical angle.
pub(super) fn dielectric(cos: f64, ior: f64) -> f64 {
    let sin2 = (1.0 - cos * cos) / (ior * ior);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let inner = (1.0 - sin2).sqrt();
    let s = (cos - ior * inner) / (cos + ior * inner);
    let p = (ior * cos - inner) / (ior * cos + inner);
    0.5 * (s * s + p * p)
}

/// The mean of a reflectance over light that comes from everywhere alike: the integral of
/// 2 cos R(cos) over the cosine, by the midpoint rule in its square.
pub(super) fn mean(reflectance: impl Fn(f64) -> f64) -> f64 {
    let at = |k: u32| reflectance(((f64::from(k) + 0.5) / f64::from(STEPS)).sqrt());
    (0..STEPS).map(at).sum::<f64>() / f64::from(STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // ((n - 1) / (n + 1))^2, and the same for metals.
        assert!((dielectric(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((conductor(1.0, 1.5, 0.0) - 0.04).abs() < 1e-15);
        let (n, k): (f64, f64) = (0.2, 3.9);
        let due = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
        assert!((conductor(1.0, n, k) - due).abs() < 1e-14);
        // A conductor without absorption is a dielectric.
        for cos in [0.05, 0.3, 0.7] {
            assert!((conductor(cos, 1.5, 0.0) - dielectric(cos, 1.5)).abs() < 1e-12, "{cos}");
        }
        // Means of index 1.5 from outside and inside (Walsh 1926: 0.0918; Egan and Hilgeman 1979: 0.596).
        assert!((mean(|c| dielectric(c, 1.5)) - 0.0918).abs() < 5e-5);
        assert!((mean(|c| dielectric(c, 1.0 / 1.5)) - 0.5963).abs() < 5e-4);
    }
}
