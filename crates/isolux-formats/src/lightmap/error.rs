//! What can go wrong while files are made.

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
    #[error(
        "the file takes {bytes} bytes, more than the 4 GiB of a .glb file; ask for fewer texels a metre"
    )]
    TooLarge {
        /// Bytes of the file, or of the part that is too large alone.
        bytes: u64,
    },
    /// A picture in the `.glb` could not be encoded.
    #[error("a page of the lightmap cannot be written as PNG: {0}")]
    Png(String),
}
