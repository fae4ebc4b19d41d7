//! Headers of the containers, as `web/src/wire.ts` has them.

use super::container::Section;
use isolux::scene::LuminousArea;
use isolux::units::Rgb;
use serde::Serialize;

/// What a scene looks like without its light.
#[derive(Serialize)]
pub(super) struct SceneHeader<'a> {
    pub(super) kind: &'static str,
    pub(super) name: &'a str,
    pub(super) file: &'a str,
    pub(super) up: [f64; 3],
    pub(super) origin: [f64; 3],
    pub(super) bounds: Bounds,
    pub(super) shapes: &'a [String],
    pub(super) finishes: Vec<FinishRecord<'a>>,
    pub(super) textures: Vec<TextureRecord>,
    pub(super) luminaires: Vec<LuminaireRecord<'a>>,
    pub(super) solids: Vec<Solid>,
    pub(super) sky: Option<SkyRecord>,
    pub(super) sun: Option<SunRecord>,
    pub(super) groups: &'a [String],
    pub(super) cameras: Vec<CameraRecord<'a>>,
    pub(super) about: &'a [(String, String)],
    pub(super) white_cd_m2: f64,
    pub(super) light_lm: &'a [Rgb],
    pub(super) tones: Vec<ToneRecord<'a>>,
    pub(super) colour_maps: Vec<ColourMapRecord<'a>>,
    pub(super) scale_lx: Limits,
    pub(super) layers: &'a [String],
    pub(super) other: Option<&'a str>,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct Bounds {
    pub(super) min: [f64; 3],
    pub(super) max: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct FinishRecord<'a> {
    pub(super) material: &'a str,
    pub(super) diffuse: Rgb,
    pub(super) texture: Option<u32>,
    pub(super) mirror: Rgb,
    pub(super) gloss: Option<isolux::scene::Gloss>,
    pub(super) coat: Option<isolux::scene::Coat>,
    pub(super) luminance_cd_m2: Rgb,
    pub(super) glass: Option<isolux::scene::Dielectric>,
}

#[derive(Serialize)]
pub(super) struct TextureRecord {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) png: Section,
}

#[derive(Serialize)]
pub(super) struct LuminaireRecord<'a> {
    pub(super) name: &'a str,
    pub(super) group: u32,
    pub(super) colour: Rgb,
    pub(super) kind: &'static str,
    pub(super) position: Option<[f64; 3]>,
    pub(super) direction: [f64; 3],
    pub(super) c0: [f64; 3],
    pub(super) luminous_flux_lm: Option<f64>,
    pub(super) illuminance_lx: Option<f64>,
    pub(super) peak_cd: Option<f64>,
    pub(super) solid: Option<usize>,
    pub(super) area: Option<LuminousArea>,
}

/// Intensity over its peak, rows from nadir up, columns around.
#[derive(Serialize)]
pub(super) struct Solid {
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) values: Vec<f32>,
}

/// A picture all around: rows from the zenith, columns from north by east.
#[derive(Serialize)]
pub(super) struct SkyRecord {
    pub(super) group: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) codes: Section,
    pub(super) east: [f64; 3],
    pub(super) north: [f64; 3],
    pub(super) zenith: [f64; 3],
}

/// A disc.
#[derive(Serialize)]
pub(super) struct SunRecord {
    pub(super) group: u32,
    pub(super) towards: [f64; 3],
    /// Of the angle from its middle to its rim.
    pub(super) cosine: f64,
    pub(super) luminance_cd_m2: Rgb,
}

#[derive(Serialize)]
pub(super) struct CameraRecord<'a> {
    pub(super) name: &'a str,
    pub(super) position: [f64; 3],
    pub(super) direction: [f64; 3],
    pub(super) up: [f64; 3],
    pub(super) vertical_fov_deg: f64,
}

/// Evenly spaced numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steps {
    /// The first one.
    pub first: f64,
    /// From one to the next.
    pub step: f64,
    /// How many.
    pub count: usize,
}

#[derive(Serialize)]
pub(super) struct ToneRecord<'a> {
    pub(super) name: &'a str,
    pub(super) label: &'a str,
    pub(super) on: &'static str,
    pub(super) whites: Steps,
    pub(super) exposed: Steps,
    pub(super) values: Section,
}

#[derive(Serialize)]
pub(super) struct ColourMapRecord<'a> {
    pub(super) name: &'a str,
    pub(super) codes: Section,
}

#[derive(Serialize)]
pub(super) struct Limits {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// Triangles with vertices of their own.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Chunk {
    pub(super) shape: u32,
    pub(super) finish: usize,
    pub(super) back: bool,
    pub(super) lit: bool,
    pub(super) first_vertex: usize,
    pub(super) vertices: usize,
    pub(super) first_index: usize,
    pub(super) indices: usize,
    pub(super) min: [f64; 3],
    pub(super) step: [f64; 3],
    pub(super) first_uv: Option<usize>,
}

#[derive(Serialize)]
pub(super) struct MeshHeader<'a> {
    pub(super) kind: &'static str,
    pub(super) mesh: u64,
    pub(super) chunks: &'a [Chunk],
    pub(super) positions: Section,
    pub(super) normals: Section,
    pub(super) indices: Section,
    pub(super) uvs: Section,
    pub(super) lit_vertices: usize,
    pub(super) triangles: usize,
}

#[derive(Serialize)]
pub(super) struct LayerRecord {
    pub(super) direct: Section,
    pub(super) indirect: Section,
}

#[derive(Serialize)]
pub(super) struct LightHeader {
    pub(super) kind: &'static str,
    pub(super) mesh: u64,
    pub(super) version: u64,
    pub(super) block_size: usize,
    pub(super) blocks: Vec<usize>,
    pub(super) layers: Vec<LayerRecord>,
    pub(super) standard_error: Section,
    pub(super) other: Option<LayerRecord>,
    pub(super) other_standard_error: Option<Section>,
}
