//! The request to an engine, and the progress that the engine reports.

use crate::engine::method::{IrradianceCache, RadiositySettings};
use crate::engine::ray::StopFlag;
use crate::map::{Accuracy, Method};
use std::ops::Range;
use std::time::Duration;

/// The request for a map: method, goals and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct SolveRequest {
    /// The method of computation.
    pub method: Method,
    /// The relative error of the scene at which the run ends. With `None` the run goes on until the time limit or until
    /// it is stopped.
    pub accuracy: Option<f64>,
    /// The relative error of the stored (interpolated) map for which elements are bisected; best effort.
    pub mesh_accuracy: f64,
    /// The time after which the run stops, with a valid map.
    pub time_limit: Option<Duration>,
    /// A request to stop the run, which others may raise: the run ends as at the time limit.
    pub stop: StopFlag,
    /// The seed of the random numbers. The same seed gives the same bits.
    pub seed: u64,
    /// Whether a filter reduces the noise of the map where it shows no other detail.
    pub filter: bool,
    /// Whether an independent audit of the map also decides if the accuracy is reached.
    pub audit: bool,
    /// The largest memory, bytes. Scenes that need more are refused.
    pub max_memory_bytes: u64,
    /// The samples that the `cache` method starts from.
    pub cache: IrradianceCache,
    /// The settings of radiosity.
    pub radiosity: RadiositySettings,
}

/// The memory of a vertex, bytes: the subdivision with its edges, the operator's entries at the fewest rays, sums and
/// values. Measured on rooms and rounded up.
pub(crate) const BYTES_A_VERTEX: u64 = 2400;

impl SolveRequest {
    /// The approximate number of receivers that fit into the allowed memory.
    pub const fn most_receivers(&self) -> usize {
        (self.max_memory_bytes / BYTES_A_VERTEX) as usize
    }
}

impl Default for SolveRequest {
    /// An accuracy of one per cent, within the memory of a small machine.
    fn default() -> Self {
        Self {
            method: Method::Hybrid,
            accuracy: Some(0.01),
            mesh_accuracy: 0.05,
            time_limit: None,
            stop: StopFlag::default(),
            seed: 1,
            filter: true,
            audit: true,
            max_memory_bytes: 8 << 30,
            cache: IrradianceCache::default(),
            radiosity: RadiositySettings::default(),
        }
    }
}

/// The stage of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The pilot refines the elements.
    Pilot,
    /// Increments are summed over fixed elements.
    Increments,
}

/// The progress of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// The present stage.
    pub stage: Stage,
    /// The number of increments so far.
    pub increments: u64,
    /// The error of the scene; `None` until increments are enough to know it.
    pub accuracy: Option<Accuracy>,
    /// The share of unshot light in all light; only for radiosity.
    pub unshot: Option<f64>,
    /// The accuracy goal, relative.
    pub target: Option<f64>,
    /// The number of vertices of the elements.
    pub receivers: u64,
    /// The number of rays traced.
    pub rays: u64,
    /// The part of `rays` that an earlier run has traced, which this one continues.
    pub earlier_rays: u64,
    /// The time since the start, s, without the pauses of a watcher.
    pub elapsed_s: f64,
    /// The predicted finishing time; `None` until it can be predicted.
    pub prediction: Option<Prediction>,
    /// Whether the run ends here without being stopped.
    pub ends: bool,
}

impl Progress {
    /// The number of rays that this run traces per second.
    pub fn rays_per_s(&self) -> f64 {
        (self.rays - self.earlier_rays) as f64 / self.elapsed_s.max(1e-9)
    }
}

/// A predicted finishing time, with an interval of 90 %. Times count from the start, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The most likely time, s.
    pub finish_s: f64,
    /// The lower end of the interval, s.
    pub earliest_s: f64,
    /// The upper end of the interval, s.
    pub latest_s: f64,
}

/// The predicted size and time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foreseen {
    /// The number of vertices that the elements would have, as far as their errors tell; `None` if there was no time to
    /// look at those.
    pub receivers: Option<u64>,
    /// The number that they have already: the least, as elements are only refined.
    pub receivers_so_far: u64,
    /// The finishing time; `None` if the method gives no prediction, or without an accuracy goal.
    pub finish: Option<Prediction>,
}

/// The answer to a progress report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watch {
    /// The run continues.
    Continue,
    /// The run continues. The watcher has held it up for this time, which does not count as time of the run.
    After(Duration),
    /// The run continues on the same elements, even if it would end here without being stopped.
    Insist,
    /// The run stops after this increment, with a valid map.
    Stop,
}

/// The reason why there is no map.
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
    /// The map would take more memory than allowed.
    #[error("the map needs about {needed} bytes, more than the {allowed} allowed")]
    Memory {
        /// The needed memory, bytes.
        needed: u64,
        /// The allowed memory, bytes.
        allowed: u64,
    },
    /// The map has more light than luminaires can cause.
    #[error(
        "the map has {mean_lx:.3e} lx of reflected light in the mean, where the light of all luminaires comes to {allowed_lx:.3e} lx at most: it is wrong and is not written"
    )]
    MoreThanEnergy {
        /// The mean of indirect light, lx.
        mean_lx: f64,
        /// The energy bound on this mean, lx.
        allowed_lx: f64,
    },
    /// The saved state belongs to another run.
    #[error("the saved run differs in {0}; solve without resuming, or ask for the same again")]
    OtherRun(&'static str),
    /// The method has no parts.
    #[error(
        "each increment of radiosity continues the one before it: use the method hybrid, cache or forward"
    )]
    Indivisible,
    /// Samples that a run of `cache` starts from are not part of its identity.
    #[error("runs that start from a cache of samples have no parts: solve without one")]
    StartsFromCache,
    /// A part of the run has increments, but the first ones are missing or there is a gap.
    #[error("increments {}..{} are missing", .0.start, .0.end)]
    Missing(Range<u64>),
    /// Increments made elsewhere cannot be had.
    #[error("{0}")]
    Elsewhere(String),
    /// The saved state or pilot contradicts itself or the scene.
    #[error("{0} does not fit the scene: it is damaged, or made by something else")]
    Unsound(&'static str),
}
