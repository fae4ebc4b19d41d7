//! Textures as PNG: lossless, and at the same time what viewers show.

use super::Fault;
use image::{ExtendedColorType, ImageEncoder, ImageFormat, ImageReader, Limits};
use isolux::scene::Texture;
use std::io::Cursor;

/// All textures of a map together may take this much memory; compressed pictures can promise more
/// than any computer has.
pub(super) const MOST_BYTES: u64 = 4 << 30;

/// A texture as PNG; `None` where it exceeds what a PNG can hold.
pub(crate) fn encode(texture: &Texture) -> Option<Vec<u8>> {
    let mut png = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut png);
    encoder
        .write_image(&texture.srgb, texture.width, texture.height, ExtendedColorType::Rgb8)
        .ok()?;
    Some(png)
}

/// A texture of `width` x `height` from PNG of any origin.
pub(super) fn decode(
    png: &[u8],
    (width, height): (u32, u32),
    place: &str,
) -> Result<Texture, Fault> {
    let mut reader = ImageReader::with_format(Cursor::new(png), ImageFormat::Png);
    let mut limits = Limits::default();
    limits.max_image_width = Some(width);
    limits.max_image_height = Some(height);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let picture = reader
        .decode()
        .map_err(|error| Fault::new(place, format!("is not a picture: {error}")))?
        .into_rgb8();
    if (picture.width(), picture.height()) != (width, height) {
        return Err(Fault::new(place, format!("is not {width} x {height} pixels")));
    }
    Ok(Texture { width, height, srgb: picture.into_raw() })
}
