//! The light at the vertices of a map.

use super::standing::Standing;
use crate::units::Rgb;

/// The light stored at a vertex of a map, lx, with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexLight {
    /// Light from luminaires without diffuse reflection, mirror images included, lx.
    pub direct_lx: Rgb,
    /// The part of `direct_lx` that only particles find, through curved mirrors, glass and gloss, lx. Readers cannot
    /// evaluate it afresh.
    pub caustic_lx: Rgb,
    /// Light after at least one diffuse reflection, lx.
    pub indirect_lx: Rgb,
    /// The standard error of the photometric total, lx.
    pub standard_error_lx: f64,
    /// The standard error of the photometric sum of indirect light and caustics, lx. Other direct light does not count.
    pub indirect_standard_error_lx: f64,
    /// The part of `indirect_standard_error_lx` due to noise of the surfaces that the light comes from, lx. Nearby
    /// vertices share it, whatever their number of rays. Zero where it is not known.
    pub common_error_lx: f64,
    /// The expected interpolation error of indirect light, root mean square, lx: that of the worst element at the
    /// vertex.
    pub interpolation_error_lx: f64,
    /// The standing of the vertex.
    pub standing: Standing,
    /// The number of samples behind the value: gathering rays, or one for each increment of particles.
    pub samples: u64,
}

impl VertexLight {
    /// A vertex without any light, known exactly.
    pub const NOTHING: Self = Self {
        direct_lx: Rgb::BLACK,
        caustic_lx: Rgb::BLACK,
        indirect_lx: Rgb::BLACK,
        standard_error_lx: 0.0,
        indirect_standard_error_lx: 0.0,
        common_error_lx: 0.0,
        interpolation_error_lx: 0.0,
        standing: Standing::Open,
        samples: 0,
    };

    /// The light scaled by a factor, as of dimmed luminaires.
    pub fn dimmed(self, factor: f64) -> Self {
        Self {
            direct_lx: self.direct_lx * factor,
            caustic_lx: self.caustic_lx * factor,
            indirect_lx: self.indirect_lx * factor,
            standard_error_lx: self.standard_error_lx * factor,
            indirect_standard_error_lx: self.indirect_standard_error_lx * factor,
            common_error_lx: self.common_error_lx * factor,
            interpolation_error_lx: self.interpolation_error_lx * factor,
            ..self
        }
    }

    /// The sum of direct and indirect light, lx.
    pub fn total_lx(&self) -> Rgb {
        self.direct_lx + self.indirect_lx
    }

    /// The photometric illuminance: the luminance-weighted total, lx.
    pub fn illuminance_lx(&self) -> f64 {
        self.total_lx().luminance()
    }

    /// The weighted mean of the known values of the highest standing; `None` if no value is known. Standard errors of
    /// vertices are independent and add up in squares; shared errors add up linearly. The interpolation error of an
    /// element is the least of its vertices, since each has the error of the worst element around it.
    pub fn mix<const N: usize>(parts: [(Option<Self>, f64); N]) -> Option<Self> {
        let standing = Standing::highest(parts.map(|(value, _)| value.map(|v| v.standing)))?;
        let known = || {
            let of_standing = |v: &&Self| v.standing == standing;
            parts.iter().filter_map(move |(v, w)| Some((v.as_ref().filter(of_standing)?, *w)))
        };
        let sum: f64 = known().map(|(_, weight)| weight).sum();
        // A place on the far edge of an element has weight only on its unknown vertices.
        let (scale, even) = if sum > 1e-9 {
            (1.0 / sum, false)
        } else {
            (1.0 / known().count().max(1) as f64, true)
        };
        let weighted = || known().map(|(v, w)| (v, if even { scale } else { w * scale }));
        // A value without weight may have an unknown, infinite error.
        let root_sum = |f: &dyn Fn(&Self) -> f64| {
            let parts = weighted().filter(|&(_, w)| w != 0.0).map(|(v, w)| w * f(v));
            parts.map(|part| part * part).sum::<f64>().sqrt()
        };
        let least = known().map(|(v, _)| v.interpolation_error_lx).fold(f64::INFINITY, f64::min);
        Some(Self {
            direct_lx: weighted().map(|(v, w)| v.direct_lx * w).sum(),
            caustic_lx: weighted().map(|(v, w)| v.caustic_lx * w).sum(),
            indirect_lx: weighted().map(|(v, w)| v.indirect_lx * w).sum(),
            standard_error_lx: root_sum(&|v| v.standard_error_lx),
            indirect_standard_error_lx: root_sum(&|v| v.indirect_standard_error_lx),
            common_error_lx: weighted()
                .filter(|&(_, w)| w != 0.0)
                .map(|(v, w)| v.common_error_lx * w)
                .sum(),
            interpolation_error_lx: least,
            standing,
            samples: weighted().map(|(v, _)| v.samples).sum(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_weight_adds_no_unknown_error() {
        let sure = VertexLight { standard_error_lx: 2.0, ..VertexLight::NOTHING };
        let unknown = VertexLight { standard_error_lx: f64::INFINITY, ..VertexLight::NOTHING };
        let error = |parts| VertexLight::mix(parts).unwrap().standard_error_lx;
        assert_eq!(error([(Some(sure), 1.0), (Some(unknown), 0.0)]), 2.0);
        assert_eq!(error([(Some(sure), 0.5), (Some(unknown), 0.5)]), f64::INFINITY);
    }
}
