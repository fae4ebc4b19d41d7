//! The colour of light of a correlated colour temperature.

use super::context::Context;
use super::record::LightRecord;
use crate::srgb::rec709_from_xyz;
use isolux::units::Rgb;

/// Temperatures that have a colour here, kelvin.
pub(super) const RANGE_K: std::ops::RangeInclusive<f64> = 1000.0..=25_000.0;

/// Light of a colour temperature, of luminance 1: a black body below 5000 K and daylight from
/// there on, the choice of reference illuminants in CIE 13.3-1995. Red of very warm light lies
/// outside Rec. 709; its negative blue is cut.
pub(super) fn of_temperature(kelvin: f64) -> Rgb {
    let (x, y) = if kelvin < 5000.0 { xy_from_uv(black_body(kelvin)) } else { daylight(kelvin) };
    rec709_from_xyz([x / y, 1.0, (1.0 - x - y) / y]).map(|c| c.max(0.0)).chromaticity()
}

/// CIE 1931 x, y from CIE 1960 u, v.
fn xy_from_uv((u, v): (f64, f64)) -> (f64, f64) {
    let scale = 2.0 * u - 8.0 * v + 4.0;
    (3.0 * u / scale, 2.0 * v / scale)
}

/// CIE 1960 u, v of a black body: the approximation of M. Krystek, "An algorithm to calculate
/// correlated colour temperature", Color Research & Application 10 (1985), within 9e-5 from 1000 K
/// to 15,000 K.
fn black_body(t: f64) -> (f64, f64) {
    let u = (0.860_117_757 + 1.541_182_54e-4 * t + 1.286_412_12e-7 * t * t)
        / (1.0 + 8.424_202_35e-4 * t + 7.081_451_63e-7 * t * t);
    let v = (0.317_398_726 + 4.228_062_45e-5 * t + 4.204_816_91e-8 * t * t)
        / (1.0 - 2.897_418_16e-5 * t + 1.614_560_53e-7 * t * t);
    (u, v)
}

/// CIE 1931 x, y of daylight, 4000 K to 25,000 K (CIE 15:2004, section 3.1).
fn daylight(t: f64) -> (f64, f64) {
    let r = 1e3 / t;
    let x = if t <= 7000.0 {
        ((-4.6070 * r + 2.9678) * r + 0.099_11) * r + 0.244_063
    } else {
        ((-2.0064 * r + 1.9018) * r + 0.247_48) * r + 0.237_040
    };
    (x, (-3.0 * x + 2.870) * x - 0.275)
}

/// What a luminance of one may be off in a file: the rounding of three channels.
const ROUNDING: f64 = 1e-15;

/// The chromaticity of a colour. One that has a luminance of one, up to rounding, stays bit by bit: what was written is read again.
fn chromaticity(colour: Rgb) -> Rgb {
    if (colour.luminance() - 1.0).abs() <= ROUNDING { colour } else { colour.chromaticity() }
}

/// The colour that is given, if any; `None` after a problem.
#[expect(clippy::option_option, reason = "a problem is not the same as no colour")]
pub(super) fn given(record: &LightRecord, context: &mut Context) -> Option<Option<Rgb>> {
    match (record.colour, record.cct_k) {
        (None, None) => Some(None),
        (Some(colour), None) if colour.get_ref().0.luminance() > 0.0 => {
            Some(Some(chromaticity(colour.get_ref().0)))
        }
        (Some(colour), None) => {
            context.problem(&colour.span(), "black has no colour", "use `dimming = 0`");
            None
        }
        (None, Some(cct)) => {
            let kelvin = cct.get_ref().0;
            if RANGE_K.contains(&kelvin) {
                return Some(Some(of_temperature(kelvin)));
            }
            let what = format!("colour temperature {kelvin} K");
            context.problem(&cct.span(), what, "give 1000 to 25000 K, or `colour`");
            None
        }
        (Some(_), Some(cct)) => {
            context.problem(&cct.span(), "`colour` and `cct_k`", "give one of them");
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(found: (f64, f64), expected: (f64, f64), tolerance: f64) {
        let distance = (found.0 - expected.0).abs().max((found.1 - expected.1).abs());
        assert!(distance < tolerance, "{found:?} is {distance} from {expected:?}");
    }

    /// CIE 15:2004: illuminant A is a black body of 2856 K, x 0.44757, y 0.40745; D50, D65 and D75
    /// are daylight of 5003, 6504 and 7504 K.
    #[test]
    fn standard_illuminants() {
        let (x, y) = (0.447_57, 0.407_45);
        let scale = -2.0 * x + 12.0 * y + 3.0;
        let a = (4.0 * x / scale, 6.0 * y / scale);
        // Krystek's error, and five printed digits.
        check(black_body(2856.0), a, 9e-5 + 1e-5);
        check(xy_from_uv(a), (x, y), 1e-12);
        // The polynomials have four to five significant digits.
        check(daylight(5003.0), (0.345_67, 0.358_50), 2e-4);
        check(daylight(6504.0), (0.312_72, 0.329_03), 2e-4);
        check(daylight(7504.0), (0.299_02, 0.314_85), 2e-4);
    }

    #[test]
    fn the_white_of_rec_709_is_daylight_of_6504_k() {
        let white = of_temperature(6504.0);
        // The two definitions of D65 differ in the fourth decimal of x, y.
        assert!((white.max_channel() - 1.0).abs() < 3e-3, "{white:?}");
        assert!((white.min_channel() - 1.0).abs() < 3e-3, "{white:?}");
    }

    #[test]
    fn colours_are_light_of_luminance_one_and_turn_from_red_to_blue() {
        let mut before = f64::INFINITY;
        for t in [1000.0, 1667.0, 2700.0, 4000.0, 5000.0, 6500.0, 10_000.0, 25_000.0] {
            let colour = of_temperature(t);
            // A few roundings.
            assert!((colour.luminance() - 1.0).abs() < 1e-12);
            assert!(colour.min_channel() >= 0.0);
            let warmth = colour.0[0] - colour.0[2];
            assert!(warmth < before, "{t}");
            before = warmth;
        }
    }
}
