//! PNG and JPEG files as textures.

use crate::{Problem, source};
use image::{ImageReader, Limits};
use isolux::scene::Texture;
use std::io::Cursor;
use std::path::Path;

const MOST_FILE_BYTES: u64 = 256 << 20;
/// Longest side, and 16 Mi pixels in all: more detail than a reflectance can use.
const MOST_PIXELS_A_SIDE: u32 = 16_384;
const MOST_PIXELS: u64 = 16 << 20;
/// Room for the decoder: four 16-bit channels of the largest picture, twice.
const MOST_DECODER_BYTES: u64 = 16 * MOST_PIXELS;

/// Reads a picture; transparency is left out.
pub fn read(path: &Path) -> Result<Texture, Problem> {
    decode(&source::read_bytes(path, MOST_FILE_BYTES)?)
        .map_err(|what| Problem::new(path, "", what, "save it again as PNG or JPEG, not too large"))
}

/// A picture from the bytes of a PNG or JPEG file.
fn decode(bytes: &[u8]) -> Result<Texture, String> {
    let not_a_picture = |error: image::ImageError| format!("is not a usable picture ({error})");
    let reader = || {
        let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MOST_PIXELS_A_SIDE);
        limits.max_image_height = Some(MOST_PIXELS_A_SIDE);
        limits.max_alloc = Some(MOST_DECODER_BYTES);
        reader.limits(limits);
        Ok(reader)
    };
    let (width, height) = reader()
        .map_err(image::ImageError::IoError)
        .and_then(ImageReader::into_dimensions)
        .map_err(not_a_picture)?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels == 0 || pixels > MOST_PIXELS {
        return Err(format!("has {width} x {height} pixels; 1 to {MOST_PIXELS} are read"));
    }
    let picture = reader()
        .map_err(image::ImageError::IoError)
        .and_then(ImageReader::decode)
        .map_err(not_a_picture)?;
    Ok(Texture { width, height, srgb: picture.into_rgb8().into_raw() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let picture =
            image::RgbImage::from_fn(width, height, |x, y| image::Rgb([x as u8, y as u8, 7]));
        picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn rows_run_from_the_top() {
        let texture = decode(&png(2, 3)).unwrap();
        assert_eq!((texture.width, texture.height), (2, 3));
        assert_eq!(texture.srgb[3 * 3..3 * 4], [1, 1, 7]);
    }

    #[test]
    fn hostile_pictures_are_refused() {
        let mut huge = png(1, 1);
        // The size in the IHDR chunk; its checksum no longer matters, the size is refused first.
        huge[16..20].copy_from_slice(&0x7fff_ffff_u32.to_be_bytes());
        let cut = &png(40, 40)[..60];
        for bytes in [&huge[..], cut, b"", b"GIF89a", b"\x89PNG\r\n\x1a\n"] {
            assert!(decode(bytes).is_err());
        }
    }
}
