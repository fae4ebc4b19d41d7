//! OpenEXR in 32-bit floats, lossless.

use super::error::LightmapFileError;
use super::target::Convention;
use crate::exr_layer;
use exr::image::{AnyChannel, FlatSamples};
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::LayerAttributes;
use isolux::lightmap::{Cover, Lightmap};
use serde::Serialize;

/// The name of the attribute that says what the numbers are.
const ATTRIBUTE: &str = "isolux";

/// That attribute, as JSON.
#[derive(Serialize)]
struct Note<'a> {
    #[serde(flatten)]
    convention: &'a Convention,
    texels_per_meter: f64,
    page: u32,
    pages: u32,
    channels: &'static str,
    standard_error: &'static str,
    coverage: &'static str,
    generator: String,
}

/// One page of a lightmap: `R`, `G`, `B` as a lookup reads them (borders of charts filled, seams stitched), the layer
/// `standard_error` (of the photometric value, NaN where there is none) and the layer `coverage` (share of the texel
/// that surface of a known value covers; 0 beside charts, -1 where there is surface of which nothing is known). The
/// same lightmap gives the same bytes.
pub fn write_exr(
    lightmap: &Lightmap,
    page: u32,
    convention: &Convention,
) -> Result<Vec<u8>, LightmapFileError> {
    let size = (lightmap.layout.width as usize, lightmap.layout.height as usize);
    let first = lightmap.layout.index(page, 0, 0);
    let range = first..first + size.0 * size.1;
    let scaled = |lx: f64| (lx * convention.from_lux) as f32;
    let colour = |channel: usize| -> Vec<f32> {
        lightmap.page(page).iter().map(|rgb| scaled(f64::from(rgb[channel]))).collect()
    };
    let error = |texel| lightmap.texel(texel).map_or(f32::NAN, |t| scaled(t.standard_error_lx));
    let coverage = |texel: usize| match (lightmap.covers[texel], lightmap.texel(texel)) {
        (_, Some(known)) => known.coverage as f32,
        (Cover::Unknown, None) => -1.0,
        _ => 0.0,
    };
    let channel = |name: &str, values| AnyChannel::new(name, FlatSamples::F32(values));
    let channels = [
        channel("R", colour(0)),
        channel("G", colour(1)),
        channel("B", colour(2)),
        channel("standard_error.Y", range.clone().map(error).collect()),
        channel("coverage.Y", range.map(coverage).collect()),
    ];
    let attributes = attributes(lightmap, page, convention);
    exr_layer::encode(size, attributes, channels.into()).map_err(LightmapFileError::Exr)
}

fn attributes(lightmap: &Lightmap, page: u32, convention: &Convention) -> LayerAttributes {
    let note = Note {
        convention,
        texels_per_meter: lightmap.layout.texels_per_m,
        page,
        pages: lightmap.layout.pages,
        channels: "linear Rec. 709; photometric value = 0.2126 r + 0.7152 g + 0.0722 b",
        standard_error: "of the photometric value, same unit; NaN where no value is known",
        coverage: "share of the texel covered by surface of known value; 0 beside charts (filled), -1 unknown",
        generator: format!("isolux {}", env!("CARGO_PKG_VERSION")),
    };
    let json = serde_json::to_string(&note).unwrap_or_default();
    let mut attributes = LayerAttributes::default();
    let Convention { quantity, unit, formula, .. } = convention;
    attributes.comments = text(&format!("{quantity}, {unit}; {formula}"));
    attributes.software_name = text(&note.generator);
    // One alone: several would come in any order, and the same lightmap would not give the same bytes.
    attributes.other.extend(text(ATTRIBUTE).zip(text(&json).map(AttributeValue::Text)));
    attributes
}

fn text(text: &str) -> Option<Text> {
    Text::new_or_none(text)
}
