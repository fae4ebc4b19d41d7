//! Files to values and values to files: scenes, photometry, maps.

pub mod atomic;
pub mod checkpoint;
pub mod map_glb;
mod problem;

pub use problem::{Loaded, Problem, Problems};
