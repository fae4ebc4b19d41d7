//! Lightmaps as files: OpenEXR with every digit, KTX2 for graphics cards, and what each engine wants in them.
//!
//! The `.glb` with the geometry is written by [`crate::map_glb::write_texels`].

mod error;
mod exr;
mod ktx2;
pub(crate) mod shared_exponent;
mod target;
mod vertex_colours;

pub use error::LightmapFileError;
pub use exr::write_exr;
pub use ktx2::{Ktx2, write_ktx2};
pub use target::{Convention, Target, Way};
pub use vertex_colours::{ColourKind, VertexConvention};
