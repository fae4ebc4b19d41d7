//! How much two distributions differ.

use isolux::geometry::{Direction, Vector};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};

/// Directions compared: so many degrees apart, besides every node of both tables.
const GAMMA_STEP_DEG: f64 = 1.0;
const PLANES: u32 = 144;

/// The difference of two distributions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Largest difference of intensity, cd, over every node of both tables and a grid of 1 by 2.5 degrees.
    pub largest_cd: f64,
    /// Root mean square of it over all directions of the grid, weighted by solid angle, cd.
    pub rms_cd: f64,
    /// Flux of the second less that of the first, lm.
    pub flux_lm: f64,
}

impl Difference {
    /// Between two tables.
    pub fn between(first: &PhotometricWeb, second: &PhotometricWeb) -> Self {
        let apart = |at: Direction| (first.intensity_cd(at) - second.intensity_cd(at)).abs();
        let nodes = first.nodes().chain(second.nodes());
        let at_nodes = nodes.filter_map(|(at, _)| Some(apart(at.direction()?)));
        let mut largest_cd = at_nodes.fold(0.0, f64::max);
        let (mut squares, mut solid_angle) = (0.0, 0.0);
        for ring in 0..(180.0 / GAMMA_STEP_DEG) as u32 {
            let gamma = ((f64::from(ring) + 0.5) * GAMMA_STEP_DEG).to_radians();
            let (sin_gamma, cos_gamma) = libm::sincos(gamma);
            for plane in 0..PLANES {
                let c = std::f64::consts::TAU * (f64::from(plane) + 0.5) / f64::from(PLANES);
                let (sin_c, cos_c) = libm::sincos(c);
                let at = Vector::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma);
                let Some(at) = at.direction() else { continue };
                let apart = apart(at);
                largest_cd = largest_cd.max(apart);
                squares += apart * apart * sin_gamma;
                solid_angle += sin_gamma;
            }
        }
        Self {
            largest_cd,
            rms_cd: (squares / solid_angle).sqrt(),
            flux_lm: second.luminous_flux_lm() - first.luminous_flux_lm(),
        }
    }

    /// Between a table and whatever another distribution is; `None` if that is no table.
    pub fn to(first: &PhotometricWeb, second: &IntensityDistribution) -> Option<Self> {
        match second {
            IntensityDistribution::Web(second) => Some(Self::between(first, second)),
            IntensityDistribution::Isotropic { .. }
            | IntensityDistribution::CosinePower { .. }
            | IntensityDistribution::Spot { .. } => None,
        }
    }
}
