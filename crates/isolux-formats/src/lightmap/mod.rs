//! Lightmaps as files: OpenEXR with every digit, KTX2 for graphics cards, and what each engine wants in them.
//!
//! The `.glb` with the geometry is written by [`crate::map_glb::write_texels`].

mod exr;
mod ktx2;
mod shared_exponent;
mod target;

pub use exr::write_exr;
pub use ktx2::{Ktx2, write_ktx2};
pub use target::{Convention, Target, Way};

/// Why there is no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LightmapFileError {
    /// The EXR encoder gave up.
    #[error("the lightmap cannot be written as EXR: {0}")]
    Exr(String),
    /// The KTX2 header could not be made.
    #[error("the lightmap cannot be written as KTX2: {0}")]
    Ktx2(String),
    /// The `.glb` would be larger than the format allows.
    #[error(transparent)]
    TooLarge(#[from] crate::map_glb::MapTooLarge),
    /// A picture in the `.glb` could not be encoded.
    #[error("a page of the lightmap cannot be written as PNG: {0}")]
    Png(String),
}
