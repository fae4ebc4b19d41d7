//! Files to values and values to files: scenes, photometry, maps.

pub mod gltf;
pub mod ies;
mod problem;

pub use problem::{Loaded, Problem, Problems};
