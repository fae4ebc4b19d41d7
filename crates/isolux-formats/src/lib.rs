//! Files to values and values to files: scenes, photometry, maps.

pub mod png;
mod problem;

pub use problem::{Loaded, Problem, Problems};
