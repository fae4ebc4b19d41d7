//! How different colours of a display look.

use crate::colorimetry::{D65_XYZ, XYZ_FROM_REC709};
use isolux::units::Rgb;

/// A display-linear colour in CIE 1976 L*a*b* under the white of the display (CIE 015:2018, section 8.2.1).
pub(crate) fn lab(linear: Rgb) -> [f64; 3] {
    let xyz = XYZ_FROM_REC709.apply(linear.0);
    let [x, y, z] = [0, 1, 2].map(|k| compressed(xyz[k] / D65_XYZ[k]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn compressed(share: f64) -> f64 {
    const LINEAR_UP_TO: f64 = 24.0 / 116.0;
    if share > LINEAR_UP_TO * LINEAR_UP_TO * LINEAR_UP_TO {
        libm::cbrt(share)
    } else {
        841.0 / 108.0 * share + 16.0 / 116.0
    }
}

/// The CIE94 difference of two colours with the weights of graphic arts (CIE 116-1995). Neither is the standard: the chroma is
/// the geometric mean of theirs, as that publication has it then.
pub(crate) fn cie94(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [lightness, a, b] = [0, 1, 2].map(|k| one[k] - other[k]);
    let [chroma, other_chroma] = [one, other].map(|lab| libm::hypot(lab[1], lab[2]));
    let of_chroma = chroma - other_chroma;
    let of_hue_squared = (a * a + b * b - of_chroma * of_chroma).max(0.0);
    let mean = (chroma * other_chroma).sqrt();
    let (for_chroma, for_hue) = (1.0 + 0.045 * mean, 1.0 + 0.015 * mean);
    let chroma_part = of_chroma / for_chroma;
    let squares = lightness * lightness + chroma_part * chroma_part;
    (squares + of_hue_squared / (for_hue * for_hue)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A dozen roundings of numbers up to 100.
    const ROUNDING: f64 = 100.0 * 12.0 * f64::EPSILON;

    #[test]
    fn white_black_and_grey_have_their_lightness() {
        let off = |linear: f64, expected: f64| {
            let [lightness, a, b] = lab(Rgb::WHITE * linear);
            assert!((lightness - expected).abs() < ROUNDING, "{lightness} for {expected}");
            // The digits of the matrix.
            assert!(a.abs() < 1e-9 && b.abs() < 1e-9, "{a} {b}");
        };
        off(1.0, 100.0);
        off(0.0, 0.0);
        // CIE 015: 903.3 Y below the linear part, 116 cbrt(Y) - 16 above.
        off(0.001, 0.001 * 24389.0 / 27.0);
        off(0.125, 42.0);
    }

    #[test]
    fn differences_are_those_of_the_formula() {
        let check = |one, other, expected: f64| {
            let found = cie94(one, other);
            assert!((found - expected).abs() < ROUNDING, "{found} for {expected}");
            assert_eq!(found, cie94(other, one));
        };
        check([50.0, 0.0, 0.0], [53.0, 0.0, 0.0], 3.0);
        // Chroma alone: 20 and 45, mean 30.
        check([50.0, 20.0, 0.0], [50.0, 45.0, 0.0], 25.0 / 2.35);
        // Hue alone: two colours of chroma 10 at right angles.
        check([50.0, 10.0, 0.0], [50.0, 0.0, 10.0], 200f64.sqrt() / 1.15);
    }
}
