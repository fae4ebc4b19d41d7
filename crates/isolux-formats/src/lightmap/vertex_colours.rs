//! What each consumer makes of the colours of vertices under unlit materials (glTF 2.0, `COLOR_0`, which is linear;
//! and may not exceed 1; Khronos, KHR_materials_unlit): it shows them times the base colour, and adds no light.

use super::target::Target;
use serde::Serialize;

/// What colours are, and in what numbers they are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ColourKind {
    /// Finished, in 16 bits.
    ToneMapped,
    /// In proportion to luminance, 32-bit floats between 0 and 1: Godot 3 takes 16 bits for more than 1.
    Floats,
}

/// A convention in words.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct VertexConvention {
    /// What colours stand for.
    pub quantity: &'static str,
    /// How they are kept.
    #[serde(rename = "kept_as")]
    pub kind: ColourKind,
    /// How luminance comes of them.
    pub formula: &'static str,
    /// What the consumer has to be told.
    pub setting: &'static str,
}

const EXPOSED: VertexConvention = VertexConvention {
    quantity: "luminance rho E / pi and what is emitted, linear Rec. 709, 1 is white_cd_m2, what is brighter is cut",
    kind: ColourKind::Floats,
    formula: "luminance = COLOR_0 * base colour texture * white_cd_m2",
    setting: "",
};

impl Target {
    /// What colours of vertices hold. `docs/book/exports.md` names the sources.
    pub const fn vertex_convention(self) -> VertexConvention {
        match self {
            Self::Viewer => VertexConvention {
                quantity: "luminance rho E / pi and what is emitted, tone mapped, linear Rec. 709",
                kind: ColourKind::ToneMapped,
                formula: "tone curve of exposure_m2_cd and white_cd_m2",
                setting: "",
            },
            // color_fragment: diffuseColor.rgb *= vColor; meshbasic: outgoingLight = diffuseColor.rgb.
            Self::Three => VertexConvention {
                setting: "MeshBasicMaterial; as it is without tone mapping, else renderer.toneMappingExposure",
                ..EXPOSED
            },
            // pbr.wgsl: out.color = base_color where unlit, without view.exposure.
            Self::Bevy => VertexConvention {
                setting: "StandardMaterial, unlit: Exposure of the camera does not count; Tonemapping::None shows it as it is",
                ..EXPOSED
            },
            // rendering_server.cpp: colours of vertices are cut to 8 bits.
            Self::Godot => VertexConvention {
                setting: "unshaded, vertex colours as albedo, not sRGB; linear tone mapping shows it as it is; kept in 8 bits",
                ..EXPOSED
            },
            // VertexBufferColors: NativeArray<float4>; glTF/Unlit multiplies it with the base colour.
            Self::Unity => VertexConvention {
                setting: "linear colour space of the project; post-exposure of the volume",
                ..EXPOSED
            },
            // io_scene_gltf2: color_attributes.new(name, 'BYTE_COLOR', domain).
            Self::Blender => VertexConvention {
                setting: "View Transform Standard shows it as it is; kept in 8 bits of sRGB",
                ..EXPOSED
            },
        }
    }
}
