//! The methods of computing a map: hybrid, forward, radiosity and cache; beside them the textbook path
//! tracer.

mod cache;
mod caustics;
mod forward;
pub(crate) mod hybrid;
mod radiosity;
mod reference;
pub(crate) mod tally;

pub(crate) use cache::Cached;
pub use cache::{
    CACHE_REPLICATES, CacheError, CacheReader, CacheSample, CacheSettings, CachedPlace,
    IrradianceCache, SampleKind, Served,
};
#[cfg(test)]
pub(crate) use caustics::deposit;
pub(crate) use forward::Forward;
pub(crate) use hybrid::{Hybrid, IncrementSize, READERS};
pub(crate) use radiosity::{Left, Radiosity};
pub use radiosity::{RadiosityLimits, RadiositySettings};
pub(crate) use reference::Traced;
pub use reference::{Coefficients, Daylight, PathTracer, Sensitivity};
#[cfg(test)]
pub(crate) use tally::Tally;
