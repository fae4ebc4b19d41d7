//! What each consumer of lightmaps expects: unit, side of pi, and how the file says it.

use serde::Serialize;
use std::f64::consts::PI;

/// A consumer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Target {
    /// Any viewer of glTF: finished colours, tone mapped, as emission.
    #[default]
    Viewer,
    /// three.js.
    Three,
    /// Godot 4.
    Godot,
    /// Unity with glTFast.
    Unity,
    /// Blender.
    Blender,
    /// Bevy.
    Bevy,
}

/// How the light comes to the consumer through the `.glb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// As emission on the second set of texture coordinates, tone mapped.
    Preview,
    /// As emission in cd/m2 on the second set of texture coordinates: luminance of the surface as it is lit.
    Emission,
    /// As a lightmap beside the materials of the scene (`MOZ_lightmap`).
    Lightmap,
}

/// A convention in words and numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Convention {
    /// What texels of the lightmap (.exr, .ktx2) hold.
    pub quantity: &'static str,
    /// Unit of it.
    pub unit: &'static str,
    /// What lux are multiplied by.
    #[serde(skip)]
    pub from_lux: f64,
    /// How the consumer makes luminance of it.
    pub formula: &'static str,
    /// What the consumer has to be told.
    pub setting: &'static str,
}

const ILLUMINANCE: Convention = Convention {
    quantity: "illuminance E",
    unit: "lx",
    from_lux: 1.0,
    formula: "luminance = albedo * texel / pi",
    setting: "",
};
const OVER_PI: Convention = Convention {
    quantity: "illuminance over pi, E / pi: the luminance of a perfect white",
    unit: "cd/m2",
    from_lux: 1.0 / PI,
    formula: "luminance = albedo * texel",
    setting: "",
};

impl Target {
    /// All, by the names of the command line.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Viewer, "viewer"),
        (Self::Three, "three"),
        (Self::Godot, "godot"),
        (Self::Unity, "unity"),
        (Self::Blender, "blender"),
        (Self::Bevy, "bevy"),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(target, _)| *target == self).map_or("", |(_, name)| name)
    }

    /// How light gets into its `.glb`.
    pub const fn way(self) -> Way {
        match self {
            Self::Viewer => Way::Preview,
            Self::Three | Self::Bevy => Way::Lightmap,
            Self::Godot | Self::Unity | Self::Blender => Way::Emission,
        }
    }

    /// What its lightmaps hold. `docs/book/exports.md` names the sources.
    pub const fn convention(self) -> Convention {
        match self {
            Self::Viewer => ILLUMINANCE,
            // lights_fragment_maps: irradiance += texel * lightMapIntensity; BRDF_Lambert: albedo / pi.
            Self::Three => Convention {
                setting: "material.lightMap of channel 1 with lightMapIntensity as in MOZ_lightmap (1 for the .ktx2); \
                          renderer.toneMappingExposure in m2/cd",
                ..ILLUMINANCE
            },
            // pbr_functions.wgsl: indirect_light += lightmap * lightmap_exposure * diffuse_color, then view.exposure.
            Self::Bevy => Convention {
                setting: "Lightmap component with the .ktx2 (not sRGB), lightmap_exposure = 1, Exposure of the camera",
                ..OVER_PI
            },
            // scene_forward_clustered.glsl: ambient_light = lightmap; ambient_light *= albedo.
            Self::Godot => Convention {
                setting: "physical light units on; exposure by CameraAttributesPhysical; Emission on UV2",
                ..OVER_PI
            },
            // Lighting.hlsl: indirectDiffuse = bakedGI * brdfData.diffuse.
            Self::Unity => Convention {
                setting: "HDRP: exposure of the volume; elsewhere scale emission and lightmap by the exposure",
                ..OVER_PI
            },
            Self::Blender => Convention {
                setting: "Film exposure, or Exposure of Color Management: scene-linear 1 is 1 cd/m2",
                ..OVER_PI
            },
        }
    }
}
