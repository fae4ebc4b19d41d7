//! The transfer function of sRGB (IEC 61966-2-1).

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
