//! The state of a run between two increments: integers and counters, from which it continues bit for bit.

use super::request::{SolveError, SolveRequest};
use crate::engine::method::RadiositySettings;
use crate::engine::plan::PilotResult;
use crate::engine::ray::Sums;
use crate::map::Method;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// The number of stages that halve the error which elements are made for.
pub(crate) const STAGES_TO_HALF: u32 = 4;
/// The largest number of stages, after which a run keeps what it has. The last one has elements for an eighth of the
/// accuracy goal.
pub(crate) const MOST_STAGES: u32 = 3 * STAGES_TO_HALF + 1;

/// The sums of a run so far.
#[derive(Clone, Debug, PartialEq)]
pub struct RunState {
    /// The identity of the run.
    pub identity: RunIdentity,
    /// The number of the mesh, counted from one. Later stages have finer meshes.
    pub stage: u32,
    /// The number of rays traced, pilots included.
    pub rays: u64,
    /// The number of increments summed; zero if the run was stopped before its mesh was complete.
    pub increments: u64,
    /// The results of the audits so far.
    pub audited: Audited,
    /// Whether the time limit left no time for finer elements, and the run went on with the present ones. It has made
    /// other increments since than a run without a limit.
    pub stayed_coarse: bool,
    /// The sums of the receivers.
    pub receivers: Vec<Sums>,
    /// The sums of the check points, then those of the checked parts of elements.
    pub checks: Vec<Sums>,
    /// The sum of the light on paths given up: one entry, or none where there are no increments.
    pub given_up: Vec<Sums>,
    /// The pilot of the stage; without it, a run makes the same one again.
    pub pilot: Option<PilotState>,
}

/// The result of a pilot, with the run that it belongs to.
#[derive(Clone, Debug)]
pub struct PilotState {
    /// The identity of the run.
    pub identity: RunIdentity,
    /// The number of the mesh, counted from one.
    pub stage: u32,
    /// The number of rays traced before the first increment on this mesh.
    pub rays: u64,
    /// The elements, the light known on them, and its noise.
    pub result: PilotResult,
}

impl PilotState {
    /// Compares the result with the scene.
    pub(crate) fn check(&self, scene: &Scene) -> Result<(), SolveError> {
        let is_stage = (1..=MOST_STAGES).contains(&self.stage);
        let is_sound = is_stage && self.result.is_of(scene);
        if is_sound { Ok(()) } else { Err(SolveError::Unsound("the saved pilot")) }
    }
}

impl PartialEq for PilotState {
    /// Pilots of one run and one stage are the same.
    fn eq(&self, other: &Self) -> bool {
        (&self.identity, self.stage, self.rays) == (&other.identity, other.stage, other.rays)
    }
}

/// The results of the audits of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audited {
    /// The number of audits.
    pub audits: u32,
    /// The ratio of the true error to the reported one; one until an audit has contradicted a claim.
    pub true_over_told: f64,
    /// The relative noise reported after each number of increments that is a power of two.
    pub noise: Vec<(u64, f64)>,
}

impl Default for Audited {
    /// The results before the first audit.
    fn default() -> Self {
        Self { audits: 0, true_over_told: 1.0, noise: Vec::new() }
    }
}

/// The inputs that determine each increment of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// The hash of the scene: [`Scene::hash`].
    pub scene_hash: String,
    /// The version of isolux.
    pub version: String,
    /// A hash of the engine's sources, which two builds of one version may differ in.
    #[serde(default)]
    pub build: String,
    /// The method of computation.
    pub method: Method,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The relative accuracy goal; elements and rays are made for it.
    pub accuracy: Option<f64>,
    /// The relative accuracy goal of the stored (interpolated) map.
    pub mesh_accuracy: f64,
    /// The allowed memory, bytes. It bounds elements and rays.
    pub max_memory_bytes: u64,
    /// The settings of radiosity.
    #[serde(default)]
    pub radiosity: RadiositySettings,
    /// Whether audits also decide when the run ends.
    #[serde(default)]
    pub audit: bool,
}

impl RunState {
    /// Whether the state belongs to the run that a request describes.
    pub fn is_of(&self, scene: &Scene, request: &SolveRequest) -> bool {
        self.identity == RunIdentity::of(scene, request)
    }
}

impl RunIdentity {
    pub(crate) fn of(scene: &Scene, request: &SolveRequest) -> Self {
        Self {
            scene_hash: scene.hash(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            build: env!("SOURCES_HASH").to_owned(),
            method: request.method,
            seed: request.seed,
            accuracy: request.accuracy,
            mesh_accuracy: request.mesh_accuracy,
            max_memory_bytes: request.max_memory_bytes,
            radiosity: request.radiosity,
            audit: request.audit,
        }
    }

    /// Compares the identity with that of a saved run. The error names the first difference.
    pub(crate) fn check(&self, saved: &Self) -> Result<(), SolveError> {
        self.difference(saved).map_or(Ok(()), |what| Err(SolveError::OtherRun(what)))
    }

    /// The first difference from another identity.
    pub fn difference(&self, saved: &Self) -> Option<&'static str> {
        let same = [
            ("the scene", self.scene_hash == saved.scene_hash),
            ("the version of isolux", self.version == saved.version),
            ("the build of isolux", self.build == saved.build),
            ("the method", self.method == saved.method),
            ("the seed", self.seed == saved.seed),
            ("the accuracy", self.accuracy == saved.accuracy),
            ("the mesh accuracy", self.mesh_accuracy == saved.mesh_accuracy),
            ("the memory allowed", self.max_memory_bytes == saved.max_memory_bytes),
            ("the limits of radiosity", self.radiosity == saved.radiosity),
            ("whether it is audited", self.audit == saved.audit),
        ];
        same.iter().find(|(_, same)| !same).map(|(what, _)| *what)
    }
}
