//! Pictures of luminance in floating point: OpenEXR and Radiance HDR, in cd/m2.

mod exr;
mod radiance;

pub use exr::encode as encode_exr;
pub use radiance::encode as encode_radiance;

/// Luminances of the pixels of a view.
#[derive(Clone, Copy, Debug)]
pub struct Luminances<'a> {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Linear Rec. 709 in cd/m2, rows from the top: luminance = 0.2126 r + 0.7152 g + 0.0722 b.
    pub rgb_cd_m2: &'a [[f32; 3]],
}

/// Why there is no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LuminanceError {
    /// Pixels and size do not agree, or the size is zero.
    #[error("{pixels} pixels are no picture of {width} x {height}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels given.
        pixels: usize,
    },
    /// The encoder gave up.
    #[error("the picture cannot be written as OpenEXR: {0}")]
    Exr(String),
}

impl Luminances<'_> {
    fn check(&self) -> Result<(), LuminanceError> {
        let Self { width, height, rgb_cd_m2 } = *self;
        let expected = u64::from(width) * u64::from(height);
        if expected == 0 || rgb_cd_m2.len() as u64 != expected {
            return Err(LuminanceError::Size { width, height, pixels: rgb_cd_m2.len() });
        }
        Ok(())
    }
}

/// What the numbers of both kinds of files are, for people who open one.
const MEANING: &str =
    "luminance in cd/m2, linear Rec. 709: luminance = 0.2126 r + 0.7152 g + 0.0722 b";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_that_do_not_agree_are_refused() {
        for (width, height, pixels) in [(0, 0, 0), (2, 1, 1), (u32::MAX, u32::MAX, 3)] {
            let rgb_cd_m2 = &vec![[0.0; 3]; pixels][..];
            let picture = Luminances { width, height, rgb_cd_m2 };
            assert!(matches!(encode_exr(&picture), Err(LuminanceError::Size { .. })));
            assert!(matches!(encode_radiance(&picture), Err(LuminanceError::Size { .. })));
        }
    }
}
