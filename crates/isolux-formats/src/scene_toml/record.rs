//! The scene as written.

use super::quantity::{Colour, LengthUnit, NonNegative, Number, Positive, Share, Triple};
use super::sky_record::{LuminancesRecord, SkyRecord};
use super::spans::At;
use isolux::scene::{AreaShape, UpAxis};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The whole file. An entry that could not be read is left out, but a material keeps its name.
#[derive(Debug, Default)]
pub(super) struct SceneFile {
    pub(super) name: Option<String>,
    pub(super) up: Option<UpAxis>,
    pub(super) units: Option<LengthUnit>,
    pub(super) libraries: Vec<At<String>>,
    pub(super) materials: Vec<(At<String>, Option<MaterialRecord>)>,
    pub(super) geometry: Vec<At<GeometryRecord>>,
    pub(super) groups: Vec<GroupRecord>,
    pub(super) luminaires: Vec<At<LuminaireRecord>>,
    pub(super) sky: Option<At<SkyRecord>>,
    pub(super) cameras: Vec<At<CameraRecord>>,
    pub(super) grids: Vec<At<GridRecord>>,
    pub(super) requirements: Vec<At<RequirementRecord>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GeometryRecord {
    pub(super) name: Option<String>,
    pub(super) file: Option<At<String>>,
    pub(super) polygon: Option<At<Vec<Triple>>>,
    pub(super) rectangle: Option<At<RectangleRecord>>,
    #[serde(rename = "box")]
    pub(super) cuboid: Option<At<BoxRecord>>,
    pub(super) disc: Option<At<DiscRecord>>,
    pub(super) sphere: Option<At<SphereRecord>>,
    pub(super) units: Option<At<LengthUnit>>,
    pub(super) up: Option<At<UpAxis>>,
    pub(super) luminaires: Option<At<bool>>,
    /// Luminance of white in unlit materials of a glTF file.
    pub(super) unlit_luminance_cd_m2: Option<At<Positive>>,
    pub(super) vertex_colours: Option<At<bool>>,
    pub(super) efficacy_lm_w: Option<At<Positive>>,
    pub(super) material: Option<At<String>>,
    #[serde(default)]
    pub(super) materials: BTreeMap<At<String>, At<String>>,
    pub(super) transform: Option<At<PlacementRecord>>,
    pub(super) placements: Option<At<Vec<At<PlacementRecord>>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RectangleRecord {
    pub(super) corner: Triple,
    pub(super) u: Triple,
    pub(super) v: Triple,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxRecord {
    pub(super) min: Triple,
    pub(super) max: Triple,
    #[serde(default)]
    pub(super) inward: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DiscRecord {
    pub(super) centre: Triple,
    pub(super) normal: Triple,
    pub(super) radius: Positive,
    pub(super) segments: Option<u32>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereRecord {
    pub(super) centre: Triple,
    pub(super) radius: Positive,
    pub(super) segments: Option<u32>,
    #[serde(default)]
    pub(super) inward: bool,
    #[serde(default)]
    pub(super) octant: bool,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlacementRecord {
    pub(super) scale: Option<ScaleRecord>,
    pub(super) rotate_deg: Option<Triple>,
    pub(super) translate: Option<Triple>,
    /// Rows of the 4 x 4 matrix, one after the other.
    pub(super) matrix: Option<[Number; 16]>,
}

/// One factor for all axes, or one each.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "a number or [x, y, z]")]
pub(super) enum ScaleRecord {
    Uniform(Number),
    Axes(Triple),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialRecord {
    pub(super) diffuse: Option<At<Colour>>,
    pub(super) mirror: Option<At<Colour>>,
    pub(super) gloss: Option<At<GlossRecord>>,
    pub(super) coat: Option<At<CoatRecord>>,
    pub(super) texture: Option<At<String>>,
    pub(super) luminance_cd_m2: Option<At<Colour>>,
    pub(super) sided: Option<At<Sided>>,
    pub(super) back: Option<At<FinishRecord>>,
    pub(super) glass: Option<At<GlassRecord>>,
}

/// One side of an opaque material.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FinishRecord {
    pub(super) diffuse: Option<At<Colour>>,
    pub(super) mirror: Option<At<Colour>>,
    pub(super) gloss: Option<At<GlossRecord>>,
    pub(super) coat: Option<At<CoatRecord>>,
    pub(super) texture: Option<At<String>>,
    pub(super) luminance_cd_m2: Option<At<Colour>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GlossRecord {
    pub(super) f0: At<Colour>,
    pub(super) roughness: At<Share>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CoatRecord {
    pub(super) cover: Option<At<Share>>,
    pub(super) roughness: At<Share>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GlassRecord {
    pub(super) ior: Option<Positive>,
    #[serde(default)]
    pub(super) thin: bool,
    pub(super) transmittance: Option<At<Colour>>,
}

/// Whether the back is like the front, or black.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Sided {
    One,
    Two,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GroupRecord {
    pub(super) name: At<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LuminaireRecord {
    pub(super) name: Option<String>,
    pub(super) group: Option<String>,
    /// Name of a luminaire of a library.
    #[serde(rename = "type")]
    pub(super) kind: Option<At<String>>,
    pub(super) position: Option<At<Triple>>,
    pub(super) target: Option<At<Triple>>,
    pub(super) direction: Option<At<Triple>>,
    pub(super) rotate_deg: Option<At<Number>>,
    pub(super) dimming: Option<NonNegative>,
    pub(super) maintenance_factor: Option<Share>,
    pub(super) power_w: Option<At<Positive>>,
    pub(super) emergency: Option<At<bool>>,
    pub(super) emergency_flux_share: Option<At<Share>>,
    pub(super) colour: Option<At<Colour>>,
    pub(super) cct_k: Option<At<Number>>,
    pub(super) isotropic: Option<At<IsotropicRecord>>,
    pub(super) cosine: Option<At<CosineRecord>>,
    pub(super) spot: Option<At<SpotRecord>>,
    pub(super) directional: Option<At<DirectionalRecord>>,
    pub(super) sky: Option<At<LuminancesRecord>>,
    pub(super) ies: Option<At<String>>,
    pub(super) ldt: Option<At<String>>,
    pub(super) lamp_set: Option<At<u32>>,
    pub(super) flux_lm: Option<At<NonNegative>>,
    pub(super) luminous_area: Option<At<LuminousAreaRecord>>,
    pub(super) array: Option<At<ArrayRecord>>,
}

/// Where the light of a luminaire leaves from, in place of what a photometric file says.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged, expecting = "\"point\" or { shape = \"box\", size_m = [length, width, height] }")]
pub(super) enum LuminousAreaRecord {
    Point(PointWord),
    Sizes(LuminousSizes),
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum PointWord {
    Point,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LuminousSizes {
    pub(super) shape: AreaShape,
    /// Along C0-C180, along C90-C270, and vertically.
    pub(super) size_m: [NonNegative; 3],
    /// From the position, in the frame of the luminaire.
    pub(super) middle_m: Option<Triple>,
}

/// A luminaire of a library: all but where it hangs.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LibraryRecord {
    pub(super) maintenance_factor: Option<Share>,
    pub(super) power_w: Option<Positive>,
    pub(super) colour: Option<At<Colour>>,
    pub(super) cct_k: Option<At<Number>>,
    pub(super) isotropic: Option<At<IsotropicRecord>>,
    pub(super) cosine: Option<At<CosineRecord>>,
    pub(super) spot: Option<At<SpotRecord>>,
    pub(super) ies: Option<At<String>>,
    pub(super) ldt: Option<At<String>>,
    pub(super) lamp_set: Option<At<u32>>,
    pub(super) flux_lm: Option<At<NonNegative>>,
    pub(super) luminous_area: Option<At<LuminousAreaRecord>>,
}

/// What a luminaire says of its light, here or in a library.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LightRecord<'a> {
    pub(super) isotropic: Option<&'a At<IsotropicRecord>>,
    pub(super) cosine: Option<&'a At<CosineRecord>>,
    pub(super) spot: Option<&'a At<SpotRecord>>,
    pub(super) ies: Option<&'a At<String>>,
    pub(super) ldt: Option<&'a At<String>>,
    /// Which of the lamp sets of EULUMDAT, from 1.
    pub(super) lamp_set: Option<&'a At<u32>>,
    pub(super) flux_lm: Option<&'a At<NonNegative>>,
    pub(super) luminous_area: Option<&'a At<LuminousAreaRecord>>,
    pub(super) colour: Option<&'a At<Colour>>,
    pub(super) cct_k: Option<&'a At<Number>>,
}

impl GeometryRecord {
    /// Whether colours of vertices are to be read as diffuse reflectance.
    pub(super) fn asks_for_vertex_colours(&self) -> bool {
        self.vertex_colours.as_ref().is_some_and(|asked| *asked.get_ref())
    }
}

impl LuminaireRecord {
    /// What it says of its light itself.
    pub(super) fn light(&self) -> LightRecord<'_> {
        LightRecord {
            isotropic: self.isotropic.as_ref(),
            cosine: self.cosine.as_ref(),
            spot: self.spot.as_ref(),
            ies: self.ies.as_ref(),
            ldt: self.ldt.as_ref(),
            lamp_set: self.lamp_set.as_ref(),
            flux_lm: self.flux_lm.as_ref(),
            luminous_area: self.luminous_area.as_ref(),
            colour: self.colour.as_ref(),
            cct_k: self.cct_k.as_ref(),
        }
    }
}

impl LibraryRecord {
    /// What it says of its light.
    pub(super) fn light(&self) -> LightRecord<'_> {
        LightRecord {
            isotropic: self.isotropic.as_ref(),
            cosine: self.cosine.as_ref(),
            spot: self.spot.as_ref(),
            ies: self.ies.as_ref(),
            ldt: self.ldt.as_ref(),
            lamp_set: self.lamp_set.as_ref(),
            flux_lm: self.flux_lm.as_ref(),
            luminous_area: self.luminous_area.as_ref(),
            colour: self.colour.as_ref(),
            cct_k: self.cct_k.as_ref(),
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IsotropicRecord {
    pub(super) intensity_cd: Option<NonNegative>,
    pub(super) flux_lm: Option<NonNegative>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CosineRecord {
    pub(super) peak_cd: Option<NonNegative>,
    pub(super) flux_lm: Option<NonNegative>,
    pub(super) exponent: Option<NonNegative>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpotRecord {
    pub(super) peak_cd: Option<NonNegative>,
    pub(super) flux_lm: Option<NonNegative>,
    pub(super) inner_deg: NonNegative,
    pub(super) outer_deg: Positive,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DirectionalRecord {
    pub(super) illuminance_lx: NonNegative,
    /// The full angle under which it is seen.
    pub(super) angle_deg: Option<At<NonNegative>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ArrayRecord {
    pub(super) count: [u32; 3],
    pub(super) step: Triple,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraRecord {
    pub(super) name: Option<String>,
    pub(super) position: At<Triple>,
    pub(super) target: Option<At<Triple>>,
    pub(super) direction: Option<At<Triple>>,
    pub(super) up: Option<At<Triple>>,
    pub(super) vertical_fov_deg: Option<At<Positive>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GridRecord {
    pub(super) name: Option<String>,
    pub(super) corner: Triple,
    pub(super) u: Triple,
    pub(super) v: Triple,
    pub(super) spacing: Option<Positive>,
    pub(super) border: Option<NonNegative>,
    pub(super) maintenance_factor: Option<Positive>,
    pub(super) emergency: Option<EmergencyRecord>,
    pub(super) task_lx: Option<Positive>,
}

/// What area of emergency lighting a grid is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum EmergencyRecord {
    EscapeRoute,
    OpenArea,
    HighRisk,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RequirementRecord {
    /// All grids if none is named.
    pub(super) grid: Option<At<String>>,
    pub(super) task: Option<At<String>>,
    pub(super) conditions: Option<At<String>>,
}

impl MaterialRecord {
    /// What it says of the front, taken out of it.
    pub(super) fn take_front(&mut self) -> FinishRecord {
        FinishRecord {
            diffuse: self.diffuse.take(),
            mirror: self.mirror.take(),
            gloss: self.gloss.take(),
            coat: self.coat.take(),
            texture: self.texture.take(),
            luminance_cd_m2: self.luminance_cd_m2.take(),
        }
    }
}

impl FinishRecord {
    /// Whether it says nothing.
    pub(super) fn is_empty(&self) -> bool {
        self.diffuse.is_none()
            && self.mirror.is_none()
            && self.gloss.is_none()
            && self.coat.is_none()
            && self.texture.is_none()
            && self.luminance_cd_m2.is_none()
    }
}
