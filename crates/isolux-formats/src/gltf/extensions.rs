//! Which extensions are understood.

use super::notes::{Flaw, Notes};
use super::surroundings;
use gltf_json::Root;

/// Read in full, or ignored with a warning where they are met.
const KNOWN: &[&str] = &[
    "EXT_lights_ies",
    surroundings::NAME,
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    QUANTIZATION,
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_transform",
];
/// What they say is of no account to light at rest, so that a file may require them.
const OF_NO_LIGHT: &[&str] = &[
    "CESIUM_primitive_outline",
    "EXT_instance_features",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_structural_metadata",
    "FB_ngon_encoding",
    "KHR_animation_pointer",
    "KHR_audio_emitter",
    "KHR_interactivity",
    "KHR_materials_variants",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_physics_rigid_bodies",
    "KHR_xmp_json_ld",
    "MSFT_lod",
];
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Whether an extension is read.
pub(super) fn is_known(name: &str) -> bool {
    KNOWN.contains(&name)
}

/// Refuses what is required and unknown; warns of what is used and unknown.
pub(super) fn check(root: &Root, notes: &mut Notes) {
    let unknown = |name: &&String| !is_known(name);
    let required = &root.extensions_required;
    let is_needed = |name: &&String| !OF_NO_LIGHT.contains(&name.as_str());
    for name in required.iter().filter(unknown).filter(is_needed) {
        let what = format!("the extension {name} is required and not supported");
        notes.problem(Flaw::new(what, remedy(name)).at("extensionsRequired"));
    }
    let is_refused = |name: &&String| required.contains(name) && is_needed(name);
    for name in root.extensions_used.iter().filter(unknown).filter(|name| !is_refused(name)) {
        let what = format!("the extension {name} is not supported; what it says is left out");
        notes.warn(Flaw::new(what, remedy(name)).at("extensionsUsed"));
    }
    if !root.animations.is_empty() {
        let what = "animations are left out; everything stands where its node is";
        notes.warn(Flaw::new(what, "export the moment to be computed").at("animations"));
    }
}

/// Whether vertex attributes may be small integers.
pub(super) fn is_quantized(root: &Root) -> bool {
    root.extensions_required.iter().chain(&root.extensions_used).any(|name| name == QUANTIZATION)
}

fn remedy(name: &str) -> &'static str {
    match name {
        "KHR_texture_basisu" => {
            "export the textures as PNG or JPEG, or unpack them by `gltf-transform ktxdecompress`"
        }
        "EXT_texture_avif" | "MSFT_texture_dds" => "export the textures as PNG or JPEG",
        _ => "export without it",
    }
}
