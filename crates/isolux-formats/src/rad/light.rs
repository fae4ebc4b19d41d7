//! Radiance's light in photometric units.

use crate::efficacy::EFFICACY_LM_W;
use isolux::units::Rgb;

/// Share of each channel in luminance (`CIE_rf`, `CIE_gf`, `CIE_bf` of the same file).
const WEIGHTS: [f64; 3] = [0.265, 0.670, 0.065];

/// Luminance of a radiance in W/(sr m2), with the colour of its channels. The channels are
/// scaled so that the luminance is the one that Radiance reports, to the last digit.
pub(super) fn luminance_cd_m2([r, g, b]: [f64; 3]) -> Rgb {
    let [wr, wg, wb] = WEIGHTS;
    Rgb::new(r, g, b).chromaticity() * (EFFICACY_LM_W * (wr * r + wg * g + wb * b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn luminance_is_radiances_and_the_ratio_of_channels_stays() {
        for rgb in [[1.0, 1.0, 1.0], [10.0, 5.0, 1.0], [0.0, 0.0, 2.0], [1e-3, 0.0, 7.0]] {
            let made = luminance_cd_m2(rgb);
            let due = 179.0 * (0.265 * rgb[0] + 0.67 * rgb[1] + 0.065 * rgb[2]);
            // A few roundings.
            assert!((made.luminance() / due - 1.0).abs() < 1e-14, "{rgb:?}");
            assert!((made.0[0] * rgb[2] - made.0[2] * rgb[0]).abs() < 1e-12 * due);
        }
        assert_eq!(luminance_cd_m2([0.0; 3]), Rgb::BLACK);
    }
}
