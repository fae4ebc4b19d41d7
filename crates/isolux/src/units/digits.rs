//! Numbers as text: rounded to what their errors allow, or to so many digits.

/// Digits that files keep below the first digit of the error.
const KEPT: i32 = 2;
/// Digits behind the point that are still read: what takes more is written with its power of ten.
const MOST_DECIMALS: i32 = 12;

/// A number with so many significant digits, and no fewer than its whole part has.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        // Without the sign of a zero.
        return format!("{}", value + 0.0);
    }
    let magnitude = value.abs().log10().floor() as i32;
    let decimals = (digits as i32 - 1 - magnitude).max(0);
    if decimals > MOST_DECIMALS {
        return format!("{value:.*e}", digits.max(1) - 1);
    }
    format!("{value:.*}", decimals as usize)
}

/// A number with at most so many significant digits, and without zeros at its end: 0.2 for 0.199999.
pub fn short(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    if text.contains('e') || !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Where the first digit of an error stands behind the point, negative before it; `None` if it says nothing.
pub fn first_digit(error: f64) -> Option<i32> {
    (error > 0.0 && error.is_finite()).then(|| -(error.log10().floor() as i32))
}

/// A number with so many digits behind the point; fewer than none round its whole part.
pub fn to_decimals(value: f64, decimals: i32) -> String {
    if decimals > MOST_DECIMALS || !value.is_finite() {
        return value.to_string();
    }
    let scale = libm::pow(10.0, f64::from((-decimals).max(0)));
    let whole = if decimals < 0 { (value / scale).round() * scale } else { value };
    let shown = decimals.max(0) as usize;
    let text = format!("{whole:.shown$}");
    // Nothing has no sign, and no digits.
    let is_nothing = text.trim_start_matches(['-', '0', '.']).is_empty();
    if is_nothing { "0".to_owned() } else { text }
}

/// Digits of exact numbers, for people.
const EXACT: usize = 3;

/// Digits behind the point down to the first digit of an error, and to the second where the first is a 1.
fn decimals(error: f64) -> Option<i32> {
    let first = first_digit(error)?;
    let is_one = error * libm::pow(10.0, f64::from(first)) < 2.0;
    Some(first + i32::from(is_one))
}

/// A number as people read it: no more digits than its error allows.
pub fn to_error(value: f64, error: f64) -> String {
    match decimals(error) {
        Some(decimals) => to_decimals(value, decimals),
        None => significant(value, EXACT),
    }
}

/// A number and its error: `512 ± 4`.
pub fn with_error(value: f64, error: f64) -> String {
    format!("{} \u{b1} {}", to_error(value, error), to_error(error, error))
}

/// How numbers with an error are written to files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Digits {
    /// With two digits below the first digit of their error, so that nothing is lost.
    #[default]
    ByError,
    /// With so many significant digits.
    Significant(u8),
}

impl Digits {
    /// A number, or a part of it, whose standard error is this.
    pub fn number(self, value: f64, error: f64) -> String {
        match (self, first_digit(error)) {
            (Self::Significant(digits), _) => significant(value, digits.into()),
            (Self::ByError, Some(first)) => to_decimals(value, first + KEPT),
            (Self::ByError, None) => value.to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_counted_from_the_first() {
        assert_eq!(significant(1234.5, 3), "1234");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(significant(-0.0, 3), "0");
        assert_eq!(significant(1.23e-10, 3), "0.000000000123");
        // What would have no digit left.
        assert_eq!(significant(1e-13, 3), "1.00e-13");
        assert_eq!(significant(-3.21e-14, 2), "-3.2e-14");
        // Regression: messages showed 0.19999999999999996.
        assert_eq!(short(1.0 - 0.8, 4), "0.2");
        assert_eq!(short(100.0, 4), "100");
        assert_eq!(short(0.0, 4), "0");
    }

    #[test]
    fn files_keep_two_digits_below_the_first_of_the_error() {
        for (value, error, expected) in [
            (512.345_678, 4.0, "512.35"),
            (4.123_456, 4.123_456, "4.12"),
            (51_234.6, 400.0, "51235"),
            (51_234.6, 40_000.0, "51200"),
            (-0.001, 1.0, "0"),
            (0.1, 0.0, "0.1"),
            (0.1, f64::INFINITY, "0.1"),
            (1e-20, 1e-22, "0.00000000000000000001"),
        ] {
            assert_eq!(Digits::ByError.number(value, error), expected, "{value} {error}");
        }
        assert_eq!(Digits::Significant(3).number(512.345_678, 4.0), "512");
        assert_eq!(Digits::Significant(6).number(512.345_678, 4.0), "512.346");
    }

    #[test]
    fn seventeen_digits_are_all() {
        for value in [0.1, 1.0 / 3.0, 512.345_678_9, 1e-9 / 7.0, 123_456_789.123] {
            assert_eq!(Digits::Significant(17).number(value, 1.0).parse(), Ok(value));
        }
    }

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
