//! Errors over time, few enough for a curve.

/// So many points are kept at most.
const MAX_POINTS: usize = 400;
/// Earlier times count as this one on the logarithmic axis, in seconds.
const EARLIEST_S: f64 = 0.01;

/// An error told at a time of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time since the run began, in seconds.
    pub elapsed_s: f64,
    /// The relative error at that time.
    pub error: f64,
}

/// Errors over time: the first, the last, and those between as evenly as can be on a logarithmic
/// axis of time.
#[derive(Debug, Default)]
pub(super) struct History(Vec<Point>);

impl History {
    /// Adds an error later than all before it, and drops one if there are too many.
    pub(super) fn add(&mut self, point: Point) {
        let is_later = self.0.last().is_none_or(|last| last.elapsed_s < point.elapsed_s);
        if !(is_later && point.elapsed_s.is_finite() && point.error.is_finite()) {
            return;
        }
        self.0.push(point);
        if self.0.len() > MAX_POINTS {
            self.0.remove(self.least_missed());
        }
    }

    /// The point between others that leaves the smallest gap.
    fn least_missed(&self) -> usize {
        let place = |k: usize| self.0[k].elapsed_s.max(EARLIEST_S);
        let gap = |k: &usize| place(k + 1) / place(k - 1);
        (1..self.0.len() - 1).min_by(|a, b| gap(a).total_cmp(&gap(b))).unwrap_or(0)
    }

    /// As pairs of time and error.
    pub(super) fn json(&self) -> String {
        let pairs: Vec<[f64; 2]> = self.0.iter().map(|p| [p.elapsed_s, p.error]).collect();
        serde_json::to_string(&pairs).expect("pairs of numbers can be written")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(times: impl Iterator<Item = f64>) -> History {
        let mut history = History::default();
        times.for_each(|elapsed_s| history.add(Point { elapsed_s, error: 1.0 / elapsed_s }));
        history
    }

    #[test]
    fn few_points_are_all_kept() {
        assert_eq!(history((1..=400).map(f64::from)).0.len(), 400);
    }

    #[test]
    fn ends_are_kept() {
        let points = history((1..=5000).map(f64::from)).0;
        assert_eq!(points.len(), MAX_POINTS);
        assert_eq!((points[0].elapsed_s, points[MAX_POINTS - 1].elapsed_s), (1.0, 5000.0));
    }

    /// Four decades in steps of a quarter of a second: where steps are finer than a 400th part of
    /// the axis, no gap is wider than three such parts.
    #[test]
    fn points_are_even_on_the_logarithmic_axis() {
        let points = history((1..=40_000).map(|k| 0.25 * f64::from(k))).0;
        let part = 40_000_f64.ln() / MAX_POINTS as f64;
        for pair in points.windows(2).filter(|p| 0.25 / p[0].elapsed_s < part) {
            let gap = (pair[1].elapsed_s / pair[0].elapsed_s).ln();
            assert!(gap < 3.0 * part, "{pair:?}: {gap} of {part}");
        }
    }

    #[test]
    fn disorder_and_what_is_no_number_are_left_out() {
        let mut history = history([1.0, 2.0].into_iter());
        for (elapsed_s, error) in [(1.5, 0.1), (2.0, 0.1), (f64::NAN, 0.1), (3.0, f64::INFINITY)] {
            history.add(Point { elapsed_s, error });
        }
        assert_eq!(history.json(), "[[1.0,1.0],[2.0,0.5]]");
    }

    #[test]
    fn early_times_are_no_division_by_zero() {
        let times = (0..1000).map(|k| f64::from(k) * 1e-6);
        assert_eq!(history(times).0.len(), MAX_POINTS);
    }
}
