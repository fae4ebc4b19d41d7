//! The error of the scene: as reported, over as made.

use super::observe::Observation;
use isolux::map::Audit;
use serde::Serialize;

/// True error over reported error of the scene, over seeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SceneFigure {
    /// Runs counted.
    pub runs: u64,
    /// Root mean square over the runs of what is reported.
    pub reported: f64,
    /// The same of the true errors at the places.
    pub measured: f64,
    /// Median of the ratio of true to reported.
    pub median_ratio: f64,
    /// Ratio that nine in ten runs do not exceed.
    pub ninth_decile_ratio: f64,
    /// Share of runs in which the error is at most what is reported.
    pub covered: f64,
    /// Mean signed error over runs and places, relative.
    pub mean_error: f64,
    /// Root mean square over the runs of what audits find; `None` where there are none, as at stages on the way.
    pub audited: Option<f64>,
    /// Share of the runs whose audit contradicts what is reported.
    pub contradicted: Option<f64>,
}

impl SceneFigure {
    /// Over runs; `None` where all is exact and nothing is reported.
    pub fn of<'a>(runs: impl Iterator<Item = &'a Observation>) -> Option<Self> {
        let runs: Vec<&Observation> = runs.filter(|o| o.accuracy.reached > 0.0).collect();
        let n = runs.len() as f64;
        let mut ratios: Vec<f64> =
            runs.iter().map(|o| o.true_error() / o.accuracy.reached).collect();
        ratios.sort_by(f64::total_cmp);
        let rms = |value: &dyn Fn(&Observation) -> f64| {
            (runs.iter().map(|o| value(o) * value(o)).sum::<f64>() / n).sqrt()
        };
        let audits: Vec<&Audit> = runs.iter().filter_map(|o| o.audit.as_ref()).collect();
        let of_audits = |value: &dyn Fn(&Audit) -> f64| {
            let sum = audits.iter().map(|audit| value(audit)).sum::<f64>();
            (!audits.is_empty()).then(|| sum / audits.len() as f64)
        };
        Some(Self {
            audited: of_audits(&|a| a.error.value * a.error.value).map(f64::sqrt),
            contradicted: of_audits(&|a| f64::from(u8::from(a.contradicts))),
            runs: runs.len() as u64,
            reported: rms(&|o| o.accuracy.reached),
            measured: rms(&|o| o.true_error()),
            median_ratio: quantile(&ratios, 0.5)?,
            ninth_decile_ratio: quantile(&ratios, 0.9)?,
            covered: ratios.iter().filter(|r| **r <= 1.0).count() as f64 / n,
            mean_error: runs.iter().map(|o| mean_error(o)).sum::<f64>() / n,
        })
    }
}

fn mean_error(observation: &Observation) -> f64 {
    let known = || observation.readings.iter().flatten();
    let sum: f64 = known().map(|r| r.error_lx).sum();
    sum / known().count().max(1) as f64 / observation.rms_lx
}

/// Of sorted values: the nearest; `None` of none.
pub(super) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    sorted.get((share * last as f64).round() as usize).copied()
}

/// Fewest, median and most of sorted values.
pub(super) fn spread(sorted: &[f64]) -> Option<[f64; 3]> {
    Some([quantile(sorted, 0.0)?, quantile(sorted, 0.5)?, quantile(sorted, 1.0)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::Interval;
    use isolux::map::Accuracy;

    fn observation(error_lx: f64, reached: f64) -> Observation {
        let reading = Interval {
            error_lx,
            standard_error_lx: 1.0,
            degrees_of_freedom: 15.0,
            rest_lx: 0.0,
            bound_lx: 0.0,
        };
        let accuracy = Accuracy {
            reached,
            statistical: reached,
            discretization: 0.0,
            caustics: 0.0,
            bias: 0.0,
            interpolated: reached,
        };
        Observation {
            increments: 16,
            accuracy,
            readings: vec![Some(reading); 3],
            rms_lx: 100.0,
            audit: None,
        }
    }

    #[test]
    fn a_report_of_a_third_of_the_error_is_seen() {
        let runs: Vec<Observation> =
            [-2.0, -3.0, -4.0].map(|error_lx| observation(error_lx, 0.01)).to_vec();
        let figure = SceneFigure::of(runs.iter()).unwrap();
        assert!((figure.median_ratio - 3.0).abs() < 1e-12, "{figure:?}");
        assert!((figure.mean_error + 0.03).abs() < 1e-12, "{figure:?}");
        assert_eq!((figure.covered, figure.runs), (0.0, 3));
    }

    #[test]
    fn what_is_exact_has_no_ratio() {
        assert_eq!(SceneFigure::of([observation(0.0, 0.0)].iter()), None);
    }
}
