//! CIE 1931 XYZ, the colours of Rec. 709 in it, and what is seen alike under different whites.

use crate::matrix::Matrix3;

/// XYZ of the white of Rec. 709, D65 at x = 0.3127, y = 0.3290, for Y = 1.
pub(crate) const D65_XYZ: [f64; 3] = [0.950_455_927_051_671_7, 1.0, 1.089_057_750_759_878_4];

/// XYZ of the white of the profile connection space (ICC.1:2022, section 7.2.16), as its files write it.
pub(crate) const D50_XYZ: [f64; 3] = [63190.0 / 65536.0, 1.0, 54061.0 / 65536.0];

/// From linear Rec. 709 to XYZ, white having Y = 1: its primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and D65
/// (ITU-R BT.709-6, items 1.3 and 1.4).
pub(crate) const XYZ_FROM_REC709: Matrix3 = Matrix3([
    [0.412_390_799_265_959_5, 0.357_584_339_383_878, 0.180_480_788_401_834_3],
    [0.212_639_005_871_510_4, 0.715_168_678_767_755_9, 0.072_192_315_360_733_71],
    [0.019_330_818_715_591_85, 0.119_194_779_794_626, 0.950_532_152_249_660_6],
]);

/// From XYZ to linear Rec. 709.
pub(crate) const REC709_FROM_XYZ: Matrix3 = Matrix3([
    [3.240_969_941_904_521, -1.537_383_177_570_093, -0.498_610_760_293_003_3],
    [-0.969_243_636_280_879_8, 1.875_967_501_507_721, 0.041_555_057_407_175_61],
    [0.055_630_079_696_993_61, -0.203_976_958_888_976_6, 1.056_971_514_242_879],
]);

/// From XYZ to the responses of sharpened cones, the matrix of Bradford (Lam 1985, "Metamerism and colour constancy"; as in
/// ICC.1:2022, annex E.3).
const BRADFORD: Matrix3 =
    Matrix3([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]);

/// From those responses to XYZ.
const BRADFORD_INVERSE: Matrix3 = Matrix3([
    [0.986_992_905_466_712_1, -0.147_054_256_420_990_1, 0.159_962_651_663_731_2],
    [0.432_305_269_723_394_5, 0.518_360_271_536_777_6, 0.049_291_228_212_855_61],
    [-0.008_528_664_575_177_331, 0.040_042_821_654_084_86, 0.968_486_695_787_55],
]);

/// What takes colours seen under one white to those that look alike under another, both in XYZ: a factor for each of the
/// cones (von Kries 1902) in the space of Bradford, that takes white to white. Entries are no numbers where a cone does not
/// see `from` at all.
pub(crate) fn adaptation(from: [f64; 3], to: [f64; 3]) -> Matrix3 {
    let [from, to] = [from, to].map(|white| BRADFORD.apply(white));
    let factors = [0, 1, 2].map(|cone| to[cone] / from[cone]);
    BRADFORD_INVERSE.after(&Matrix3::diagonal(factors)).after(&BRADFORD)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A few roundings of numbers up to 4.
    const ROUNDING: f64 = 32.0 * f64::EPSILON;

    #[track_caller]
    fn check(got: [f64; 3], expected: [f64; 3], tolerance: f64) {
        let off = got.into_iter().zip(expected).map(|(g, e)| (g - e).abs()).fold(0.0, f64::max);
        assert!(off <= tolerance, "{got:?} for {expected:?}");
    }

    #[test]
    fn rec709_has_its_primaries_and_its_white() {
        check(XYZ_FROM_REC709.apply([1.0; 3]), D65_XYZ, ROUNDING);
        let primaries = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
        for (channel, [x, y]) in primaries.into_iter().enumerate() {
            let [cx, cy, cz] = XYZ_FROM_REC709.0.map(|row| row[channel]);
            let sum = cx + cy + cz;
            check([cx / sum, cy / sum, 0.0], [x, y, 0.0], ROUNDING);
        }
    }

    #[test]
    fn inverses_take_back() {
        for (m, back) in [(XYZ_FROM_REC709, REC709_FROM_XYZ), (BRADFORD, BRADFORD_INVERSE)] {
            let identity = back.after(&m);
            for row in 0..3 {
                check(identity.0[row], Matrix3::IDENTITY.0[row], ROUNDING);
            }
        }
    }

    #[test]
    fn adaptation_takes_white_to_white() {
        check(adaptation(D65_XYZ, D50_XYZ).apply(D65_XYZ), D50_XYZ, ROUNDING);
        // ICC.1:2022, annex E.3, prints the first row of D65 to D50 as 1.0479, 0.0229, -0.0502.
        check(adaptation(D65_XYZ, D50_XYZ).0[0], [1.0479, 0.0229, -0.0502], 5e-5);
        let same = adaptation(D65_XYZ, D65_XYZ).apply([0.3, 0.2, 0.1]);
        check(same, [0.3, 0.2, 0.1], ROUNDING);
    }
}
