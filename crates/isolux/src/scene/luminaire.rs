//! Sources of light.

use super::LuminousArea;
use crate::photometry::{IntensityDistribution, Sky};
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Transform};
use serde::{Deserialize, Serialize};

/// A luminaire that is not a surface of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Luminaire {
    /// Name, as written in the scene.
    pub name: String,
    /// Index into the light groups of the scene.
    pub group: u32,
    /// Chromaticity, luminance 1: intensities times this are the three channels.
    pub colour: Rgb,
    /// What it is.
    pub kind: LuminaireKind,
}

/// What a luminaire is beside its light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fitting {
    /// Input power when it is not dimmed, W; `None` where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power_w: Option<f64>,
    /// The share of its light in emergency lighting; `None` if it is not part of that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub emergency_share: Option<f64>,
}

impl Fitting {
    /// Whether nothing is known.
    pub fn is_unknown(&self) -> bool {
        *self == Self::default()
    }
}

impl LuminaireKind {
    /// Its luminous area; `None` for a point and for parallel light.
    pub const fn area(&self) -> Option<&LuminousArea> {
        match self {
            Self::Point { area, .. } => area.as_ref(),
            Self::Directional { .. } | Self::Sky { .. } => None,
        }
    }

    /// Whether it is infinitely far away and has an extent: a sky, or the sun.
    pub fn is_far_extent(&self) -> bool {
        match self {
            Self::Sky { .. } => true,
            Self::Directional { half_angle_rad, .. } => *half_angle_rad > 0.0,
            Self::Point { .. } => false,
        }
    }

    /// Whether its light comes from infinitely far away: then it has no flux of its own.
    pub const fn is_infinitely_far(&self) -> bool {
        matches!(self, Self::Directional { .. } | Self::Sky { .. })
    }
}

/// The closed set of luminaires without surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LuminaireKind {
    /// An intensity distribution about a point, or from a luminous area.
    Point {
        /// Where.
        position: Point,
        /// Rotation (or reflection) from the luminaire's frame (nadir -z, C0 along +x); no scale.
        world_from_luminaire: Transform,
        /// Luminous intensity.
        intensity: IntensityDistribution,
        /// Where the light leaves from; `None` for a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        area: Option<LuminousArea>,
    },
    /// Light of a disc infinitely far away: parallel light, or the sun.
    Directional {
        /// Where the light goes, from the middle of the disc.
        direction: Direction,
        /// Illuminance on a surface that faces it, lx.
        illuminance_lx: f64,
        /// Half of the angle under which the disc is seen, rad; zero for parallel light.
        #[serde(default, skip_serializing_if = "is_zero")]
        half_angle_rad: f64,
    },
    /// Light from infinitely far away, all around.
    Sky {
        /// Rotation from the frame of skies (x east, y north, z to the zenith); no scale.
        world_from_sky: Transform,
        /// Its luminance.
        sky: Sky,
    },
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
const fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// The maintenance factors that the light of luminaires already contains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Maintenance {
    /// The least factor.
    pub least: f64,
    /// The greatest factor; 1 where some light is initial.
    pub greatest: f64,
}

impl Maintenance {
    /// The range of factors of several sources of light; `None` where all light is initial.
    pub fn of(factors: impl IntoIterator<Item = f64>) -> Option<Self> {
        let range = factors
            .into_iter()
            .fold((1.0_f64, 0.0_f64), |(low, high), factor| (low.min(factor), high.max(factor)));
        (range.0 < 1.0).then_some(Self { least: range.0, greatest: range.1 })
    }
}

/// Triangles of one shape that emit by their material.
#[derive(Clone, Debug, PartialEq)]
pub struct AreaLuminaire {
    /// Index of the shape.
    pub shape: u32,
    /// Emitting triangles of the scene's mesh.
    pub triangles: Vec<u32>,
    /// Whether they emit from the back.
    pub back: bool,
    /// Luminance, cd/m2.
    pub luminance_cd_m2: Rgb,
    /// Emitting area, m2.
    pub area_m2: f64,
}

impl AreaLuminaire {
    /// Flux, lm: pi times luminance times area.
    pub fn luminous_flux_lm(&self) -> f64 {
        std::f64::consts::PI * self.luminance_cd_m2.luminance() * self.area_m2
    }
}
