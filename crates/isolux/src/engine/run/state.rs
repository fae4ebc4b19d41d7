//! A run between two increments: integers and counters, enough to go on bit for bit.

use super::request::{SolveError, SolveRequest};
use crate::engine::method::RadiositySettings;
use crate::engine::ray::{Accumulator, Sums};
use crate::map::Method;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// What a run has summed so far. The elements are not part of it: the pilot makes the same again.
#[derive(Clone, Debug, PartialEq)]
pub struct RunState {
    /// Of which run it is.
    pub identity: RunIdentity,
    /// Which mesh, counted from one: later stages have finer ones.
    pub stage: u32,
    /// Rays traced, pilots included.
    pub rays: u64,
    /// Increments summed; none if the run was stopped before its mesh was complete.
    pub increments: u64,
    /// What audits have found on the way.
    pub audited: Audited,
    /// Sums of the receivers.
    pub receivers: Vec<Sums>,
    /// Sums of the check points.
    pub checks: Vec<Sums>,
    /// Sum of the light on paths that were given up: one, or none where there are no increments.
    pub given_up: Vec<Sums>,
}

/// What the audits of a run have come to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audited {
    /// How many there were.
    pub audits: u32,
    /// How many times the error told the true one is; one until an audit has contradicted a claim.
    pub true_over_told: f64,
    /// The noise that was told after so many increments, powers of two, relative.
    pub noise: Vec<(u64, f64)>,
}

impl Default for Audited {
    /// No audit yet.
    fn default() -> Self {
        Self { audits: 0, true_over_told: 1.0, noise: Vec::new() }
    }
}

/// Everything that decides what an increment of a run is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// [`Scene::hash`].
    pub scene_hash: String,
    /// Version of isolux.
    pub version: String,
    /// Engine.
    pub method: Method,
    /// Seed.
    pub seed: u64,
    /// Accuracy asked for: elements and rays are made for it.
    pub accuracy: Option<f64>,
    /// Accuracy asked of the bare map.
    pub mesh_accuracy: f64,
    /// Memory allowed, which bounds elements and rays, bytes.
    pub max_memory_bytes: u64,
    /// How finely radiosity works.
    #[serde(default)]
    pub radiosity: RadiositySettings,
    /// Whether audits decide when it is done.
    #[serde(default)]
    pub audit: bool,
}

impl RunState {
    /// Whether it is of the run that a request asks for.
    pub fn is_of(&self, scene: &Scene, request: &SolveRequest) -> bool {
        self.identity == RunIdentity::of(scene, request)
    }
}

impl RunIdentity {
    pub(crate) fn of(scene: &Scene, request: &SolveRequest) -> Self {
        Self {
            scene_hash: scene.hash(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            method: request.method,
            seed: request.seed,
            accuracy: request.accuracy,
            mesh_accuracy: request.mesh_accuracy,
            max_memory_bytes: request.max_memory_bytes,
            radiosity: request.radiosity,
            audit: request.audit,
        }
    }

    /// Whether a saved run is this one; else what differs.
    pub(crate) fn check(&self, saved: &Self) -> Result<(), SolveError> {
        let differs = [
            ("the scene", self.scene_hash == saved.scene_hash),
            ("the version of isolux", self.version == saved.version),
            ("the method", self.method == saved.method),
            ("the seed", self.seed == saved.seed),
            ("the accuracy", self.accuracy == saved.accuracy),
            ("the mesh accuracy", self.mesh_accuracy == saved.mesh_accuracy),
            ("the memory allowed", self.max_memory_bytes == saved.max_memory_bytes),
            ("the limits of radiosity", self.radiosity == saved.radiosity),
            ("whether it is audited", self.audit == saved.audit),
        ];
        match differs.iter().find(|(_, same)| !same) {
            Some((what, _)) => Err(SolveError::OtherRun(what)),
            None => Ok(()),
        }
    }
}

/// Puts saved sums back; refused where their number is another.
pub(crate) fn restore(
    accumulator: &mut Accumulator,
    saved: &[Sums],
    increments: u64,
) -> Result<(), SolveError> {
    if accumulator.sums.len() != saved.len() {
        return Err(SolveError::OtherRun("the number of receivers"));
    }
    accumulator.sums.copy_from_slice(saved);
    accumulator.increments = increments;
    Ok(())
}
