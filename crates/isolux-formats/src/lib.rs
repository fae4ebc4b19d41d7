//! Files to values and values to files: scenes, photometry, maps.

pub mod atomic;
pub mod checkpoint;
pub mod gltf;
pub mod ies;
pub mod ldt;
pub mod map_glb;
mod plain_text;
pub mod png;
mod problem;

pub use problem::{Loaded, Problem, Problems};
