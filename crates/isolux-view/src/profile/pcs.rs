//! The profile connection space: how tables write colours.

use crate::colorimetry::D50_XYZ;
use moxcms::{DataColorSpace, LutType};

/// XYZ of 1 in tables (ICC.1:2022, section 6.3.4.2).
const XYZ_RANGE: f64 = 1.0 + 32767.0 / 32768.0;
/// L* and a*, b* are written in parts of 65280 instead of 65535 by tables of 16 bits of version 2, and of their type in
/// version 4 (ICC.1:2022, section 10.10).
const LEGACY: f64 = 65535.0 / 65280.0;

/// Three numbers of 0 to 1 that stand for a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pcs {
    Xyz,
    Lab,
    LegacyLab,
}

impl Pcs {
    /// How a table of a type writes a space; `None` for spaces that connect no profiles.
    pub(super) fn of(space: DataColorSpace, table: LutType) -> Option<Self> {
        match (space, table) {
            (DataColorSpace::Xyz, _) => Some(Self::Xyz),
            (DataColorSpace::Lab, LutType::Lut16) => Some(Self::LegacyLab),
            (DataColorSpace::Lab, _) => Some(Self::Lab),
            _ => None,
        }
    }

    /// XYZ under D50 of a colour.
    pub(super) fn xyz(self, numbers: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Xyz => numbers.map(|v| XYZ_RANGE * v),
            Self::Lab | Self::LegacyLab => {
                let [l, a, b] = numbers.map(|v| self.lab_step() * v);
                xyz_from_lab([100.0 * l, 255.0 * a - 128.0, 255.0 * b - 128.0])
            }
        }
    }

    /// The numbers for XYZ under D50.
    pub(super) fn numbers(self, xyz: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Xyz => xyz.map(|v| v / XYZ_RANGE),
            Self::Lab | Self::LegacyLab => {
                let [l, a, b] = lab_from_xyz(xyz);
                let numbers = [l / 100.0, (a + 128.0) / 255.0, (b + 128.0) / 255.0];
                numbers.map(|v| v / self.lab_step())
            }
        }
    }

    fn lab_step(self) -> f64 {
        if self == Self::LegacyLab { LEGACY } else { 1.0 }
    }
}

/// From where on L* is a cube root (CIE 15:2018, section 8.2.1), and its slope below.
const CUBE_FROM: f64 = 216.0 / 24389.0;
const SLOPE: f64 = 24389.0 / 27.0;

fn lab_from_xyz(xyz: [f64; 3]) -> [f64; 3] {
    let root = |t: f64| if t > CUBE_FROM { libm::cbrt(t) } else { (SLOPE * t + 16.0) / 116.0 };
    let [x, y, z] = [0, 1, 2].map(|k| root(xyz[k] / D50_XYZ[k]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn xyz_from_lab([l, a, b]: [f64; 3]) -> [f64; 3] {
    let y = (l + 16.0) / 116.0;
    let cube = |t: f64| {
        let cube = t * t * t;
        if cube > CUBE_FROM { cube } else { (116.0 * t - 16.0) / SLOPE }
    };
    let shares = [y + a / 500.0, y, y - b / 200.0].map(cube);
    [0, 1, 2].map(|k| shares[k] * D50_XYZ[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(got: [f64; 3], expected: [f64; 3], tolerance: f64) {
        let off = got.into_iter().zip(expected).map(|(g, e)| (g - e).abs()).fold(0.0, f64::max);
        assert!(off <= tolerance, "{got:?} for {expected:?}");
    }

    #[test]
    fn numbers_come_back() {
        for pcs in [Pcs::Xyz, Pcs::Lab, Pcs::LegacyLab] {
            for xyz in [D50_XYZ, [0.2, 0.1, 0.02], [0.001, 0.002, 0.0], [0.0; 3]] {
                // Some dozen roundings of numbers up to 200.
                check(pcs.xyz(pcs.numbers(xyz)), xyz, 1e-13);
            }
        }
    }

    #[test]
    fn white_has_its_numbers() {
        // ICC.1:2022, tables 41 and 42: white is FFFFh, 8080h, 8080h, in tables of 16 bits FF00h, 8000h, 8000h.
        check(Pcs::Lab.numbers(D50_XYZ), [1.0, 32896.0 / 65535.0, 32896.0 / 65535.0], 1e-12);
        let legacy = [65280.0, 32768.0, 32768.0].map(|v| v / 65535.0);
        check(Pcs::LegacyLab.numbers(D50_XYZ), legacy, 1e-12);
        check(Pcs::Xyz.numbers(D50_XYZ), D50_XYZ.map(|v| v * 32768.0 / 65535.0), 1e-12);
    }

    #[test]
    fn only_xyz_and_lab_connect() {
        assert_eq!(Pcs::of(DataColorSpace::Rgb, LutType::Lut16), None);
        assert_eq!(Pcs::of(DataColorSpace::Lab, LutType::Lut16), Some(Pcs::LegacyLab));
        assert_eq!(Pcs::of(DataColorSpace::Lab, LutType::LutMab), Some(Pcs::Lab));
    }
}
