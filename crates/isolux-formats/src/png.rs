//! Pictures as PNG (ISO/IEC 15948).

use png::{BitDepth, ColorType, Encoder, Info, SrgbRenderingIntent};

/// Why there is no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
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
    #[error("the picture cannot be written as PNG: {0}")]
    Encoder(#[from] png::EncodingError),
}

/// The bytes of a PNG file of sRGB pixels, rows from the top.
pub fn encode(width: u32, height: u32, rgb: &[[u8; 3]]) -> Result<Vec<u8>, PngError> {
    encode_profiled(width, height, rgb, None)
}

/// The same of pixels whose colours an ICC profile describes, which the file carries; of sRGB ones without it.
pub fn encode_profiled(
    width: u32,
    height: u32,
    rgb: &[[u8; 3]],
    icc: Option<&[u8]>,
) -> Result<Vec<u8>, PngError> {
    let expected = u64::from(width) * u64::from(height);
    if expected == 0 || rgb.len() as u64 != expected {
        return Err(PngError::Size { width, height, pixels: rgb.len() });
    }
    let mut bytes = Vec::new();
    let mut info = Info::with_size(width, height);
    info.color_type = ColorType::Rgb;
    info.bit_depth = BitDepth::Eight;
    info.icc_profile = icc.map(Into::into);
    let mut encoder = Encoder::with_info(&mut bytes, info)?;
    if icc.is_none() {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn pixels_come_back() {
        let rgb = [[1, 2, 3], [4, 5, 6], [7, 8, 9], [255, 0, 128], [0, 0, 0], [9, 9, 9]];
        let bytes = encode(3, 2, &rgb).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut decoded).unwrap();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(decoded, rgb.as_flattened());
        assert!(reader.info().srgb.is_some(), "the file must say that it is sRGB");
    }

    #[test]
    fn a_profile_comes_back_and_leaves_srgb_out() {
        let profile = b"as it was given";
        let bytes = encode_profiled(1, 1, &[[1, 2, 3]], Some(profile)).unwrap();
        let reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        assert_eq!(reader.info().icc_profile.as_deref(), Some(&profile[..]));
        assert!(reader.info().srgb.is_none());
    }

    #[test]
    fn size_and_pixels_must_agree() {
        for (width, height, pixels) in [(0, 0, 0), (0, 5, 0), (2, 2, 3), (u32::MAX, u32::MAX, 1)] {
            assert!(encode(width, height, &vec![[0; 3]; pixels]).is_err());
        }
    }
}
