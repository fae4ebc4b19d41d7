//! The scale factor of Ward 1994.

use super::levels::Levels;

/// The share of the white of the display that shows a luminance, per cd/m2: m of the paper over `L_dmax`,
/// (1 / `L_dmax`) ((1.219 + (`L_dmax` / 2)^0.4) / (1.219 + `L_wa`^0.4))^2.5. Eyes at the display are adapted to half of
/// its white. The constants are those of Blackwell 1981 for the least difference that is seen.
///
/// The paper takes `L_wa` as the log-average without the light sources; here it is that of all that is lit.
pub(super) fn factor(levels: Levels) -> f64 {
    let visible = |adaptation_cd_m2: f64| 1.219 + libm::pow(adaptation_cd_m2, 0.4);
    let display = levels.display_white_cd_m2;
    let ratio = visible(0.5 * display) / visible(levels.adaptation_cd_m2());
    libm::pow(ratio, 2.5) / display
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(adaptation_cd_m2: f64, display_white_cd_m2: f64, expected: f64) {
        let white_cd_m2 = adaptation_cd_m2 / 0.18;
        let got = factor(Levels { white_cd_m2, display_white_cd_m2 });
        // Expected values have seven digits.
        assert!((got / expected - 1.0).abs() < 1e-6, "{got} for {expected}");
    }

    #[test]
    fn worked_by_hand() {
        // 50^0.4 = 4.781762, 100^0.4 = 6.309573, 1^0.4 = 1: (6.000762 / 7.528573)^2.5 / 100, (6.000762 / 2.219)^2.5 / 100.
        check(100.0, 100.0, 0.005_671_976);
        check(1.0, 100.0, 0.120_260_5);
        // Eyes adapted alike see alike: the luminances are shown as they are.
        check(50.0, 100.0, 0.01);
    }
}
