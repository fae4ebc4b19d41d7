//! Files to values and values to files: scenes, photometry, maps.

pub mod ies;
mod problem;

pub use problem::{Loaded, Problem, Problems};
