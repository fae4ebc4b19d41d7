//! OpenEXR in 32-bit floats, lossless.

use super::{LuminanceError, Luminances, MEANING};
use crate::exr_layer;
use exr::image::{AnyChannel, FlatSamples};
use exr::meta::attribute::Text;
use exr::meta::header::LayerAttributes;

/// The bytes of an OpenEXR file: `R`, `G`, `B` in cd/m2, the chromaticities of Rec. 709, and `whiteLuminance` 1, which says
/// that a value of 1 is 1 cd/m2. The same picture gives the same bytes.
pub fn encode(picture: &Luminances<'_>) -> Result<Vec<u8>, LuminanceError> {
    picture.check()?;
    let channel = |name: &str, index: usize| {
        let values = picture.rgb_cd_m2.iter().map(|rgb| rgb[index]).collect();
        AnyChannel::new(name, FlatSamples::F32(values))
    };
    let channels = [channel("R", 0), channel("G", 1), channel("B", 2)];
    let attributes = LayerAttributes {
        comments: Text::new_or_none(MEANING),
        software_name: Text::new_or_none(concat!("isolux ", env!("CARGO_PKG_VERSION"))),
        white_luminance: Some(1.0),
        ..LayerAttributes::default()
    };
    let size = (picture.width as usize, picture.height as usize);
    exr_layer::encode(size, attributes, channels.into()).map_err(LuminanceError::Exr)
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{ReadChannels, ReadLayers};
    use std::io::Cursor;

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
