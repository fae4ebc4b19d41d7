//! The transfer function of sRGB (IEC 61966-2-1).

use isolux::units::Rgb;

/// The display-linear value of a signal, which is 0 for black and 1 for white; beyond white the power goes on.
pub(crate) fn linear_from_signal(signal: f64) -> f64 {
    if signal <= 0.04045 { signal / 12.92 } else { libm::pow((signal + 0.055) / 1.055, 2.4) }
}

/// The signal of a display-linear value.
pub(crate) fn signal_from_linear(value: f64) -> f64 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * libm::pow(value, 1.0 / 2.4) - 0.055 }
}

/// The display-linear value of a code.
pub(crate) fn linear_from_code(code: u8) -> f64 {
    linear_from_signal(f64::from(code) / 255.0)
}

/// The code nearest to a display-linear value, clipped to 0..1; zero for NaN.
pub(crate) fn code_from_linear(value: f64) -> u8 {
    (255.0 * signal_from_linear(value).clamp(0.0, 1.0) + 0.5) as u8
}

/// Three channels at once.
pub(crate) fn codes_from_linear(colour: Rgb) -> [u8; 3] {
    colour.0.map(code_from_linear)
}

/// Three channels at once.
pub(crate) fn linear_from_codes(codes: [u8; 3]) -> Rgb {
    Rgb(codes.map(linear_from_code))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_survives_the_round_trip() {
        for code in 0..=255 {
            assert_eq!(code_from_linear(linear_from_code(code)), code);
        }
    }

    #[test]
    fn values_beyond_the_display_are_clipped() {
        assert_eq!([-1.0, f64::NAN, 1e9, f64::INFINITY].map(code_from_linear), [0, 0, 255, 255]);
    }

    #[test]
    fn middle_grey_has_its_code() {
        // 1.055 * 0.18^(1/2.4) - 0.055 = 0.4614 of 255.
        assert_eq!(code_from_linear(0.18), 118);
    }
}
