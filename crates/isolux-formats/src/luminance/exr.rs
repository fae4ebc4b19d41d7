//! OpenEXR in 32-bit floats, lossless.

use super::{LuminanceError, Luminances, MEANING};
use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{Chromaticities, LineOrder, Text};
use exr::meta::header::LayerAttributes;
use exr::prelude::Compression;
use std::io::Cursor;

/// The bytes of an OpenEXR file: `R`, `G`, `B` in cd/m2, the chromaticities of Rec. 709, and `whiteLuminance` 1, which says
/// that a value of 1 is 1 cd/m2. The same picture gives the same bytes.
pub fn encode(picture: &Luminances<'_>) -> Result<Vec<u8>, LuminanceError> {
    picture.check()?;
    let channel = |name: &str, index: usize| {
        let values = picture.rgb_cd_m2.iter().map(|rgb| rgb[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(values))
    };
    let channels = [channel("R", 0), channel("G", 1), channel("B", 2)];
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let attributes = LayerAttributes {
        comments: Text::new_or_none(MEANING),
        software_name: Text::new_or_none(concat!("isolux ", env!("CARGO_PKG_VERSION"))),
        white_luminance: Some(1.0),
        ..LayerAttributes::default()
    };
    let size = (picture.width as usize, picture.height as usize);
    let layer =
        Layer::new(size, attributes, encoding, AnyChannels::sort(channels.into_iter().collect()));
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(Chromaticities {
        red: (0.64, 0.33).into(),
        green: (0.3, 0.6).into(),
        blue: (0.15, 0.06).into(),
        white: (0.3127, 0.329).into(),
    });
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| LuminanceError::Exr(error.to_string()))?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers};

    #[test]
    fn pixels_come_back_with_every_digit() {
        let rgb_cd_m2 = &[[0.1, 2.5, 3e6], [0.0, 1e-20, 7.0]];
        let bytes = encode(&Luminances { width: 2, height: 1, rgb_cd_m2 }).unwrap();
        let read = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .rgb_channels(
                |size, _| vec![[0.0_f32; 3]; size.area()],
                |pixels: &mut Vec<[f32; 3]>, at, (r, g, b): (f32, f32, f32)| {
                    pixels[at.x()] = [r, g, b];
                },
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap();
        assert_eq!(read.layer_data.channel_data.pixels, rgb_cd_m2);
        assert_eq!(read.layer_data.attributes.white_luminance, Some(1.0));
    }
}
