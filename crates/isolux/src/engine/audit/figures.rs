//! The statistics of an audit.

use super::compared::Compared;
use crate::map::{Audit, AuditedError, AuditedReadings};

/// The largest number of audits of a run.
pub(crate) const MOST_AUDITS: u32 = 3;

/// The normal quantile for intervals of 95 %.
const TWO_SIDED: f64 = 1.96;
/// The normal quantile for a one-sided probability of 95 %.
const POWER: f64 = 1.645;
/// The normal quantile for one-sided bounds. The probability of a false alarm in a run
/// ([`Audit::FALSE_ALARMS`], one in a thousand) is divided among three bounds in each of three audits.
const ONE_SIDED: f64 = 3.692;
const _: () = assert!(MOST_AUDITS == 3 && Audit::FALSE_ALARMS == 1000.0);

/// The least number of places for a statement on a part of the surface.
pub(super) const FEWEST_OF_PART: usize = 8;

/// The share of the kept paths, the brightest, that the tail index is estimated from.
const OF_TAIL: f64 = 0.05;
/// The least number of paths for a tail index.
const FEWEST_IN_TAIL: usize = 25;

/// A mean over places, with its standard error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figures {
    pub(super) mean: f64,
    /// The standard error of the mean.
    pub(super) error: f64,
    /// The relative variance of the variance.
    pub(super) variance_of_variance: f64,
}

impl Figures {
    /// The figures of values at independent places. With fewer than two values the standard error is
    /// infinite.
    pub(super) fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        if values.len() < 2 {
            return Self { mean: 0.0, error: f64::INFINITY, variance_of_variance: 1.0 };
        }
        let mean = values.iter().sum::<f64>() / n;
        let power = |k: i32| values.iter().map(|v| (v - mean).powi(k)).sum::<f64>();
        let (squares, fourths) = (power(2), power(4));
        let variance_of_variance =
            if squares > 0.0 { fourths / (squares * squares) - 1.0 / n } else { 0.0 };
        Self { mean, error: (squares / (n * (n - 1.0))).sqrt(), variance_of_variance }
    }

    /// The root of a mean square, relative to an illuminance, with its 95 % interval.
    pub(super) fn relative(&self, reference_lx: f64) -> AuditedError {
        let root = |square: f64| share(square.max(0.0).sqrt(), reference_lx);
        AuditedError {
            value: root(self.mean),
            low: root(self.mean - TWO_SIDED * self.error),
            high: root(self.mean + TWO_SIDED * self.error),
        }
    }

    /// The one-sided lower bound on the mean, at least zero.
    pub(super) fn at_least(&self) -> f64 {
        (self.mean - ONE_SIDED * self.error).max(0.0)
    }

    /// The one-sided lower bound on the square of the mean.
    pub(super) fn square_at_least(&self) -> f64 {
        let least = (self.mean.abs() - ONE_SIDED * self.error).max(0.0);
        least * least
    }

    /// Whether the mean differs significantly from zero.
    pub(super) fn is_beyond_doubt(&self) -> bool {
        self.mean.abs() > ONE_SIDED * self.error
    }

    /// The error that would have contradicted the reported one with a probability of 95 %, relative, from
    /// figures of a mean square.
    pub(super) fn would_find(&self, told: f64, reference_lx: f64) -> f64 {
        let beyond = share(((ONE_SIDED + POWER) * self.error).sqrt(), reference_lx);
        libm::hypot(told, beyond)
    }

    /// The uniform error that would have contradicted the reported one with a probability of 95 %, relative,
    /// from figures of a mean.
    pub(super) fn would_find_alike(&self, told: f64, reference_lx: f64) -> f64 {
        told + share((ONE_SIDED + POWER) * self.error, reference_lx)
    }
}

/// The one-sided lower bound on the mean square over all places, from the squares of the means over parts.
/// For a mean d of n values with variance s2, the unbiased estimate of its square is d2 - s2/n. Its variance
/// for normal values is 4 d2 s2/n + 2 (s2/n)2.
pub(super) fn parts_at_least<'a>(parts: impl Iterator<Item = &'a [&'a Compared]>) -> f64 {
    let (mut count, mut sum, mut variance) = (0.0, 0.0, 0.0);
    for part in parts {
        let n = part.len() as f64;
        count += n;
        if part.len() < FEWEST_OF_PART {
            continue;
        }
        let values: Vec<f64> = part.iter().map(|c| c.apart_lx()).collect();
        let Figures { mean, error, .. } = Figures::of(&values);
        let noise = error * error;
        let square = mean * mean - noise;
        sum += n * square;
        variance += n * n * (4.0 * square.max(0.0) * noise + 2.0 * noise * noise);
    }
    if count == 0.0 { 0.0 } else { ((sum - ONE_SIDED * variance.sqrt()) / count).max(0.0) }
}

/// An error relative to an illuminance: zero if it is zero, even without light.
pub(super) fn share(lx: f64, reference_lx: f64) -> f64 {
    if lx == 0.0 { 0.0 } else { lx / reference_lx }
}

/// The true errors of readings beside the reported ones.
pub(super) fn readings<'a>(some: impl Iterator<Item = &'a Compared>) -> AuditedReadings {
    let all: Vec<&Compared> = some.filter(|c| c.standard_error_lx.is_finite()).collect();
    let count = all.len() as f64;
    let outside = all.iter().filter(|c| c.is_outside()).count() as f64 / count.max(1.0);
    let told: f64 = all.iter().map(|c| c.standard_error_lx * c.standard_error_lx).sum();
    let found: f64 = all.iter().map(|c| c.squared_lx2).sum();
    let ratio = (told > 0.0).then(|| (found.max(0.0) / told).sqrt());
    AuditedReadings {
        places: all.len() as u64,
        true_over_told: ratio,
        at_least: ratio_at_least(&all, told),
        outside,
    }
}

/// The one-sided lower bound on the ratio of true to reported errors, from the linearized variance of a ratio
/// of two means.
fn ratio_at_least(all: &[&Compared], told: f64) -> f64 {
    if told <= 0.0 {
        return 0.0;
    }
    let found: f64 = all.iter().map(|c| c.squared_lx2).sum();
    let ratio = found / told;
    let beyond = |c: &&Compared| c.squared_lx2 - ratio * c.standard_error_lx * c.standard_error_lx;
    let values: Vec<f64> = all.iter().map(beyond).collect();
    let mean_told = told / all.len() as f64;
    let Figures { error, .. } = Figures::of(&values);
    (ratio - ONE_SIDED * error / mean_told).max(0.0).sqrt()
}

/// The index of the power law of the largest values, by the estimator of Hill (1975); `None` if they are few.
pub(super) fn tail_index(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.filter(|v| *v > 0.0).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    let count = (OF_TAIL * values.len() as f64) as usize;
    let least = *values.get(count).filter(|_| count >= FEWEST_IN_TAIL)?;
    let logs: f64 = values[..count].iter().map(|v| libm::log(v / least)).sum();
    (logs > 0.0).then(|| count as f64 / logs)
}

/// The exponent with which noise falls with the number of increments, by least squares of logarithms; `None`
/// for fewer than three figures.
pub(crate) fn trend(noise: &[(u64, f64)]) -> Option<f64> {
    let points: Vec<(f64, f64)> = noise
        .iter()
        .filter(|(_, noise)| *noise > 0.0)
        .map(|&(count, noise)| (libm::log(count as f64), libm::log(noise)))
        .collect();
    if points.len() < 3 {
        return None;
    }
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let product: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let square: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    Some(product / square)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Key;

    #[test]
    fn tails_of_power_laws_tell_their_index() {
        for index in [1.5, 3.0] {
            let value = |k: u64| libm::pow(Key::new(3).with(k).uniform(), -1.0 / index);
            let found = tail_index((0..20_000).map(value)).unwrap();
            // Hill's estimator has the relative standard error 1 / sqrt(k). The tolerance is five of them at
            // k = 1000.
            assert!((found / index - 1.0).abs() < 5.0 / 1000_f64.sqrt(), "{index}: {found}");
        }
    }

    #[test]
    fn bounds_of_true_claims_are_passed_as_seldom_as_they_say() {
        // Each trial has 64 places with correctly reported squared errors; one in 9000 passes the bound.
        let passes = |trial: &u64| {
            let square = |k: u64| {
                let normal = |j: u64| {
                    let key = Key::new(5).with(*trial).with(k).with(j);
                    let radius = (-2.0 * libm::log(1.0 - key.with(0).uniform())).sqrt();
                    radius * libm::cos(std::f64::consts::TAU * key.with(1).uniform())
                };
                let (difference, noise) = (normal(0) + normal(1), 1.0);
                difference * difference - noise
            };
            let values: Vec<f64> = (0..64).map(square).collect();
            Figures::of(&values).at_least() > 1.0
        };
        let false_alarms = (0..20_000).filter(passes).count();
        // The mean of squares is skewed to the right and passes its bound less often than a normal one. At
        // most 2.2 are expected; 10 or more occur once in 10,000 times (Poisson).
        assert!(false_alarms < 10, "{false_alarms}");
    }
}
