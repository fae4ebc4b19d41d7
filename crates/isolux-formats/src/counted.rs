//! Counts and numbers in sentences.

use std::fmt::Display;

/// A count and what is counted: `1 point`, `2 points`.
pub fn counted<N: Display + PartialEq + From<u8>>(count: N, one: &str, many: &str) -> String {
    let name = if count == N::from(1) { one } else { many };
    format!("{count} {name}")
}

/// A number as people write it: with an exponent where it would be a long row of digits.
pub(crate) fn shown(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-6..1e15).contains(&size) {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn huge_and_tiny_numbers_have_exponents() {
        let values = [0.0, 1.5, -120.0, 1e14, 1e308, -2e-9, f64::INFINITY].map(shown);
        assert_eq!(values, ["0", "1.5", "-120", "100000000000000", "1e308", "-2e-9", "inf"]);
    }

    #[test]
    fn one_is_singular() {
        let points = [0_u64, 1, 2].map(|count| counted(count, "point", "points"));
        assert_eq!(points, ["0 points", "1 point", "2 points"]);
    }
}
