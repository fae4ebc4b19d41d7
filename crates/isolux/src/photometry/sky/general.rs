//! Skies by formula: a gradation from horizon to zenith times an indicatrix about the sun.
//!
//! The luminance in a direction at the angle Z from the zenith and chi from the sun is
//! `scale (1 + a exp(b / cos Z)) (f + c exp(d chi) + e cos^2 chi)`. The fifteen CIE standard general skies (CIE S 011:2003,
//! ISO 15469:2004) have this form with `f = 1 - c exp(d pi / 2)`; the all-weather sky of Perez, Seals and Michalsky (1993) has it
//! with `f = 1`. A uniform sky is that with `a = c = e = 0`.

use crate::quadrature::GaussRule;
use isolux_geometry::Direction;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// The number of CIE standard general skies.
pub const CIE_TYPES: u8 = 15;

/// Parameters a, b of the gradations I to VI of CIE S 011.
const GRADATIONS: [[f64; 2]; 6] =
    [[4.0, -0.7], [1.1, -0.8], [0.0, -1.0], [-1.0, -0.55], [-1.0, -0.32], [-1.0, -0.15]];

/// Parameters c, d, e of the indicatrices 1 to 6 of CIE S 011.
const INDICATRICES: [[f64; 3]; 6] = [
    [0.0, -1.0, 0.0],
    [2.0, -1.5, 0.15],
    [5.0, -2.5, 0.3],
    [10.0, -3.0, 0.45],
    [16.0, -3.0, 0.3],
    [24.0, -2.8, 0.15],
];

/// Gradation and indicatrix of the types 1 to 15, both counted from 0.
const TYPES: [[usize; 2]; CIE_TYPES as usize] = [
    [0, 0],
    [0, 1],
    [1, 0],
    [1, 1],
    [2, 0],
    [2, 1],
    [2, 2],
    [2, 3],
    [3, 1],
    [3, 2],
    [3, 3],
    [4, 3],
    [4, 4],
    [5, 4],
    [5, 5],
];

/// The least cosine from the zenith that the gradation is evaluated at, half a degree above the horizon: where b is positive it
/// has a pole there. Radiance's `perezlum.cal` has the same limit.
const LEAST_COS: f64 = 0.01;

/// Nodes of quadrature over a part of the hemisphere, for each of two angles. Twice as many change no integral of the CIE
/// skies by more than 1e-7 (test).
const NODES: usize = 24;

/// A sky by formula.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GeneralSky {
    /// Gradation: a and b.
    pub gradation: [f64; 2],
    /// Indicatrix: f, c, d (1/rad) and e.
    pub indicatrix: [f64; 4],
    /// Towards the sun, which itself is not part of it.
    pub sun: Direction,
    /// Factor of gradation and indicatrix, cd/m2.
    pub scale_cd_m2: f64,
}

impl GeneralSky {
    /// A sky of the same luminance everywhere.
    pub const fn uniform(luminance_cd_m2: f64) -> Self {
        let (gradation, indicatrix) = ([0.0, -1.0], [1.0, 0.0, -1.0, 0.0]);
        Self { gradation, indicatrix, sun: Direction::Z, scale_cd_m2: luminance_cd_m2 }
    }

    /// A CIE standard general sky of type 1 (overcast) to 15, with a factor of 1 cd/m2. `None` for other types.
    pub fn cie(number: u8, sun: Direction) -> Option<Self> {
        let [gradation, indicatrix] = *TYPES.get(usize::from(number.checked_sub(1)?))?;
        let [c, d, e] = INDICATRICES[indicatrix];
        let f = 1.0 - c * libm::exp(d * FRAC_PI_2);
        let gradation = GRADATIONS[gradation];
        Some(Self { gradation, indicatrix: [f, c, d, e], sun, scale_cd_m2: 1.0 })
    }

    /// Luminance in a direction of the frame of skies, cd/m2; zero below the horizon.
    pub fn luminance_cd_m2(&self, towards: Direction) -> f64 {
        let up = towards.to_vector().z;
        if up < 0.0 {
            return 0.0;
        }
        (self.scale_cd_m2 * self.gradation(up) * self.indicatrix(towards.dot(self.sun))).max(0.0)
    }

    /// Illuminance of a horizontal surface below the open sky, without the sun, lx.
    pub fn horizontal_lx(&self) -> f64 {
        self.integral(|up| up)
    }

    /// The same sky with this illuminance of a horizontal surface, lx. `None` where it has none.
    pub fn with_horizontal_lx(self, lx: f64) -> Option<Self> {
        let present = self.horizontal_lx();
        (present > 0.0).then(|| self.scaled(lx / present))
    }

    /// The same sky with this luminance in the zenith, cd/m2. `None` where it has none.
    pub fn with_zenith_cd_m2(self, luminance_cd_m2: f64) -> Option<Self> {
        let present = self.luminance_cd_m2(Direction::Z);
        (present > 0.0).then(|| self.scaled(luminance_cd_m2 / present))
    }

    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { scale_cd_m2: self.scale_cd_m2 * factor, ..self }
    }

    pub(super) fn is_sound(&self) -> bool {
        let all = self.gradation.iter().chain(&self.indicatrix).chain([&self.scale_cd_m2]);
        all.into_iter().all(|number| number.is_finite()) && self.scale_cd_m2 >= 0.0
    }

    fn gradation(&self, cos_zenith: f64) -> f64 {
        let [a, b] = self.gradation;
        1.0 + a * libm::exp(b / cos_zenith.max(LEAST_COS))
    }

    fn indicatrix(&self, cos_sun: f64) -> f64 {
        let [f, c, d, e] = self.indicatrix;
        let chi_rad = libm::acos(cos_sun.clamp(-1.0, 1.0));
        f + c * libm::exp(d * chi_rad) + e * cos_sun * cos_sun
    }

    /// The integral of luminance times a weight of the sine of elevation over the hemisphere. It is split at the sun, where
    /// the indicatrix has a cusp.
    fn integral(&self, weight: impl Fn(f64) -> f64) -> f64 {
        let rule = GaussRule::new(NODES);
        let sun = self.sun.to_vector();
        let sun_elevation = libm::asin(sun.z.clamp(0.0, 1.0));
        let ring = |elevation: f64| {
            let (sin, cos) = libm::sincos(elevation);
            let flat = libm::hypot(sun.x, sun.y);
            // Both halves about the sun's azimuth are alike.
            let around = |azimuth: f64| {
                let cos_sun = sin * sun.z + cos * flat * libm::cos(azimuth);
                (self.scale_cd_m2 * self.gradation(sin) * self.indicatrix(cos_sun)).max(0.0)
            };
            let cuts = [0.0, 0.1, 0.5, PI];
            let parts = cuts.windows(2).map(|part| rule.integrate(part[0], part[1], around));
            2.0 * weight(sin) * cos * parts.sum::<f64>()
        };
        let mut cuts = [0.0, 0.05, 0.2, sun_elevation, FRAC_PI_2];
        cuts.sort_by(f64::total_cmp);
        cuts.windows(2).map(|part| rule.integrate(part[0], part[1], ring)).sum()
    }
}
