//! Numbers rounded to what their errors allow.

/// Digits of exact numbers that people read.
const EXACT: usize = 3;
/// Digits that files keep below the first digit of the error.
const KEPT: i32 = 2;
/// Digits behind the point that are written at most.
const MOST_DECIMALS: i32 = 12;

/// Where the first digit of an error stands behind the point, negative before it; `None` if it says nothing.
fn first_digit(error: f64) -> Option<i32> {
    (error > 0.0 && error.is_finite()).then(|| -(error.log10().floor() as i32))
}

/// For reading: down to the first digit of the error, and to the second where the first is a 1.
pub(crate) fn decimals(error: f64) -> Option<i32> {
    let first = first_digit(error)?;
    let is_one = error * 10f64.powi(first) < 2.0;
    Some(first + i32::from(is_one))
}

/// A number with so many digits behind the point; fewer than none round its whole part.
pub(crate) fn to_decimals(value: f64, decimals: i32) -> String {
    if decimals > MOST_DECIMALS {
        return value.to_string();
    }
    let (scale, shown) = (10f64.powi((-decimals).max(0)), decimals.max(0) as usize);
    let text = format!("{:.shown$}", (value / scale).round_if(scale > 1.0) * scale);
    // Nothing has no sign, and no digits.
    if text.trim_start_matches(['-', '0', '.']).is_empty() {
        return "0".to_owned();
    }
    text
}

trait RoundIf {
    fn round_if(self, is_rounded: bool) -> Self;
}

impl RoundIf for f64 {
    fn round_if(self, is_rounded: bool) -> Self {
        if is_rounded { self.round() } else { self }
    }
}

/// A number for reading, as precisely as its error allows.
pub(crate) fn to_error(value: f64, error: f64) -> String {
    match decimals(error) {
        Some(decimals) => to_decimals(value, decimals),
        None => crate::quantity::significant(value, EXACT),
    }
}

/// How numbers with an error are written to files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Written {
    /// With two digits below the first digit of their error, so that nothing is lost.
    ByError,
    /// With so many significant digits.
    Digits(usize),
}

impl Written {
    /// As the flag `--digits` asks.
    pub(crate) fn of(digits: Option<u8>) -> Self {
        digits.map_or(Self::ByError, |digits| Self::Digits(digits.into()))
    }

    /// A number, or a part of it, whose standard error is this.
    pub(crate) fn number(self, value: f64, error: f64) -> String {
        match self {
            Self::Digits(digits) => crate::quantity::significant(value, digits),
            Self::ByError => match first_digit(error) {
                Some(first) => to_decimals(value, first + KEPT),
                None => value.to_string(),
            },
        }
    }
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
    fn files_keep_two_digits_below_the_first_of_the_error() {
        let written = |value, error| Written::ByError.number(value, error);
        assert_eq!(written(512.345_678, 4.0), "512.35");
        assert_eq!(written(4.123_456, 4.123_456), "4.12");
        assert_eq!(written(51_234.6, 400.0), "51235");
        assert_eq!(written(51_234.6, 40_000.0), "51200");
        assert_eq!(written(0.1, 0.0), "0.1");
        assert_eq!(written(1e-20, 1e-22), "0.00000000000000000001");
        assert_eq!(Written::of(Some(3)).number(512.345_678, 4.0), "512");
        assert_eq!(Written::of(Some(6)).number(512.345_678, 4.0), "512.346");
    }
}
