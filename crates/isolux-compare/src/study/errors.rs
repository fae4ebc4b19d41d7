//! Where a map errs: relative errors in rows and columns, to be shown as pictures.

use crate::case::cube;
use crate::measure::{Readings, places};

/// Relative errors, signed, row by row from the top; `None` where nothing is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Errors {
    /// Number of columns.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// One a cell.
    pub shares: Vec<Option<f64>>,
}

impl Errors {
    /// Of readings over a face of CUBE, the middle of the face in the middle, or over the octant of SPHERE, azimuth to the right and height upwards in
    /// steps of equal area; `None` of other cases.
    pub fn of(case: &str, readings: &Readings) -> Option<Self> {
        let places = places(case)?;
        let count = readings.grid.len();
        let side = (count as f64).sqrt().round() as u32;
        let mut order: Vec<usize> = (0..count).collect();
        if case == "cube" {
            let cell = |x: f64| (x / cube::HALF_EDGE_M * f64::from(side)).round() as i64;
            order.sort_by_key(|&k| {
                let at = places[k].0.position;
                (-cell(at.y), cell(at.x))
            });
        } else {
            // The grid has its lowest row first, each from azimuth 0 on.
            let side = side as usize;
            order.sort_by_key(|k| (usize::MAX - k / side, k % side));
        }
        let share = |k: usize| {
            let place = &readings.grid[k];
            Some(place.measured_lx / place.expected_lx - 1.0)
        };
        Some(Self { width: side, height: side, shares: order.into_iter().map(share).collect() })
    }
}

/// Steps of limits within a power of ten.
const STEPS: [f64; 3] = [1.0, 2.0, 5.0];

/// The error that pictures of several maps should show in full colour: the least round one that nineteen in twenty places of the middlemost map do not
/// exceed. The best map is seen to be pale, the worst to be full of colour.
pub fn limit(all: &[Errors]) -> Option<f64> {
    let mut typical: Vec<f64> = all.iter().filter_map(Errors::greatest_but_few).collect();
    typical.sort_by(f64::total_cmp);
    let middle = *typical.get(typical.len() / 2).filter(|middle| **middle > 0.0)?;
    let power = libm::exp10(libm::floor(libm::log10(middle)));
    let step = STEPS.into_iter().find(|step| step * power >= middle);
    Some(step.map_or(10.0 * power, |step| step * power))
}

impl Errors {
    /// What nineteen in twenty do not exceed.
    fn greatest_but_few(&self) -> Option<f64> {
        let mut sizes: Vec<f64> =
            self.shares.iter().filter_map(|share| Some(share.as_ref()?.abs())).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get(sizes.len() * 19 / 20).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_of(share: f64) -> Errors {
        Errors { width: 2, height: 1, shares: vec![Some(share), Some(-share)] }
    }

    #[test]
    fn limits_are_round_and_hold_the_middlemost_map() {
        let all = [0.5, 0.013, 0.001].map(all_of);
        assert_eq!(limit(&all), Some(0.02));
        assert_eq!(limit(&[all_of(0.07)]), Some(0.1));
        assert_eq!(limit(&[all_of(0.0)]), None);
        assert_eq!(limit(&[]), None);
    }
}
