//! OpenEXR files of one layer.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Blocks, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{Chromaticities, LineOrder};
use exr::meta::header::LayerAttributes;
use exr::prelude::Compression;
use std::io::Cursor;

/// The bytes of a file with these channels, lossless, and the chromaticities of Rec. 709; or what is wrong. The same channels give
/// the same bytes.
pub(crate) fn encode(
    size: (usize, usize),
    attributes: LayerAttributes,
    channels: Vec<AnyChannel<FlatSamples>>,
) -> Result<Vec<u8>, String> {
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let mut image = Image::from_layer(Layer::new(size, attributes, encoding, channels));
    image.attributes.chromaticities = Some(Chromaticities {
        red: (0.64, 0.33).into(),
        green: (0.3, 0.6).into(),
        blue: (0.15, 0.06).into(),
        white: (0.3127, 0.329).into(),
    });
    let mut bytes = Cursor::new(Vec::new());
    let written = image.write().non_parallel().to_buffered(&mut bytes);
    written.map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}
