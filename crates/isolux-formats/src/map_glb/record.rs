//! `extras.isolux`, as written.

use super::arrays::Table;
use super::lightmap_arrays::LightmapRecord;
use super::preview::Preview;
use isolux::geometry::{Direction, Point, Transform};
use isolux::map::{IlluminationMap, Provenance};
use isolux::photometry::{GeneralSky, IntensityDistribution};
use isolux::scene::{
    CalculationGrid, Camera, Fitting, LuminousArea, Maintenance, Material, UpAxis,
};
use isolux::units::Rgb;
use serde::{Deserialize, Serialize};
use serde_json::value::{RawValue, to_raw_value};
use std::ops::RangeInclusive;

/// Versions of the format that are read; raised when older readers would misread what is written.
pub(super) const VERSIONS: RangeInclusive<u32> = 2..=3;

/// The version that a scene needs: what read version 2 knows no coats, and would leave them out.
pub(super) fn version(materials: &[Material]) -> u32 {
    let is_coated = |m: &Material| {
        [false, true].into_iter().any(|back| m.finish(back).is_some_and(|f| f.coat.is_some()))
    };
    if materials.iter().any(is_coated) { 3 } else { 2 }
}

/// `extras` of the document. The record is kept as its text, which the checksum is over.
#[derive(Serialize)]
pub(super) struct Sealed {
    isolux: Box<RawValue>,
    /// BLAKE3 over the text of the record.
    isolux_blake3: String,
}

impl Sealed {
    pub(super) fn new(record: &Record) -> Self {
        let isolux = to_raw_value(&Declared::new(record));
        let isolux = isolux.expect("plain structs with names for keys");
        let isolux_blake3 = checksum(&isolux);
        Self { isolux, isolux_blake3 }
    }
}

/// The checksum of a record.
pub(super) fn checksum(record: &RawValue) -> String {
    blake3::hash(record.get().as_bytes()).to_hex().to_string()
}

/// Everything about a map that is not an array.
#[derive(Serialize, Deserialize)]
pub(super) struct Record {
    pub(super) format_version: u32,
    pub(super) provenance: Provenance,
    pub(super) preview: Preview,
    pub(super) scene: SceneRecord,
    /// Only where the map was baked, too; maps of before have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) lightmap: Option<LightmapRecord>,
    pub(super) arrays: Table,
    /// BLAKE3 over all arrays.
    pub(super) arrays_blake3: String,
}

/// The record with what those need who read the file without its manual; not read back.
#[derive(Serialize)]
struct Declared<'a> {
    quantity: &'static str,
    unit: &'static str,
    pi: &'static str,
    channels: &'static str,
    unknown: &'static str,
    /// The whole relative error, a fraction; also in the provenance.
    accuracy_reached: Option<f64>,
    #[serde(flatten)]
    record: &'a Record,
}

impl<'a> Declared<'a> {
    fn new(record: &'a Record) -> Self {
        Self {
            quantity: "illuminance",
            unit: "lx",
            pi: "luminance_cd_m2 = reflectance * illuminance_lx / pi",
            channels: "linear Rec. 709; illuminance = 0.2126 r + 0.7152 g + 0.0722 b",
            unknown: "_STDERR_LX = -1 where the illuminance is not known, \
                      -2 where only its error is not known",
            accuracy_reached: record.provenance.accuracy.map(|a| a.reached),
            record,
        }
    }
}

/// Where the light of a file comes from that is no map itself.
#[derive(Serialize)]
pub(super) struct Origin {
    scene: String,
    scene_hash: String,
    accuracy_reached: Option<f64>,
}

impl Origin {
    pub(super) fn of(map: &IlluminationMap) -> Self {
        let Provenance { scene, scene_hash, accuracy, .. } = map.provenance.clone();
        let accuracy_reached = accuracy.map(|a| a.reached).filter(|a| a.is_finite());
        Self { scene, scene_hash, accuracy_reached }
    }
}

#[derive(Serialize, Deserialize)]
pub(super) struct SceneRecord {
    pub(super) name: String,
    pub(super) up: UpAxis,
    pub(super) shapes: Vec<ShapeRecord>,
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<TextureRecord>,
    /// Luminaires refer to these: thousands of them share a few tables.
    pub(super) distributions: Vec<IntensityDistribution>,
    pub(super) luminaires: Vec<LuminaireRecord>,
    /// Maps whose light is initial have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) maintenance: Option<Maintenance>,
    pub(super) groups: Vec<String>,
    pub(super) cameras: Vec<Camera>,
    /// Maps of before grids have none.
    #[serde(default)]
    pub(super) grids: Vec<CalculationGrid>,
}

/// A shape: the next `triangles` triangles of the arrays.
#[derive(Serialize, Deserialize)]
pub(super) struct ShapeRecord {
    pub(super) name: String,
    pub(super) material: u32,
    pub(super) triangles: usize,
    pub(super) has_normals: bool,
    pub(super) has_uvs: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) has_lightmap_uvs: bool,
}

#[derive(Serialize, Deserialize)]
pub(super) struct TextureRecord {
    pub(super) width: u32,
    pub(super) height: u32,
    /// A PNG.
    #[serde(rename = "bufferView")]
    pub(super) buffer_view: u32,
}

#[derive(Serialize, Deserialize)]
pub(super) struct LuminaireRecord {
    pub(super) name: String,
    pub(super) group: u32,
    pub(super) colour: Rgb,
    pub(super) kind: KindRecord,
    #[serde(default, skip_serializing_if = "Fitting::is_unknown")]
    pub(super) fitting: Fitting,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum KindRecord {
    Point {
        position: Point,
        world_from_luminaire: Transform,
        distribution: u32,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        area: Option<LuminousArea>,
    },
    Directional {
        direction: Direction,
        illuminance_lx: f64,
        #[serde(default, skip_serializing_if = "is_zero")]
        half_angle_rad: f64,
    },
    Sky {
        world_from_sky: Transform,
        sky: SkyRecord,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum SkyRecord {
    General {
        sky: GeneralSky,
        ground_cd_m2: f64,
    },
    /// The next `width` times `height` rows of an array.
    Picture {
        width: u32,
        height: u32,
    },
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
const fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
