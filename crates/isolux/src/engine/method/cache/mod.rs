//! The irradiance cache: indirect light sampled where it is asked for, and carried over from there to the
//! places around by its gradients.
//!
//! As of Ward, Rubinstein, Clear (1988), "A ray tracing solution for diffuse interreflection", and Ward
//! and Heckbert (1992), "Irradiance gradients". There are two kinds of samples. Those that are read
//! look about with many rays and lie as densely as is asked for. Those that rays read where they
//! end are fewer and coarser; they see each other, and the light of all reflections among them is
//! solved for as a fixed point, so that no number of reflections is chosen. Direct light is never kept. Every
//! sample has independent replicates, each over its own replicate of what rays read, and their spread
//! tells its standard error.

mod hemisphere;
mod increments;
mod layer;
mod octree;
mod placing;
mod reader;
mod record;
mod store;

#[cfg(test)]
mod tests;

pub(crate) use increments::Cached;
pub use reader::{CacheReader, CacheSettings, CachedPlace, Served};
pub use record::{CACHE_REPLICATES, CacheError, CacheSample, IrradianceCache, SampleKind};
