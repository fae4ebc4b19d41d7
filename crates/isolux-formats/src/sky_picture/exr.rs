//! OpenEXR.

use super::pixels::{Pixels, check_size};
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers};
use std::io::Cursor;

/// Pixels of the first layer with red, green and blue, and what a value of 1 is where the file says so (`whiteLuminance`).
pub(super) fn decode(bytes: &[u8]) -> Result<(Pixels, Option<f64>), String> {
    let told = |error: exr::error::Error| format!("is no OpenEXR picture that is read ({error})");
    let known = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(told)?;
    // Before any of them is made room for.
    for header in &known.headers {
        let size = header.layer_size;
        check_size(size.width() as u64, size.height() as u64)?;
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.width(), vec![[0.0_f32; 3]; size.area()]),
            |(width, pixels): &mut (usize, Vec<[f32; 3]>), at, (r, g, b): (f32, f32, f32)| {
                pixels[at.y() * *width + at.x()] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(told)?;
    let layer = image.layer_data;
    let (width, height) = check_size(layer.size.width() as u64, layer.size.height() as u64)?;
    let unit = layer.attributes.white_luminance.map(f64::from);
    let unit_cd_m2 = unit.filter(|unit| *unit > 0.0 && unit.is_finite());
    Ok((Pixels { width, height, rgb: layer.channel_data.pixels.1 }, unit_cd_m2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::luminance::{Luminances, encode_exr};

    #[test]
    fn what_is_written_is_read() {
        let rgb: Vec<[f32; 3]> = (0..12).map(|k| [k as f32, 0.1 * k as f32, 7.0]).collect();
        let bytes = encode_exr(&Luminances { width: 4, height: 3, rgb_cd_m2: &rgb }).unwrap();
        let (read, unit) = decode(&bytes).unwrap();
        assert_eq!((read.width, read.height, unit), (4, 3, Some(1.0)));
        assert_eq!(read.rgb, rgb);
        for cut in [bytes.len() - 9, bytes.len() / 2, 5] {
            assert!(decode(&bytes[..cut]).is_err());
        }
    }
}
