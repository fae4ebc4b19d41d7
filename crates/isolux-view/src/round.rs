//! Round numbers.

/// The least of 1, 2 or 5 times a power of ten that is no less than this; 1 for what is nothing.
pub(crate) fn round_step(least: f64) -> f64 {
    if !(least > 1e-9 && least.is_finite()) {
        return 1.0;
    }
    let decade = libm::pow(10.0, libm::floor(libm::log10(least)));
    let steps = [1.0, 2.0, 5.0, 10.0].map(|s| s * decade);
    let step = steps.into_iter().find(|s| *s >= least).unwrap_or(steps[3]);
    // Powers of ten below 1 are not exact: nine digits are.
    format!("{step:.9}").parse().unwrap_or(step)
}
