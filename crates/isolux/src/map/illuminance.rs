//! Readings of the illuminance.

use super::standing::Standing;
use super::vertex_light::VertexLight;
use crate::units::Rgb;

/// A reading: the illuminance at a place, lx, with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminance {
    /// Light from luminaires without diffuse reflection, mirror images included, lx.
    pub direct_lx: Rgb,
    /// The part of `direct_lx` that comes through curved mirrors, glass and gloss, lx. In readings of a map it is
    /// interpolated, not evaluated afresh.
    pub caustic_lx: Rgb,
    /// Light after at least one diffuse reflection, lx.
    pub indirect_lx: Rgb,
    /// The standard error of the photometric total, lx.
    pub standard_error_lx: f64,
    /// The standard error of the photometric sum of indirect light and caustics, lx. Other direct light does not count.
    pub indirect_standard_error_lx: f64,
    /// The part of `indirect_standard_error_lx` due to noise of the surfaces that the light comes from, lx. Nearby
    /// readings share it, whatever their number of rays. Zero where it is not known.
    pub common_error_lx: f64,
    /// The expected interpolation error of indirect light, root mean square, lx. It is from interpolation between
    /// vertices, or from light that gathering rays have read close by.
    pub interpolation_error_lx: f64,
    /// The expected error that the reading shares with its surroundings, lx. Its sources are errors of the map at the
    /// ends of rays, and light of paths given up. Zero where it is not known.
    pub bias_lx: f64,
    /// The standing of the vertices read.
    pub standing: Standing,
    /// The number of samples behind the reading: its own rays, or the samples of the vertices read.
    pub samples: u64,
}

impl Illuminance {
    /// A reading without any light, known exactly.
    pub const NOTHING: Self = Self::without_bias(VertexLight::NOTHING);

    const fn without_bias(light: VertexLight) -> Self {
        Self {
            direct_lx: light.direct_lx,
            caustic_lx: light.caustic_lx,
            indirect_lx: light.indirect_lx,
            standard_error_lx: light.standard_error_lx,
            indirect_standard_error_lx: light.indirect_standard_error_lx,
            common_error_lx: light.common_error_lx,
            interpolation_error_lx: light.interpolation_error_lx,
            bias_lx: 0.0,
            standing: light.standing,
            samples: light.samples,
        }
    }

    /// The reading as a vertex holds it. Its bias is left out, since `Accuracy::bias` states that of a map for the
    /// scene.
    pub(crate) const fn at_vertex(self) -> VertexLight {
        VertexLight {
            direct_lx: self.direct_lx,
            caustic_lx: self.caustic_lx,
            indirect_lx: self.indirect_lx,
            standard_error_lx: self.standard_error_lx,
            indirect_standard_error_lx: self.indirect_standard_error_lx,
            common_error_lx: self.common_error_lx,
            interpolation_error_lx: self.interpolation_error_lx,
            standing: self.standing,
            samples: self.samples,
        }
    }

    /// The illuminance scaled by a factor, as of dimmed luminaires.
    pub fn dimmed(self, factor: f64) -> Self {
        Self { bias_lx: self.bias_lx * factor, ..self.at_vertex().dimmed(factor).into() }
    }

    /// The sum of direct and indirect light, lx.
    pub fn total_lx(&self) -> Rgb {
        self.direct_lx + self.indirect_lx
    }

    /// The photometric illuminance: the luminance-weighted total, lx.
    pub fn illuminance_lx(&self) -> f64 {
        self.total_lx().luminance()
    }
}

/// The reading of a vertex, or of a mean of vertices. Its bias is zero.
impl From<VertexLight> for Illuminance {
    fn from(light: VertexLight) -> Self {
        Self::without_bias(light)
    }
}
