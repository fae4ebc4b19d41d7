//! The three photometric types of the hall, by formulas, rounded as a laboratory's report would be.
//!
//! `g` is gamma, `C` the angle of the half-plane, both in degrees; an edge is the logistic step
//! `1 / (1 + exp((g - at) / width))` of a reflector's rim.
//!
//! - Downlight: `4750 * 2^-(g / 12.5)^2 + 60 cos g`: half of the peak at 12.5 degrees (a beam of 25
//!   degrees), and stray light of the rim.
//! - Batwing: `1035 cos g (1 + 1.2 sin^2 C exp(-((g - 38) / 15)^2)) edge(g; 66, 3.5)`: C0 along the
//!   luminaire; two wings across it, shielded above 65 degrees.
//! - Wall washer: `1360 exp(9 (cos d - 1)) edge(g; 78, 3) + 60 cos g`, where d is the angle to the axis of
//!   its lobe, 40 degrees off the vertical in C0.

use isolux::photometry::{IntensityDistribution, PhotometricWeb, Symmetry};
use std::sync::Arc;

/// A photometric type as a file would give it.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Name of its file, without folder and extension.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Input power, W.
    pub watts: f64,
    /// Width (in C90), length (in C0) and height of its opening, m, round where negative (LM-63).
    pub opening_m: [f64; 3],
    /// Half-planes, degrees; the rest follows from the symmetry.
    pub planes_deg: Vec<f64>,
    /// Which part of the circle the planes give.
    pub symmetry: Symmetry,
    /// Gamma angles, degrees.
    pub gammas_deg: Vec<f64>,
    /// Intensities, cd, to a tenth: `candela[plane * gammas + gamma]`.
    pub candela: Vec<f64>,
}

/// The downlight, the batwing and the wall washer.
pub fn lamps() -> [Lamp; 3] {
    [downlight(), batwing(), washer()]
}

impl Lamp {
    /// What the engine uses.
    pub fn distribution(&self) -> IntensityDistribution {
        let Self { planes_deg, gammas_deg, candela, symmetry, .. } = self.clone();
        let web = PhotometricWeb::with_symmetry(planes_deg, gammas_deg, candela, symmetry);
        IntensityDistribution::Web(Arc::new(web.expect("the formulas give valid tables")))
    }

    /// Angles up to 90 degrees in C and to the end of the circle that a symmetry leaves.
    fn tabulated(
        self,
        planes_to_deg: f64,
        step_deg: f64,
        candela: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let steps = |to: f64, step: f64| {
            (0..=(to / step) as u32).map(|k| step * f64::from(k)).collect::<Vec<_>>()
        };
        let (planes_deg, gammas_deg) = (steps(planes_to_deg, 15.0), steps(90.0, step_deg));
        let tenths = |cd: f64| (10.0 * cd).round() / 10.0;
        let row = |&c: &f64| gammas_deg.iter().map(|&g| tenths(candela(g, c))).collect::<Vec<_>>();
        let candela = planes_deg.iter().flat_map(row).collect();
        Self { planes_deg, gammas_deg, candela, ..self }
    }
}

fn cos_deg(angle_deg: f64) -> f64 {
    isolux::units::sincos_deg(angle_deg).1
}

fn sin_deg(angle_deg: f64) -> f64 {
    isolux::units::sincos_deg(angle_deg).0
}

fn edge(gamma_deg: f64, at_deg: f64, width_deg: f64) -> f64 {
    1.0 / (1.0 + libm::exp((gamma_deg - at_deg) / width_deg))
}

fn square(x: f64) -> f64 {
    x * x
}

fn blank(name: &'static str, description: &'static str, symmetry: Symmetry) -> Lamp {
    Lamp {
        name,
        description,
        watts: 0.0,
        opening_m: [0.0; 3],
        planes_deg: Vec::new(),
        symmetry,
        gammas_deg: Vec::new(),
        candela: Vec::new(),
    }
}

fn downlight() -> Lamp {
    let description = "Recessed round downlight, 25 degree beam";
    let lamp = blank("downlight", description, Symmetry::Axial);
    Lamp { watts: 11.0, opening_m: [-0.09, -0.09, 0.0], ..lamp }
        .tabulated(0.0, 2.5, |g, _| 4750.0 * libm::exp2(-square(g / 12.5)) + 60.0 * cos_deg(g))
}

fn batwing() -> Lamp {
    let description = "Linear luminaire, 0.9 m, batwing across its length";
    let lamp = blank("batwing", description, Symmetry::AboutBoth);
    Lamp { watts: 28.0, opening_m: [0.06, 0.9, 0.0], ..lamp }.tabulated(90.0, 5.0, |g, c| {
        let wings = 1.2 * square(sin_deg(c)) * libm::exp(-square((g - 38.0) / 15.0));
        1035.0 * cos_deg(g) * (1.0 + wings) * edge(g, 66.0, 3.5)
    })
}

fn washer() -> Lamp {
    let description = "Wall washer, lobe aimed 40 degrees off the vertical towards C0";
    let lamp = blank("washer", description, Symmetry::AboutC0C180);
    Lamp { watts: 12.0, opening_m: [0.1, 0.1, 0.0], ..lamp }.tabulated(180.0, 5.0, |g, c| {
        let cos_to_axis = cos_deg(40.0) * cos_deg(g) + sin_deg(40.0) * sin_deg(g) * cos_deg(c);
        1360.0 * libm::exp(9.0 * (cos_to_axis - 1.0)) * edge(g, 78.0, 3.0) + 60.0 * cos_deg(g)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the types were asked to be, and to what the formulas were scaled.
    #[test]
    fn fluxes_are_those_of_the_types() {
        for (lamp, low_lm, high_lm) in
            [(downlight(), 1150.0, 1250.0), (batwing(), 3400.0, 3600.0), (washer(), 1050.0, 1150.0)]
        {
            let flux_lm = lamp.distribution().luminous_flux_lm();
            assert!((low_lm..high_lm).contains(&flux_lm), "{}: {flux_lm}", lamp.name);
        }
    }

    #[test]
    fn the_beam_of_the_downlight_opens_by_25_degrees() {
        let lamp = downlight();
        let at = |deg: f64| lamp.candela[(deg / 2.5) as usize];
        // Stray light is a hundredth of the peak.
        assert!((at(12.5) / at(0.0) - 0.5).abs() < 0.01);
    }

    #[test]
    fn the_washer_leans_to_c0_and_the_batwing_spreads_across() {
        let (washer, batwing) = (washer(), batwing());
        let at = |lamp: &Lamp, plane: usize, deg: f64| {
            lamp.candela[plane * lamp.gammas_deg.len() + (deg / 5.0) as usize]
        };
        assert!(at(&washer, 0, 40.0) > 10.0 * at(&washer, 12, 40.0));
        assert!(at(&batwing, 6, 35.0) > 1.2 * at(&batwing, 6, 0.0));
        assert!(at(&batwing, 0, 35.0) < at(&batwing, 0, 0.0));
    }
}
