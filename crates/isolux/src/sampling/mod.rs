//! Random numbers from counters, low-discrepancy points, and warps to what light needs.
//!
//! Nothing here has a state: every number is a pure function of what it is for, so the order of
//! the work, the number of threads and the machine do not matter.

mod counter;
mod sobol;
mod warp;

#[cfg(test)]
mod tests;

pub use counter::Key;
pub use sobol::Sequence;
pub use warp::{CosineHemisphere, Ggx, SphericalTriangle};
