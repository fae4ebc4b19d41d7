//! The operator of Tumblin and Rushmeier, as revised in 1999.

use super::levels::Levels;
use crate::exposure::MIDDLE_GREY;
use isolux::units::Rgb;

/// Contrast that a display reaches in a lit room: `C_max` of the paper, which has 30 to 100 for it.
const MOST_CONTRAST: f64 = 100.0;

/// The share of white that shows a luminance: factor (exposed / middle grey)^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Power {
    factor: f64,
    exponent: f64,
}

impl Power {
    /// `L_d` = `L_da` m (`L_w` / `L_wa`)^g with g = gamma(`L_wa`) / gamma(`L_da`) and m = `C_max`^((g - 1) / 2). The paper leaves the
    /// adaptation to the display, `L_da`, open; here it is the middle of what the display can show, as a ratio: `L_dmax` / sqrt(`C_max`).
    pub(super) fn of(levels: Levels) -> Self {
        let reach = libm::sqrt(MOST_CONTRAST);
        let display_adaptation_cd_m2 = levels.display_white_cd_m2 / reach;
        let exponent = gamma(levels.adaptation_cd_m2()) / gamma(display_adaptation_cd_m2);
        Self { factor: libm::pow(reach, exponent - 1.0) / reach, exponent }
    }

    /// The colour with its luminance shown.
    pub(super) fn show(self, exposed: Rgb) -> Rgb {
        let luminance = exposed.luminance();
        if luminance <= 0.0 {
            return Rgb::BLACK;
        }
        let shown = self.factor * libm::pow(luminance / MIDDLE_GREY, self.exponent);
        // Far beyond white the power may leave the range of numbers.
        exposed * (shown.min(f64::MAX) / luminance)
    }
}

/// How fast brightness rises with luminance for eyes adapted to one, cd/m2 (Stevens and Stevens 1963, as the paper of 1999 has it).
fn gamma(adaptation_cd_m2: f64) -> f64 {
    if adaptation_cd_m2 > 100.0 {
        2.655
    } else {
        1.855 + 0.4 * libm::log10(adaptation_cd_m2 + 2.3e-5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(adaptation_cd_m2: f64, luminance_cd_m2: f64) -> f64 {
        let white_cd_m2 = adaptation_cd_m2 / MIDDLE_GREY;
        let power = Power::of(Levels { white_cd_m2, display_white_cd_m2: 100.0 });
        power.show(Rgb::grey(luminance_cd_m2 / white_cd_m2)).luminance()
    }

    #[track_caller]
    fn check(adaptation_cd_m2: f64, luminance_cd_m2: f64, expected: f64) {
        let got = share(adaptation_cd_m2, luminance_cd_m2);
        // Expected values have six digits.
        assert!((got / expected - 1.0).abs() < 1e-5, "{got} for {expected}");
    }

    #[test]
    fn worked_by_hand() {
        // gamma(1000) = 2.655, gamma(10) = 2.255, g = 1.177384, m = 10^0.177384 = 1.504469; L_da m / L_dmax = 0.150447.
        check(1000.0, 1000.0, 0.150_447);
        check(1000.0, 5000.0, 1.000_78);
        // gamma(1) = 1.855, g = 0.822618, m = 0.664688.
        check(1.0, 1.0, 0.066_468_8);
        check(1.0, 10.0, 0.441_811);
    }

    #[test]
    fn a_tenth_of_the_adaptation_is_the_black_of_the_display() {
        for adaptation_cd_m2 in [0.01, 1.0, 50.0, 1e4] {
            check(adaptation_cd_m2, 0.1 * adaptation_cd_m2, 1.0 / MOST_CONTRAST);
        }
    }

    #[test]
    fn dim_scenes_are_shown_dim_and_flat() {
        let contrast =
            |adaptation: f64| share(adaptation, 2.0 * adaptation) / share(adaptation, adaptation);
        assert!(share(0.01, 0.01) < share(1.0, 1.0) && share(1.0, 1.0) < share(100.0, 100.0));
        assert!(contrast(0.01) < contrast(1.0) && contrast(1.0) < contrast(100.0));
    }
}
