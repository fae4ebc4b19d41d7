//! Files to values and values to files: scenes, photometry, maps.

pub mod gltf;
pub mod ies;
pub mod ldt;
mod plain_text;
mod problem;

pub use problem::{Loaded, Problem, Problems};
