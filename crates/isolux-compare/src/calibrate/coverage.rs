//! How often intervals hold the truth, and how well that is known.

use super::observe::Interval;
use crate::statistics::binomial_interval;
use serde::Serialize;

/// One, two and three standard deviations of a normal error.
pub const CONFIDENCES: [f64; 3] = [0.68, 0.95, 0.997];

/// Intervals of 95 % are calibrated if they hold the truth in so many cases.
const CALIBRATED: [f64; 2] = [0.93, 0.97];

/// Level of the interval of the coverage itself.
const CERTAINTY: f64 = 0.95;

/// Share of intervals that hold the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Coverage {
    /// What they promise.
    pub confidence: f64,
    /// Intervals counted.
    pub readings: u64,
    /// Independent intervals that would know the share as well: readings of one map err together.
    pub effective: f64,
    /// What they hold.
    pub share: f64,
    /// Interval of 95 % of the share: binomial (Clopper and Pearson 1934).
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// What a coverage says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Judgement {
    /// As promised, as far as can be told: from 93 to 97 % of 95 %.
    Calibrated,
    /// Errors are larger than said.
    Short,
    /// Errors are smaller than said.
    Wide,
}

impl Coverage {
    /// Of readings, grouped by seed; `None` of none.
    pub fn of<'a>(
        confidence: f64,
        seeds: impl Iterator<Item = &'a [Option<Interval>]>,
        holds: impl Fn(&Interval, f64) -> bool,
    ) -> Option<Self> {
        let counts: Vec<[u64; 2]> = seeds
            .map(|readings| {
                let held = readings.iter().flatten().filter(|r| holds(r, confidence)).count();
                [held as u64, readings.iter().flatten().count() as u64]
            })
            .filter(|[_, all]| *all > 0)
            .collect();
        Self::of_counts(confidence, &counts)
    }

    /// Of held and all readings of every seed.
    pub(super) fn of_counts(confidence: f64, counts: &[[u64; 2]]) -> Option<Self> {
        let readings: u64 = counts.iter().map(|[_, all]| all).sum();
        let held: u64 = counts.iter().map(|[held, _]| held).sum();
        if readings == 0 {
            return None;
        }
        let share = held as f64 / readings as f64;
        let effective = effective_trials(counts, share, readings);
        let [low, high] = binomial_interval(share * effective, effective, CERTAINTY);
        Some(Self { confidence, readings, effective, share, low, high })
    }

    /// Whether intervals of 95 % are calibrated; certain enough to be held against them.
    pub fn judge(&self) -> Judgement {
        let [least, most] = CALIBRATED;
        match () {
            () if self.high < least => Judgement::Short,
            () if self.low > most => Judgement::Wide,
            () => Judgement::Calibrated,
        }
    }
}

/// Trials of a binomial distribution with the variance that the shares of the seeds show.
fn effective_trials(counts: &[[u64; 2]], share: f64, readings: u64) -> f64 {
    let seeds = counts.len() as f64;
    let mean = readings as f64 / seeds;
    let deviation = |[held, all]: &[u64; 2]| (*held as f64 - share * *all as f64) / mean;
    let squares: f64 = counts.iter().map(|count| deviation(count) * deviation(count)).sum();
    let variance = squares / (seeds * (seeds - 1.0));
    let least = seeds.min(readings as f64);
    if variance > 0.0 {
        (share * (1.0 - share) / variance).clamp(least, readings as f64)
    } else {
        // All seeds alike tells nothing about how readings hang together.
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::normal_quantile;

    /// Errors of standard deviation one, by quantiles in a scrambled order, as a run would say them
    /// that takes the deviation for `said`.
    fn seeds(said: f64, count: usize) -> Vec<Vec<Option<Interval>>> {
        let readings = count * 5;
        let reading = |k: usize| {
            let level = ((k * 7919) % readings) as f64 + 0.5;
            Some(Interval {
                error_lx: normal_quantile(level / readings as f64),
                standard_error_lx: said,
                degrees_of_freedom: 1e6,
                rest_lx: 0.0,
                bound_lx: 0.0,
            })
        };
        (0..count).map(|seed| (0..5).map(|k| reading(5 * seed + k)).collect()).collect()
    }

    fn coverage(said: f64, confidence: f64) -> Coverage {
        let seeds = seeds(said, 200);
        let readings = seeds.iter().map(Vec::as_slice);
        Coverage::of(confidence, readings, Interval::holds).expect("there are readings")
    }

    #[test]
    fn an_honest_estimator_is_calibrated_at_every_level() {
        for confidence in CONFIDENCES {
            let found = coverage(1.0, confidence);
            // A thousand quantiles in pairs: the count is right to one pair.
            assert!((found.share - confidence).abs() < 2e-3, "{found:?}");
            assert!(found.low < confidence && confidence < found.high, "{found:?}");
        }
        assert_eq!(coverage(1.0, 0.95).judge(), Judgement::Calibrated);
    }

    #[test]
    fn an_overconfident_estimator_is_found_out_and_so_is_a_timid_one() {
        // 1.96 * 0.8 deviations hold 88 %, 1.96 * 1.3 hold 98.9 %.
        assert_eq!(coverage(0.8, 0.95).judge(), Judgement::Short);
        assert_eq!(coverage(1.3, 0.95).judge(), Judgement::Wide);
    }

    #[test]
    fn readings_that_err_together_count_once() {
        let counts: Vec<[u64; 2]> = (0..40).map(|k| [if k < 36 { 50 } else { 0 }, 50]).collect();
        let together = Coverage::of_counts(0.95, &counts).unwrap();
        assert!(together.effective < 41.0, "{together:?}");
        // 36 of 40 might well be 95 %; 1800 of 2000 could not.
        assert_eq!(together.judge(), Judgement::Calibrated);
        let counts: Vec<[u64; 2]> = (0..40).map(|k| [44 + k % 3, 50]).collect();
        assert_eq!(Coverage::of_counts(0.95, &counts).unwrap().judge(), Judgement::Short);
    }

    #[test]
    fn nothing_has_no_coverage_and_one_seed_says_little() {
        assert_eq!(Coverage::of_counts(0.95, &[]), None);
        let one = Coverage::of_counts(0.95, &[[0, 5]]).unwrap();
        assert!(one.high > 0.95, "{one:?}");
    }
}
