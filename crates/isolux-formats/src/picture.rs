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

/// Pixels of all pictures of a scene: a small file can be a large picture, and be named in many ways.
pub(crate) const MOST_PIXELS_OF_SCENE: u64 = 1 << 28;

/// Room for the pictures of a scene.
#[derive(Debug)]
pub(crate) struct Room {
    pixels_left: u64,
}

impl Default for Room {
    fn default() -> Self {
        Self { pixels_left: MOST_PIXELS_OF_SCENE }
    }
}

impl Room {
    /// Reads a picture that there is room for; transparency is left out.
    pub(crate) fn read(&mut self, path: &Path) -> Result<Texture, Problem> {
        let bytes = source::read_bytes(path, MOST_FILE_BYTES)?;
        let texture = decode(&bytes, self.pixels_left).map_err(|what| {
            Problem::new(path, "", what, "save it again as PNG or JPEG, not too large")
        })?;
        self.take(std::slice::from_ref(&texture));
        Ok(texture)
    }

    /// Sets pictures aside that were read elsewhere; whether there was room.
    pub(crate) fn take(&mut self, textures: &[Texture]) -> bool {
        let pixels = textures.iter().map(|t| u64::from(t.width) * u64::from(t.height)).sum();
        let left = self.pixels_left.checked_sub(pixels);
        self.pixels_left = left.unwrap_or(0);
        left.is_some()
    }
}

/// Reads a picture; transparency is left out.
pub fn read(path: &Path) -> Result<Texture, Problem> {
    Room::default().read(path)
}

/// A picture of at most so many pixels from the bytes of a PNG or JPEG file.
fn decode(bytes: &[u8], pixels_left: u64) -> Result<Texture, String> {
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
    if pixels > pixels_left {
        return Err(format!(
            "is one too many: all pictures of a scene may have {MOST_PIXELS_OF_SCENE} pixels"
        ));
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
        let texture = decode(&png(2, 3), 6).unwrap();
        assert_eq!((texture.width, texture.height), (2, 3));
        assert_eq!(texture.srgb[3 * 3..3 * 4], [1, 1, 7]);
    }

    #[test]
    fn many_pictures_are_refused_as_one_large_one_is() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("a.png");
        std::fs::write(&path, png(3, 4)).unwrap();
        let mut room = Room { pixels_left: 30 };
        assert!(room.read(&path).is_ok() && room.read(&path).is_ok());
        assert!(room.read(&path).unwrap_err().what.contains("one too many"));
    }

    #[test]
    fn hostile_pictures_are_refused() {
        let mut huge = png(1, 1);
        // The size in the IHDR chunk; its checksum no longer matters, the size is refused first.
        huge[16..20].copy_from_slice(&0x7fff_ffff_u32.to_be_bytes());
        let cut = &png(40, 40)[..60];
        for bytes in [&huge[..], cut, b"", b"GIF89a", b"\x89PNG\r\n\x1a\n"] {
            assert!(decode(bytes, u64::MAX).is_err());
        }
    }
}
