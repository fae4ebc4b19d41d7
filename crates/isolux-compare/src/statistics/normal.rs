//! Normal distribution.

use std::f64::consts::SQRT_2;

/// Probability that a standard normal variable is at most `x`.
pub fn normal_cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x / SQRT_2)
}

/// The value not exceeded with a probability in (0, 1).
pub fn normal_quantile(probability: f64) -> f64 {
    // Beyond 38 the distribution function is zero or one in f64.
    super::invert(probability, -38.0, 38.0, normal_cdf)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_SIX_DIGITS;

    #[test]
    fn agrees_with_printed_tables() {
        for (p, x) in [(0.5, 0.0), (0.975, 1.959_964), (0.995, 2.575_829), (0.001, -3.090_232)] {
            assert!((normal_quantile(p) - x).abs() < PRINTED_SIX_DIGITS, "{p}");
            assert!((normal_cdf(x) - p).abs() < PRINTED_SIX_DIGITS, "{x}");
        }
    }
}
