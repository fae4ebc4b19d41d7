//! Engines: from a scene to an illumination map.
//!
//! Rooms, each of which knows only those before it: `ray`, `mesh`, `light`, `occlusion`, `gather`, `particle`,
//! `plan`, `judge`, `read`, `method`, `combine`, `audit`, `pilot`, `run`.

mod audit;
mod combine;
mod gather;
mod judge;
mod light;
mod mesh;
mod method;
mod occlusion;
mod particle;
mod pilot;
mod plan;
mod ray;
mod read;
mod run;

#[cfg(test)]
mod tests;

pub use audit::{AuditSettings, audit, audit_watched, energy_balance};
pub use combine::{Finer, FinerSettings, MixError, MixPart, Mixed, mix, mix_apart};
pub use light::{Arrival, Highlighted, Highlights, ShadowRays, Shining, arrivals};
pub use method::{
    CACHE_REPLICATES, CacheError, CacheReader, CacheSample, CacheSettings, CachedPlace,
    Coefficients, Daylight, IrradianceCache, PathTracer, RadiosityLimits, RadiositySettings,
    SampleKind, Sensitivity, Served,
};
pub use ray::{ProbePoint, Sensor, StopFlag, Sums};
pub use read::{
    Allowance, ExactSettings, IndirectReading, MapReader, PictureLight, Told, net, reference_lx,
};
pub use run::{
    Audited, Elsewhere, Foreseen, MergeError, PartMaker, PilotState, Prediction, Progress,
    RunIdentity, RunPart, RunState, Segment, SoFar, Solution, SolveError, SolveRequest, Stage,
    Watch, Watcher, foresee, make_pilot, solve, solve_elsewhere, solve_looked_at, solve_merged,
    with_parts,
};
