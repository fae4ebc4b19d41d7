//! The irradiance cache: indirect light is sampled where it is needed, and extrapolated from samples by their
//! gradients.
//!
//! The method follows Ward, Rubinstein, Clear (1988), "A ray tracing solution for diffuse interreflection",
//! and Ward and Heckbert (1992), "Irradiance gradients". There are two kinds of samples. Near samples are
//! read at places; they have many rays and lie as densely as the accuracy requires. Far samples are read at
//! the ends of rays; they are fewer and coarser. Far samples see each other, and the light of all reflections
//! among them is solved as a fixed point, so no number of reflections is chosen. Direct light is never
//! stored. Every sample has independent replicates, each over its own replicate of the far samples, and their
//! spread gives its standard error.

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
