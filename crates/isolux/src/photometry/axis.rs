//! A list of increasing angles, and the cell in which an angle lies.

/// Increasing angles, at least two, with the scale that finds a cell of an even axis at once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    angles: Vec<f64>,
    cells_per_unit: f64,
}

impl Axis {
    /// From increasing angles, at least two.
    pub(super) fn new(angles: Vec<f64>) -> Self {
        let span = angles.last().copied().unwrap_or(0.0) - angles.first().copied().unwrap_or(0.0);
        let cells_per_unit = angles.len().saturating_sub(1) as f64 / span;
        Self { angles, cells_per_unit }
    }

    /// The angles.
    pub(super) fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Number of intervals.
    pub(super) fn cells(&self) -> usize {
        self.angles.len() - 1
    }

    /// Lower and upper bound of an interval.
    pub(super) fn bounds(&self, cell: usize) -> [f64; 2] {
        [self.angles[cell], self.angles[cell + 1]]
    }

    /// Smallest angle.
    pub(super) fn first(&self) -> f64 {
        self.angles[0]
    }

    /// The interval that holds an angle and how far into it the angle lies, 0 to 1; `None` outside
    /// the axis.
    pub(super) fn locate(&self, angle: f64) -> Option<(usize, f64)> {
        if !(angle >= self.angles[0] && angle <= self.angles[self.cells()]) {
            return None;
        }
        let cell = self.cell(angle);
        let [low, high] = self.bounds(cell);
        Some((cell, (angle - low) / (high - low)))
    }

    fn cell(&self, angle: f64) -> usize {
        let last = self.cells() - 1;
        let guess = (((angle - self.angles[0]) * self.cells_per_unit) as usize).min(last);
        let [low, high] = self.bounds(guess);
        if low <= angle && angle <= high {
            return guess;
        }
        self.angles.partition_point(|&a| a <= angle).saturating_sub(1).min(last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_angle_finds_its_cell_on_even_and_uneven_axes() {
        for angles in [vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.1, 50.0, 50.5, 90.0], vec![-3.0, 7.0]]
        {
            let axis = Axis::new(angles.clone());
            let (first, last) = (angles[0], angles[angles.len() - 1]);
            for k in 0..=1000 {
                let angle = first + (last - first) * f64::from(k) / 1000.0;
                let (cell, weight) = axis.locate(angle).unwrap();
                let [low, high] = axis.bounds(cell);
                assert!(low <= angle && angle <= high, "{angle} in {low}..{high}");
                // One rounding each of a difference, a quotient, a product and a sum.
                let back = low + (high - low) * weight;
                assert!((back - angle).abs() <= 4.0 * f64::EPSILON * high.abs().max(1.0));
            }
        }
    }

    #[test]
    fn outside_and_not_a_number_are_nowhere() {
        let axis = Axis::new(vec![10.0, 20.0]);
        for angle in [9.999, 20.001, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(axis.locate(angle), None);
        }
    }
}
