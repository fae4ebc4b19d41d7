//! How errors fall with time.

use super::record::Point;
use serde::Serialize;

/// A line through errors over times in logarithms of both, by least squares: `error = at_1_s * time^-order`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Convergence {
    /// The error at one second, on the line.
    pub at_1_s: f64,
    /// How fast it falls: one half is the law of independent samples.
    pub order: f64,
}

impl Convergence {
    /// Of points `(time_s, error)`; `None` of fewer than two different times, or where an error is zero.
    pub fn of(points: &[(f64, f64)]) -> Option<Self> {
        let logs: Vec<(f64, f64)> =
            points.iter().map(|&(t, e)| (libm::log(t), libm::log(e))).collect();
        if logs.iter().any(|(t, e)| !t.is_finite() || !e.is_finite()) {
            return None;
        }
        let n = logs.len() as f64;
        let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
        let (mean_t, mean_e) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = logs.iter().map(|(t, _)| (t - mean_t).powi(2)).sum();
        let product: f64 = logs.iter().map(|(t, e)| (t - mean_t) * (e - mean_e)).sum();
        let slope = product / spread;
        (spread > 0.0).then(|| Self { at_1_s: libm::exp(mean_e - slope * mean_t), order: -slope })
    }
}

/// From when on a system errs by no more than an error, s: a run that is right by chance, and wrong again later, does not count. On lines between points
/// in logarithms of both; `None` where the longest run errs by more. Where none does, the time of the shortest.
pub fn time_to_error_s(
    points: &[Point],
    error_of: impl Fn(&Point) -> Option<f64>,
    error: f64,
) -> Option<f64> {
    let mut known: Vec<(f64, f64)> =
        points.iter().filter_map(|point| Some((point.time_s, error_of(point)?))).collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(last_above) = known.iter().rposition(|&(_, e)| e > error) else {
        return Some(known.first()?.0);
    };
    let (before_s, before) = known[last_above];
    let &(after_s, after) = known.get(last_above + 1)?;
    let log = |x: f64| libm::log(x.max(f64::MIN_POSITIVE));
    let share = (log(before) - log(error)) / (log(before) - log(after));
    Some(libm::exp(log(before_s) + share * (log(after_s) - log(before_s))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found() {
        let law = |t: f64| (t, 0.03 * t.powf(-0.5));
        let found = Convergence::of(&[law(1.0), law(2.0), law(4.0), law(16.0)]).unwrap();
        // Sums of four logarithms and their exponential.
        assert!((found.at_1_s / 0.03 - 1.0).abs() < 1e-14 && (found.order - 0.5).abs() < 1e-14);
        assert_eq!(Convergence::of(&[(1.0, 0.1)]), None);
        assert_eq!(Convergence::of(&[(1.0, 0.1), (1.0, 0.2)]), None);
        assert_eq!(Convergence::of(&[(1.0, 0.1), (2.0, 0.0)]), None);
    }

    #[test]
    fn what_is_right_by_chance_does_not_count() {
        let points = [(1.0, 0.01), (2.0, 0.04), (8.0, 0.01), (16.0, 0.02)]
            .map(|(time_s, error)| (Point { time_s, ..Point::default() }, error));
        let only: Vec<Point> = points.iter().map(|(point, _)| point.clone()).collect();
        let error_of = |point: &Point| {
            points.iter().find(|(of, _)| of.time_s == point.time_s).map(|(_, error)| *error)
        };
        let found = |error| time_to_error_s(&only, error_of, error);
        // Half way between two and eight in logarithms.
        assert!((found(0.02).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(found(0.05), Some(1.0));
        assert_eq!(found(0.015), None);
    }
}
