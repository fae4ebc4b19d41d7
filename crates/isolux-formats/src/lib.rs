//! Files to values and values to files: scenes, photometry, maps.

mod problem;

pub use problem::{Loaded, Problem, Problems};
