//! Engines: from a scene to an illumination map.

mod accumulate;
mod accuracy;
mod aim;
mod allot;
mod anderson;
mod arrivals;
mod audit;
mod backdrop;
mod bright;
mod cache;
mod carriers;
mod caustics;
mod checks;
mod coarsening;
mod cuts;
mod deadline;
mod detail;
mod direct;
mod emission;
mod energy;
mod feelers;
mod filter;
mod fit;
mod flights;
mod forecast;
mod forward;
mod gather;
mod hats;
mod held;
mod hidden;
mod highlights;
mod hybrid;
mod judged;
mod kept;
mod landed;
mod look;
mod means;
mod mirror_chain;
mod mix;
mod neighbours;
pub mod net;
mod noise;
mod particle;
mod parts;
mod path;
mod pilot;
mod place;
mod plan;
mod predict;
mod probe;
mod radiosity;
mod reference;
mod reflectance;
mod request;
mod run;
mod scale;
mod scatter;
mod shrink;
mod state;
mod surface;
mod tally;
mod torn;
mod trial;
mod trust;
mod views;
mod walls;
mod work;

#[cfg(test)]
mod tests;

pub use accumulate::Sums;
pub use arrivals::{Arrival, arrivals};
pub use audit::{AuditSettings, audit};
pub use cache::{
    CACHE_REPLICATES, CacheError, CacheReader, CacheSample, CacheSettings, CachedPlace,
    IrradianceCache, SampleKind, Served,
};
pub use highlights::{Highlighted, Highlights, Shining};
pub use mix::{MixError, MixPart, mix};
pub use place::ProbePoint;
pub use probe::{Allowance, ExactSettings, IndirectReading, MapReader, Told, reference_lx};
pub use radiosity::{RadiosityLimits, RadiositySettings};
pub use reference::PathTracer;
pub use request::{Foreseen, Prediction, Progress, SolveError, SolveRequest, Stage, Watch};
pub use run::{SoFar, Solution, Watcher, foresee, solve, solve_looked_at};
pub use state::{Audited, RunIdentity, RunState};
