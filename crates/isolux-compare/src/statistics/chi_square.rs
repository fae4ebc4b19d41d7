//! Chi-square distribution: goodness of fit.

use super::special::incomplete_gamma;

/// Probability that a sum of squares of `freedom` standard normal variables is at most `x`.
pub fn chi_square_cdf(x: f64, freedom: f64) -> f64 {
    incomplete_gamma(0.5 * freedom, 0.5 * x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_SIX_DIGITS;

    #[test]
    fn agrees_with_printed_tables() {
        for (x, freedom, p) in [
            (3.841_459, 1.0, 0.95),
            (18.307_038, 10.0, 0.95),
            (2.558_212, 10.0, 0.01),
            (124.342_113, 100.0, 0.95),
        ] {
            let found = chi_square_cdf(x, freedom);
            assert!((found - p).abs() < PRINTED_SIX_DIGITS, "{freedom}: {found}");
        }
    }

    #[test]
    fn of_two_degrees_is_exponential() {
        for x in [0.1, 1.0, 3.0, 10.0, 50.0] {
            let expected = -libm::expm1(-0.5 * x);
            assert!((chi_square_cdf(x, 2.0) - expected).abs() < crate::tolerance::ROUNDING);
        }
    }
}
