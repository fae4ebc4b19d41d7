//! Differences of two colours as people see them.

use super::ciede2000::ciede2000;
use super::lab::Lab;
use serde::Serialize;

/// A formula for the difference of two colours: 1 is about what is just seen side by side, but by CIE 1976 several
/// are not seen of strong colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DeltaE {
    /// [`delta_e_1976`].
    Cie1976,
    /// [`delta_e_1994`].
    Cie1994,
    /// [`ciede2000`].
    Ciede2000,
}

impl DeltaE {
    /// Every formula, by the year of it.
    pub const ALL: [Self; 3] = [Self::Cie1976, Self::Cie1994, Self::Ciede2000];

    /// The difference of a colour from its reference.
    pub fn between(self, reference: Lab, measured: Lab) -> f64 {
        match self {
            Self::Cie1976 => delta_e_1976(reference, measured),
            Self::Cie1994 => delta_e_1994(reference, measured),
            Self::Ciede2000 => ciede2000(reference, measured),
        }
    }
}

/// The difference of CIE 1976 is the distance in L\*a\*b\*, sqrt(dL^2 + da^2 + db^2), without unit
/// (CIE 15:2004).
pub fn delta_e_1976(one: Lab, other: Lab) -> f64 {
    let (l, a, b) = (other.l - one.l, other.a - one.a, other.b - one.b);
    (l * l + a * a + b * b).sqrt()
}

/// The difference of CIE 1994 is sqrt(dL^2 + (dC / SC)^2 + (dH / SH)^2), where dH^2 = da^2 + db^2 - dC^2,
/// SC = 1 + 0.045 C and SH = 1 + 0.015 C, and C is the chroma of the reference. It has no unit and is not
/// symmetric (CIE 116-1995; kL = kC = kH = 1, as in graphic arts). The study of Kopylov, Khodulev, Volevich
/// (1998) calls it CIE 1995.
pub fn delta_e_1994(reference: Lab, measured: Lab) -> f64 {
    let (l, a, b) = (measured.l - reference.l, measured.a - reference.a, measured.b - reference.b);
    let chroma = measured.chroma() - reference.chroma();
    // Of colours of one hue roundings may leave less than nothing.
    let hue = (a * a + b * b - chroma * chroma).max(0.0).sqrt();
    let weighted_chroma = chroma / (1.0 + 0.045 * reference.chroma());
    let weighted_hue = hue / (1.0 + 0.015 * reference.chroma());
    (l * l + weighted_chroma * weighted_chroma + weighted_hue * weighted_hue).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::{PRINTED_SIX_DIGITS, ROUNDING};

    fn check_1994(reference: [f64; 3], measured: [f64; 3], expected: f64) {
        let found = delta_e_1994(reference.into(), measured.into());
        assert!((found - expected).abs() < PRINTED_SIX_DIGITS, "{reference:?}: {found} {expected}");
    }

    #[test]
    fn cie_1976_is_a_distance() {
        let (one, other) = ([50.0, 3.0, -4.0].into(), [62.0, 0.0, 0.0].into());
        assert_eq!(delta_e_1976(one, other), 13.0);
        assert_eq!(delta_e_1976(other, one), 13.0);
    }

    /// Pairs of Sharma, Wu, Dalal (2005), differences by colour-science 0.4.7.
    #[test]
    fn cie_1994_is_that_of_colour_science() {
        check_1994([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 1.395039);
        check_1994([50.0, 0.0, -82.7485], [50.0, 2.6772, -79.7751], 1.365285);
        check_1994([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.031638);
        check_1994([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 34.689163);
        check_1994([50.0, 2.5, 0.0], [61.0, -5.0, 29.0], 29.441373);
        check_1994([61.0, -5.0, 29.0], [50.0, 2.5, 0.0], 18.386885);
        check_1994([22.7233, 20.0904, -46.694], [23.0331, 14.973, -42.5619], 2.556133);
        check_1994([2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 1.306545);
    }

    #[test]
    fn cie_1994_weights_by_the_chroma_of_the_reference() {
        let (grey, red): (Lab, Lab) = ([50.0, 0.0, 0.0].into(), [50.0, 40.0, 0.0].into());
        assert!((delta_e_1994(grey, red) - 40.0).abs() < ROUNDING);
        // 1 + 0.045 x 40 = 2.8.
        assert!((delta_e_1994(red, grey) - 40.0 / 2.8).abs() < ROUNDING);
    }

    #[test]
    fn every_formula_is_zero_of_the_same_and_lightness_of_greys_near_the_middle() {
        let colours = [[0.0; 3], [50.0, 0.0, 0.0], [31.0, -20.3, 77.7], [100.0, 1e-9, -1e-9]];
        for formula in DeltaE::ALL {
            for colour in colours {
                assert_eq!(formula.between(colour.into(), colour.into()), 0.0, "{formula:?}");
            }
            let greys = formula.between([49.0, 0.0, 0.0].into(), [51.0, 0.0, 0.0].into());
            assert!((greys - 2.0).abs() < ROUNDING, "{formula:?} {greys}");
        }
    }
}
