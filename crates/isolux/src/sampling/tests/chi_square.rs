//! Pearson's chi-square: counts in bins against the shares they should have.

/// The value that chi-square with so many degrees of freedom exceeds once in a million trials
/// (Wilson, Hilferty 1931); the normal distribution exceeds 4.753 as rarely.
pub(super) fn one_in_a_million(freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    freedom * (1.0 - spread + 4.753 * spread.sqrt()).powi(3)
}

/// Chi-square over its limit; above one the counts are not of these shares. Bins that expect fewer
/// than ten are joined into one, so that the approximation holds.
pub(super) fn misfit(shares: &[f64], counts: &[usize]) -> f64 {
    let total: usize = counts.iter().sum();
    let mut rare = (0.0, 0.0);
    let (mut chi2, mut bins) = (0.0, 0.0);
    for (&share, &count) in shares.iter().zip(counts) {
        let (mean, count) = (share * total as f64, count as f64);
        if mean < 10.0 {
            rare = (rare.0 + mean, rare.1 + count);
        } else {
            chi2 += (count - mean) * (count - mean) / mean;
            bins += 1.0;
        }
    }
    if rare.0 >= 10.0 {
        chi2 += (rare.1 - rare.0) * (rare.1 - rare.0) / rare.0;
        bins += 1.0;
    } else {
        // Of a mean of ten, Poisson gives more than 30 once in ten million trials.
        assert!(rare.1 <= 30.0, "{} samples where {} are expected", rare.1, rare.0);
    }
    assert!(bins > 8.0, "the bins see nothing");
    chi2 / one_in_a_million(bins - 1.0)
}
