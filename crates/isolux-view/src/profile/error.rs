//! What is no profile of a display.

/// Bytes of an ICC file at most: displays have tables of up to a few MiB.
pub const MAX_ICC_BYTES: usize = 8 << 20;

/// Why there is no [`super::MonitorProfile`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The file is larger than any profile of a display.
    #[error("an ICC profile of {bytes} bytes; give one of at most {MAX_ICC_BYTES} bytes")]
    Size {
        /// Bytes of the file.
        bytes: usize,
    },
    /// The file has not the signature of a profile.
    #[error("is no ICC profile; give a file of one, as in .icc or .icm")]
    NoProfile,
    /// The file is not what the ICC specification describes, or cut off.
    #[error("is no whole ICC profile of version 2 or 4 ({0}); save or copy it again")]
    Malformed(String),
    /// The profile is one of something else.
    #[error(
        "is a profile of {0}; give that of a display, class mntr or spac, whose colours are RGB"
    )]
    Kind(String),
    /// There is no way from codes to colours, or none back.
    #[error(
        "has neither curves and primaries (rTRC, rXYZ and so on) nor tables both ways (A2B0, B2A0); have the display \
         profiled anew"
    )]
    Incomplete,
    /// Primaries that span no colours.
    #[error("has primaries that mix no white (rXYZ, gXYZ, bXYZ); have the display profiled anew")]
    Primaries,
    /// A channel that does not get brighter as its code rises.
    #[error(
        "has a tone curve that does not rise (rTRC, gTRC, bTRC); have the display profiled anew"
    )]
    Curve,
    /// Tables that are none of three channels, or whose parts do not fit.
    #[error("has tables that do not fit RGB and its colours ({0}); have the display profiled anew")]
    Tables(String),
}
