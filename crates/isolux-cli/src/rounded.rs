//! Numbers as people read them: no more digits than their errors allow.

use isolux_formats::{first_digit, significant, to_decimals};

/// Digits of exact numbers.
const EXACT: usize = 3;

/// Digits behind the point down to the first digit of an error, and to the second where the first is a 1.
fn decimals(error: f64) -> Option<i32> {
    let first = first_digit(error)?;
    let is_one = error * libm::pow(10.0, f64::from(first)) < 2.0;
    Some(first + i32::from(is_one))
}

/// A number for reading.
pub(crate) fn to_error(value: f64, error: f64) -> String {
    match decimals(error) {
        Some(decimals) => to_decimals(value, decimals),
        None => significant(value, EXACT),
    }
}

/// A number and its error: `512 ± 4`.
pub(crate) fn with_error(value: f64, error: f64) -> String {
    format!("{} \u{b1} {}", to_error(value, error), to_error(error, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_read_what_the_error_allows() {
        for (value, error, expected) in [
            (512.3, 4.0, "512"),
            (512.3, 1.4, "512.3"),
            (512.3, 40.0, "510"),
            (512.3, 140.0, "510"),
            (512.3, 300.0, "500"),
            (0.123_456, 0.000_3, "0.1235"),
            (0.0, 0.02, "0"),
            (-0.001, 0.02, "0"),
            (996.0, 40.0, "1000"),
            (512.3, 0.0, "512"),
            (512.3, f64::INFINITY, "512"),
        ] {
            assert_eq!(to_error(value, error), expected, "{value} {error}");
        }
    }

    #[test]
    fn errors_stand_beside() {
        assert_eq!(with_error(512.3, 4.2), "512 \u{b1} 4");
        assert_eq!(with_error(0.123_456, 0.000_33), "0.1235 \u{b1} 0.0003");
    }
}
