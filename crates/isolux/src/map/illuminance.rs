//! One value of a map.

use super::standing::Standing;
use crate::units::Rgb;

/// The illuminance at a place, in lux, with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminance {
    /// What arrives from luminaires without a diffuse reflection (mirror images included), lx.
    pub direct_lx: Rgb,
    /// The share of `direct_lx` that only particles can find (through curved mirrors, glass, gloss)
    /// and that no reader can evaluate afresh, lx.
    pub caustic_lx: Rgb,
    /// What arrives after at least one diffuse reflection, lx.
    pub indirect_lx: Rgb,
    /// Standard error of the photometric total, lx.
    pub standard_error_lx: f64,
    /// Standard error of the photometric indirect part and the caustics, without the rest of the
    /// direct light, lx.
    pub indirect_standard_error_lx: f64,
    /// What of that is noise of the surfaces that light comes from, lx: readings nearby have it in common, however many rays they
    /// take. Zero where it is not known.
    pub common_error_lx: f64,
    /// In a map: what interpolating the indirect part about a vertex is expected to err by, root mean
    /// square over the worst element at it, lx. In a reading: what this one is expected to err by for
    /// being interpolated, or for what rays gathered afresh have read close by.
    pub interpolation_error_lx: f64,
    /// In a reading: what it is expected to err by in common with its surroundings, for what rays got wrong that read the map, and
    /// for light given up. Zero in a map, which tells that for the scene.
    pub bias_lx: f64,
    /// What the vertex, or the vertices read, stand for.
    pub standing: Standing,
    /// Samples behind the value (rays gathered or particles received).
    pub samples: u64,
}

impl Illuminance {
    /// No light, known exactly.
    pub const NOTHING: Self = Self {
        direct_lx: Rgb::BLACK,
        caustic_lx: Rgb::BLACK,
        indirect_lx: Rgb::BLACK,
        standard_error_lx: 0.0,
        indirect_standard_error_lx: 0.0,
        common_error_lx: 0.0,
        interpolation_error_lx: 0.0,
        bias_lx: 0.0,
        standing: Standing::Open,
        samples: 0,
    };

    /// All of it times a factor, as of dimmed luminaires.
    pub fn dimmed(self, factor: f64) -> Self {
        Self {
            direct_lx: self.direct_lx * factor,
            caustic_lx: self.caustic_lx * factor,
            indirect_lx: self.indirect_lx * factor,
            standard_error_lx: self.standard_error_lx * factor,
            indirect_standard_error_lx: self.indirect_standard_error_lx * factor,
            common_error_lx: self.common_error_lx * factor,
            interpolation_error_lx: self.interpolation_error_lx * factor,
            bias_lx: self.bias_lx * factor,
            ..self
        }
    }

    /// Direct plus indirect, lx.
    pub fn total_lx(&self) -> Rgb {
        self.direct_lx + self.indirect_lx
    }

    /// The photometric illuminance: the luminance-weighted total, lx.
    pub fn illuminance_lx(&self) -> f64 {
        self.total_lx().luminance()
    }

    /// The weighted mean over the known values of the highest standing; `None` where none is known. Standard errors are
    /// combined as of independent values, which the vertices of an element are, and what readings have in common as of one; the
    /// interpolation error of an element is the least of its vertices, which count all elements about them.
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
        // What has no weight may have an error that nobody knows.
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
            bias_lx: weighted().map(|(v, w)| v.bias_lx * w).sum(),
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
        let sure = Illuminance { standard_error_lx: 2.0, ..Illuminance::NOTHING };
        let unknown = Illuminance { standard_error_lx: f64::INFINITY, ..Illuminance::NOTHING };
        let error = |parts| Illuminance::mix(parts).unwrap().standard_error_lx;
        assert_eq!(error([(Some(sure), 1.0), (Some(unknown), 0.0)]), 2.0);
        assert_eq!(error([(Some(sure), 0.5), (Some(unknown), 0.5)]), f64::INFINITY);
    }
}
