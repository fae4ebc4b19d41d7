//! Files to values and values to files: scenes, photometry, maps.

pub mod atomic;
mod bare;
pub mod cache_file;
pub mod checkpoint;
mod counted;
mod efficacy;
pub mod export;
mod extent;
mod findings;
pub mod gltf;
pub mod ies;
pub mod ldt;
pub mod lightmap;
mod lines;
pub mod lint;
mod load;
pub mod map_glb;
pub mod mitsuba;
pub mod obj;
pub mod photometric_file;
mod picture;
mod plain_text;
pub mod ply;
pub mod png;
mod polygon;
mod problem;
mod product_file;
pub mod rad;
mod round;
pub mod scene_toml;
mod source;
mod srgb;
pub mod stl;

pub use counted::counted;
pub use load::load;
pub use problem::{Loaded, Problem, Problems};
