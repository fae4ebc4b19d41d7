//! How many outliers chance allows.

use super::special::incomplete_beta;

/// Probability of more than `count` events in `trials` of the given probability.
pub fn binomial_tail(count: u64, trials: u64, probability: f64) -> f64 {
    if count >= trials {
        return 0.0;
    }
    incomplete_beta(probability, (count + 1) as f64, (trials - count) as f64)
}

/// The largest number of events in `trials` that is not surprising: more happen with a probability
/// below `significance`.
pub fn accepted_outliers(trials: u64, probability: f64, significance: f64) -> u64 {
    let (mut low, mut high) = (0, trials);
    while low < high {
        let middle = low + (high - low) / 2;
        if binomial_tail(middle, trials, probability) < significance {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// The interval of a probability after `count` events in `trials` (Clopper and Pearson 1934). Neither
/// needs to be whole, so that trials that hang together can be counted for fewer.
pub fn binomial_interval(count: f64, trials: f64, confidence: f64) -> [f64; 2] {
    let tail = 0.5 * (1.0 - confidence);
    let quantile =
        |level: f64, a: f64, b: f64| super::invert(level, 0.0, 1.0, |p| incomplete_beta(p, a, b));
    let missing = trials - count;
    let low = if count > 0.0 { quantile(tail, count, missing + 1.0) } else { 0.0 };
    let high = if missing > 0.0 { quantile(1.0 - tail, count + 1.0, missing) } else { 1.0 };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    /// The sum of the definition.
    fn tail_by_sum(count: u64, trials: u64, p: f64) -> f64 {
        let mut term = libm::pow(1.0 - p, trials as f64);
        let mut below = term;
        for k in 1..=count {
            term *= (trials - k + 1) as f64 / k as f64 * p / (1.0 - p);
            below += term;
        }
        1.0 - below
    }

    #[test]
    fn tail_is_the_sum() {
        for (count, trials, p) in [(0, 1, 0.3), (2, 10, 0.05), (7, 100, 0.05), (40, 60, 0.5)] {
            let expected = tail_by_sum(count, trials, p);
            assert!((binomial_tail(count, trials, p) - expected).abs() < 100.0 * ROUNDING);
        }
    }

    #[test]
    fn accepts_what_is_not_surprising() {
        for (trials, p) in [(1, 0.05), (20, 0.05), (1000, 0.0027), (5000, 0.5)] {
            let accepted = accepted_outliers(trials, p, 1e-3);
            assert!(binomial_tail(accepted, trials, p) < 1e-3);
            assert!(accepted == 0 || binomial_tail(accepted - 1, trials, p) >= 1e-3);
        }
        assert_eq!(accepted_outliers(0, 0.5, 1e-3), 0);
        assert_eq!(accepted_outliers(100, 0.0, 1e-3), 0);
    }

    #[test]
    fn intervals_end_where_what_was_seen_becomes_unlikely() {
        let [low, high] = binomial_interval(190.0, 200.0, 0.95);
        assert!((binomial_tail(189, 200, low) - 0.025).abs() < 1e-9, "{low}");
        assert!((1.0 - binomial_tail(190, 200, high) - 0.025).abs() < 1e-9, "{high}");
        // The rule of three, for a tail of 2.5 %: 3.69 of so many.
        let [low, high] = binomial_interval(200.0, 200.0, 0.95);
        assert!((low - 0.025_f64.powf(1.0 / 200.0)).abs() < 1e-9 && high == 1.0);
        assert_eq!(binomial_interval(0.0, 200.0, 0.95)[0], 0.0);
    }
}
