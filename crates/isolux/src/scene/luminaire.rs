//! Sources of light.

use crate::photometry::IntensityDistribution;
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

/// The closed set of luminaires without surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LuminaireKind {
    /// A point with an intensity distribution.
    Point {
        /// Where.
        position: Point,
        /// Rotation (or reflection) from the luminaire's frame (nadir -z, C0 along +x); no scale.
        world_from_luminaire: Transform,
        /// Luminous intensity.
        intensity: IntensityDistribution,
    },
    /// Parallel light from infinitely far away.
    Directional {
        /// Where the light goes.
        direction: Direction,
        /// Illuminance on a surface that faces it, lx.
        illuminance_lx: f64,
    },
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
