//! The balance of the energy of a scene, and of a map.

use serde::{Deserialize, Serialize};

/// A luminous flux with its standard error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeasuredFlux {
    /// The flux, lm.
    pub lm: f64,
    /// Its standard error, lm.
    pub standard_error_lm: f64,
}

/// Where the light of a scene goes, as particles find it, and the light on its surfaces beside that of a map. What is
/// emitted is absorbed, escapes, or is given up, particle by particle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// The number of particles.
    pub particles: u64,
    /// The number of rays that they took.
    pub rays: u64,
    /// The flux of all luminaires, lm.
    pub emitted_lm: f64,
    /// The flux that surfaces absorb.
    pub absorbed: MeasuredFlux,
    /// The flux that leaves the scene.
    pub escaped: MeasuredFlux,
    /// The flux on paths that were given up.
    pub given_up: MeasuredFlux,
    /// The flux that arrives at the surfaces of the map, reflected light included, by particles.
    pub arriving: MeasuredFlux,
    /// The same by the map: the integral of its illuminance.
    pub mapped_lm: f64,
    /// The largest difference of the two that the map's error and the particles' noise explain, lm.
    pub explained_lm: f64,
    /// The surfaces where they differ by more than that explains, the worst first.
    pub surfaces: Vec<SurfaceBalance>,
}

/// The light that arrives at a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceBalance {
    /// The name of the shape.
    pub shape: String,
    /// Its flux by particles.
    pub arriving: MeasuredFlux,
    /// Its flux by the map, lm.
    pub mapped_lm: f64,
    /// The largest difference that errors explain, lm.
    pub explained_lm: f64,
}

impl EnergyBalance {
    /// Whether the map has the light that particles find, on the whole and on every surface.
    pub fn holds(&self) -> bool {
        (self.arriving.lm - self.mapped_lm).abs() <= self.explained_lm && self.surfaces.is_empty()
    }

    /// Standard errors that noise may reach. Of sixteen replicates, Student's distribution exceeds six in one case of
    /// 40,000.
    pub const DEVIATIONS: f64 = 6.0;
}
