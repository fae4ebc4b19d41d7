//! The transfer function of sRGB (IEC 61966-2-1), and Rec. 709 of other colours.

use isolux::units::Rgb;

/// Linear light of a share of the code range.
pub(crate) fn linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
}

/// The nearest code of a share of light.
pub(crate) fn code(linear: f64) -> u8 {
    let c = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    };
    (255.0 * c).round() as u8
}

/// Linear Rec. 709 from CIE XYZ: the inverse of the matrix of its primaries and D65 white
/// (ITU-R BT.709-6, item 1.3).
pub(crate) fn rec709_from_xyz([x, y, z]: [f64; 3]) -> Rgb {
    Rgb::new(
        3.240_969_942 * x - 1.537_383_178 * y - 0.498_610_760 * z,
        -0.969_243_636 * x + 1.875_967_502 * y + 0.041_555_057 * z,
        0.055_630_080 * x - 0.203_976_959 * y + 1.056_971_514 * z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_come_back() {
        for k in 0..=255 {
            assert_eq!(code(linear(f64::from(k) / 255.0)), k);
        }
    }
}
