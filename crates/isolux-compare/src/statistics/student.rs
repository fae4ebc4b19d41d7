//! Student's distribution: means of few replicates.

use super::special::incomplete_beta;

/// Probability that a variable with `freedom` degrees of freedom is at most `t`.
pub fn student_cdf(t: f64, freedom: f64) -> f64 {
    let tail = 0.5 * incomplete_beta(freedom / (freedom + t * t), 0.5 * freedom, 0.5);
    if t > 0.0 { 1.0 - tail } else { tail }
}

/// Probability that it is farther than `t` from zero.
pub fn student_two_sided(t: f64, freedom: f64) -> f64 {
    incomplete_beta(freedom / (freedom + t * t), 0.5 * freedom, 0.5)
}

/// The value not exceeded with a probability in (0, 1).
pub fn student_quantile(probability: f64, freedom: f64) -> f64 {
    super::invert(probability, -1e12, 1e12, |t| student_cdf(t, freedom))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::PRINTED_SIX_DIGITS;

    #[test]
    fn agrees_with_printed_tables() {
        for (p, freedom, t) in [
            (0.975, 1.0, 12.706_205),
            (0.975, 5.0, 2.570_582),
            (0.995, 30.0, 2.749_996),
            (0.05, 10.0, -1.812_461),
        ] {
            let found = student_quantile(p, freedom);
            assert!((found - t).abs() < PRINTED_SIX_DIGITS * t.abs(), "{freedom}: {found}");
        }
    }

    #[test]
    fn is_normal_in_the_limit() {
        let t = student_quantile(0.975, 1e9);
        assert!((t - super::super::normal_quantile(0.975)).abs() < PRINTED_SIX_DIGITS);
    }
}
