//! What is asked of an engine and what it says while it works.

use crate::engine::method::{IrradianceCache, RadiositySettings};
use crate::map::{Accuracy, Method};
use std::time::Duration;

/// What to compute, and when to stop.
#[derive(Clone, Debug, PartialEq)]
pub struct SolveRequest {
    /// Which engine.
    pub method: Method,
    /// Stop when the whole error of the scene is this fraction; `None` runs until the time limit or
    /// until stopped.
    pub accuracy: Option<f64>,
    /// Subdivide until the bare interpolated map is this good (a fraction); best effort.
    pub mesh_accuracy: f64,
    /// Stop after this time with a valid map.
    pub time_limit: Option<Duration>,
    /// Seed: the same seed gives the same bits.
    pub seed: u64,
    /// Whether to take noise off where the map shows nothing else.
    pub filter: bool,
    /// Whether an independent test of the map decides, too, whether its accuracy is reached.
    pub audit: bool,
    /// Refuse to need more memory than this, bytes.
    pub max_memory_bytes: u64,
    /// Samples that the `cache` method starts from.
    pub cache: IrradianceCache,
    /// How finely radiosity works.
    pub radiosity: RadiositySettings,
}

/// Memory of a vertex, bytes: the subdivision with its edges, the operator's entries at the fewest
/// rays, sums and values. Measured on rooms; rounded up.
pub(crate) const BYTES_A_VERTEX: u64 = 2400;

impl SolveRequest {
    /// Receivers that fit into the memory allowed, about.
    pub const fn most_receivers(&self) -> usize {
        (self.max_memory_bytes / BYTES_A_VERTEX) as usize
    }
}

impl Default for SolveRequest {
    /// One per cent, within what a small machine has.
    fn default() -> Self {
        Self {
            method: Method::Hybrid,
            accuracy: Some(0.01),
            mesh_accuracy: 0.05,
            time_limit: None,
            seed: 1,
            filter: true,
            audit: true,
            max_memory_bytes: 8 << 30,
            cache: IrradianceCache::default(),
            radiosity: RadiositySettings::default(),
        }
    }
}

/// What an engine is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Finding out where elements are needed.
    Pilot,
    /// Accumulating increments.
    Increments,
}

/// The state of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Increments accumulated.
    pub increments: u64,
    /// Error of the scene; `None` until it can be believed.
    pub accuracy: Option<Accuracy>,
    /// The share of all light that is unshot, of radiosity.
    pub unshot: Option<f64>,
    /// Accuracy asked for.
    pub target: Option<f64>,
    /// Vertices of the elements.
    pub receivers: u64,
    /// Rays traced.
    pub rays: u64,
    /// Those of them that an earlier run has traced, which this one goes on from.
    pub earlier_rays: u64,
    /// Time since the start, s.
    pub elapsed_s: f64,
    /// When it will be done; `None` until it can be said.
    pub prediction: Option<Prediction>,
    /// Whether the run ends here of itself.
    pub ends: bool,
}

impl Progress {
    /// Rays traced per second.
    pub fn rays_per_s(&self) -> f64 {
        (self.rays - self.earlier_rays) as f64 / self.elapsed_s.max(1e-9)
    }
}

/// A predicted finishing time, s since the start, with an interval of 90 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// Most likely.
    pub finish_s: f64,
    /// Not before.
    pub earliest_s: f64,
    /// Not after.
    pub latest_s: f64,
}

/// What a run would need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreseen {
    /// Vertices of the elements that it would come to.
    pub receivers: u64,
    /// When it would be done; `None` where the method does not tell, or no accuracy is asked for.
    pub finish: Option<Prediction>,
}

/// The answer to a progress report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    /// Go on.
    Continue,
    /// Go on; so long it was held up by whoever watches, which is no time of the run.
    After(Duration),
    /// Go on even where the run would end of itself, on the same elements.
    Insist,
    /// Stop after this increment, with a valid map.
    Stop,
}

/// Why there is no map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The scene has no luminaire and no emitting surface.
    #[error("the scene has no light; add a luminaire or an emitting material")]
    NoLight,
    /// No surface carries a map.
    #[error(
        "no surface of the scene can carry a map: all of them are mirrors, glass or lamps that reflect nothing"
    )]
    NoReceiver,
    /// It would take more memory than allowed.
    #[error("the map needs about {needed} bytes, more than the {allowed} allowed")]
    Memory {
        /// Bytes needed.
        needed: u64,
        /// Bytes allowed.
        allowed: u64,
    },
    /// There is more light in the map than luminaires can have brought.
    #[error(
        "the map has {mean_lx:.3e} lx of reflected light in the mean, where the light of all luminaires comes to {allowed_lx:.3e} lx at most: it is wrong and is not written"
    )]
    MoreThanEnergy {
        /// Mean of indirect light, lx.
        mean_lx: f64,
        /// The most that it can be, lx.
        allowed_lx: f64,
    },
    /// The saved state is that of another run.
    #[error("the saved run differs in {0}; solve without resuming, or ask for the same again")]
    OtherRun(&'static str),
}
