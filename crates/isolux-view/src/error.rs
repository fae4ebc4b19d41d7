//! What cannot be shown.

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The picture would have no pixel, or more than fit in memory.
    #[error(
        "a picture of {width} x {height} pixels; give both sides at least 1, at most 2^25 pixels"
    )]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// Pixels times samples are more than fit in memory.
    #[error(
        "{samples} samples in all; ask for at most 2^27, by fewer pixels or less supersampling"
    )]
    Samples {
        /// Samples asked for.
        samples: u64,
    },
    /// A limit of differences that is no size.
    #[error("differences up to {0}; give a finite number above zero")]
    Limit(f64),
    /// A luminance or exposure value that is no exposure.
    #[error("exposure {0}; give a finite number, for a luminance one above zero")]
    Exposure(f64),
    /// Reinhard's white is not a positive number.
    #[error("the tone curve reaches white at {0}; give a number above zero")]
    ToneWhite(f64),
    /// Brightness that leaves nothing of the picture.
    #[error("brightness {0}; give -1 to 1, where 0 changes nothing")]
    Brightness(f64),
    /// Contrast that is no factor.
    #[error("contrast {0}; give 0 to 100, where 1 changes nothing")]
    Contrast(f64),
    /// A display without a luminance.
    #[error(
        "a display whose white is {0} cd/m2; give 1 to 100000 cd/m2, as it was measured or as its data sheet says"
    )]
    DisplayWhite(f64),
    /// A white that is no colour.
    #[error("what is to look white is black, or no colour; give one with light in it")]
    White,
    /// Limits of a scale that enclose nothing, or zero on a logarithmic one.
    #[error(
        "false colour from {low} to {high}; the upper limit must lie above the lower, and on a \
         logarithmic scale both above zero"
    )]
    Limits {
        /// Lower limit.
        low: f64,
        /// Upper limit.
        high: f64,
    },
    /// No pixel has a value to choose limits by.
    #[error("no pixel of the view has a value; look at a surface that carries a map")]
    NothingKnown,
}
