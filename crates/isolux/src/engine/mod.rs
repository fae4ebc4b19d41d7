//! Engines: from a scene to an illumination map.

mod accumulate;
mod direct;
mod gather;
mod path;
mod request;
mod scatter;
mod surface;

pub use request::{Prediction, Progress, SolveError, SolveRequest, Stage, Watch};

use crate::map::{Illuminance, IlluminationMap};
use crate::scene::Scene;
use isolux_geometry::{Normal, Point};

/// Computes the illumination map of a scene.
///
/// `watch` is called after every increment and may stop the run; the map is valid then, too.
pub fn solve(
    _scene: &Scene,
    _request: &SolveRequest,
    _watch: &mut dyn FnMut(&Progress) -> Watch,
) -> Result<IlluminationMap, SolveError> {
    Err(SolveError::NoLight)
}

/// A place and the way a luxmeter faces there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbePoint {
    /// Where, m.
    pub position: Point,
    /// Where it faces.
    pub normal: Normal,
}

/// Reads a map at a point of a surface: direct light evaluated afresh, indirect light interpolated.
/// `None` where no surface that carries a known value lies within `reach_m` behind the point.
pub fn probe(_scene: &Scene, _map: &IlluminationMap, _at: ProbePoint) -> Option<Illuminance> {
    None
}

/// Estimates the illuminance at any point, on a surface or not, by gathering once over the map.
/// `rays` a replicate, `replicates` independent ones for the standard error.
pub fn probe_exact(
    _scene: &Scene,
    _map: &IlluminationMap,
    _at: ProbePoint,
    _settings: &ExactSettings,
) -> Illuminance {
    Illuminance {
        direct_lx: crate::units::Rgb::BLACK,
        caustic_lx: crate::units::Rgb::BLACK,
        indirect_lx: crate::units::Rgb::BLACK,
        standard_error_lx: 0.0,
        indirect_standard_error_lx: 0.0,
        samples: 0,
    }
}

/// How hard [`probe_exact`] tries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactSettings {
    /// Gathering rays of one replicate.
    pub rays: u32,
    /// Independent replicates.
    pub replicates: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { rays: 1024, replicates: 16, seed: 1 }
    }
}
