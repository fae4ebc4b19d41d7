//! The part of glTF 2.0 that maps are written in, as written.

use serde::Serialize;
use std::collections::BTreeMap;

/// `target` of a buffer view of vertex attributes, of indices.
pub(super) const VERTICES: u32 = 34962;
pub(super) const INDICES: u32 = 34963;

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document<E> {
    pub(super) asset: Asset,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) extensions_used: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<RootExtensions>,
    pub(super) scene: u32,
    pub(super) scenes: [Scene; 1],
    #[serde(flatten)]
    pub(super) objects: Objects,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffers: Vec<Buffer>,
    pub(super) extras: E,
}

#[derive(Serialize)]
pub(super) struct Asset {
    pub(super) version: &'static str,
    pub(super) generator: String,
}

#[derive(Serialize)]
pub(super) struct Scene {
    pub(super) nodes: [u32; 1],
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) byte_length: usize,
}

/// The lists that grow while a map is written.
#[derive(Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Objects {
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) nodes: Vec<Node>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) meshes: Vec<Mesh>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) materials: Vec<Material>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) textures: Vec<Texture>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) samplers: Vec<Sampler>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) images: Vec<Image>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) cameras: Vec<Camera>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) accessors: Vec<Accessor>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) buffer_views: Vec<BufferView>,
}

#[derive(Clone, Default, Serialize)]
pub(super) struct Node {
    pub(super) name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) children: Vec<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mesh: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) camera: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) rotation: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) matrix: Option<[f64; 16]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extensions: Option<NodeExtensions>,
}

#[derive(Clone, Serialize)]
pub(super) struct NodeExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) lights: LightReference,
}

#[derive(Clone, Serialize)]
pub(super) struct LightReference {
    pub(super) light: u32,
}

#[derive(Serialize)]
pub(super) struct RootExtensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub(super) lights: Lights,
}

#[derive(Serialize)]
pub(super) struct Lights {
    pub(super) lights: Vec<Light>,
}

#[derive(Serialize)]
pub(super) struct Light {
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) color: [f64; 3],
    /// Candela, of directional light lux.
    pub(super) intensity: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) spot: Option<Spot>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Spot {
    pub(super) inner_cone_angle: f64,
    pub(super) outer_cone_angle: f64,
}

#[derive(Serialize)]
pub(super) struct Mesh {
    pub(super) name: String,
    pub(super) primitives: Vec<Primitive>,
}

#[derive(Serialize)]
pub(super) struct Primitive {
    pub(super) attributes: Attributes,
    pub(super) indices: u32,
    pub(super) material: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) extras: Option<Reflection>,
}

/// How light becomes luminance: `reflectance E / pi + luminance_cd_m2`, times the texture.
#[derive(Serialize)]
pub(super) struct Reflection {
    pub(super) reflectance: [f64; 3],
    pub(super) luminance_cd_m2: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: u32,
    #[serde(rename = "NORMAL")]
    pub(super) normal: u32,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub(super) texcoord: Option<u32>,
    #[serde(rename = "TEXCOORD_1", skip_serializing_if = "Option::is_none")]
    pub(super) lightmap_texcoord: Option<u32>,
    #[serde(rename = "COLOR_0", skip_serializing_if = "Option::is_none")]
    pub(super) colour: Option<u32>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub(super) light: Option<LightAttributes>,
}

/// What surfaces with a map carry beside their colour.
#[derive(Serialize)]
pub(super) struct LightAttributes {
    #[serde(rename = "_ILLUMINANCE_LX")]
    pub(super) illuminance_lx: u32,
    #[serde(rename = "_DIRECT_LX")]
    pub(super) direct_lx: u32,
    #[serde(rename = "_STDERR_LX")]
    pub(super) standard_error_lx: u32,
    /// Light and standard error of each group, by the names of the attributes.
    #[serde(flatten)]
    pub(super) groups: BTreeMap<String, u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material {
    pub(super) name: String,
    pub(super) pbr_metallic_roughness: BaseColour,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) emissive_texture: Option<TextureReference>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) emissive_factor: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) double_sided: Option<bool>,
    pub(super) extensions: MaterialExtensions,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BaseColour {
    pub(super) base_color_factor: [f64; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_color_texture: Option<TextureReference>,
    pub(super) metallic_factor: f64,
    pub(super) roughness_factor: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TextureReference {
    pub(super) index: u32,
    /// 0 where it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tex_coord: Option<u32>,
}

#[derive(Default, Serialize)]
pub(super) struct MaterialExtensions {
    #[serde(rename = "KHR_materials_unlit", skip_serializing_if = "Option::is_none")]
    pub(super) unlit: Option<Empty>,
    #[serde(rename = "KHR_materials_specular", skip_serializing_if = "Option::is_none")]
    pub(super) specular: Option<Specular>,
    #[serde(rename = "KHR_materials_emissive_strength", skip_serializing_if = "Option::is_none")]
    pub(super) emissive_strength: Option<EmissiveStrength>,
    #[serde(rename = "MOZ_lightmap", skip_serializing_if = "Option::is_none")]
    pub(super) lightmap: Option<LightmapTexture>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Specular {
    pub(super) specular_factor: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct EmissiveStrength {
    pub(super) emissive_strength: f64,
}

/// As Mozilla Hubs reads it.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct LightmapTexture {
    pub(super) index: u32,
    pub(super) tex_coord: u32,
    pub(super) intensity: f64,
}

/// `{}`.
#[derive(Serialize)]
pub(super) struct Empty {}

#[derive(Serialize)]
pub(super) struct Texture {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sampler: Option<u32>,
    pub(super) source: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Sampler {
    pub(super) mag_filter: u32,
    pub(super) min_filter: u32,
    pub(super) wrap_s: u32,
    pub(super) wrap_t: u32,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image {
    pub(super) buffer_view: u32,
    pub(super) mime_type: &'static str,
}

#[derive(Serialize)]
pub(super) struct Camera {
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    pub(super) perspective: Perspective,
}

#[derive(Serialize)]
pub(super) struct Perspective {
    pub(super) yfov: f64,
    pub(super) znear: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: u32,
    pub(super) component_type: u32,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) normalized: bool,
    pub(super) count: usize,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) max: Option<[f64; 3]>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: u32,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) target: Option<u32>,
}
