//! Files to values and values to files: scenes, photometry, maps.

mod findings;
mod load;
pub mod obj;
mod picture;
mod polygon;
mod problem;
pub mod scene_toml;
mod source;

pub use load::load;
pub use problem::{Loaded, Problem, Problems};
