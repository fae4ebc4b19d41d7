//! Which lines of equal value are drawn, and the colours between them.

use super::field::Scale;
use crate::drawing::Ink;
use crate::false_colour::ColourMap;
use crate::round::round_step;

/// Lines at most, in even steps.
const MOST_LINES: f64 = 9.0;
/// A level in the middle that the greatest value is so many times as high as calls for uneven steps.
const UNEVEN: f64 = 8.0;
/// Lines at most in uneven steps: three in each of so many decades.
const MOST_UNEVEN: usize = 10;
/// Lines closer than so many standard errors would show noise.
const STEP_IN_ERRORS: f64 = 2.0;
/// How much of the paper shows through: black letters are read on all colours.
const PALENESS: f64 = 0.5;

/// Values at which lines are drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Levels {
    /// The values, rising.
    pub(super) lux: Vec<f64>,
    /// Whether they rise by ratios and not by even steps.
    by_ratios: bool,
}

impl Levels {
    /// Of values with this standard error.
    pub(super) fn of(values: &[f64], standard_error: f64) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (Some(&least), Some(&most)) = (sorted.first(), sorted.last()) else {
            return Self::default();
        };
        let middle = sorted[sorted.len() / 2];
        let inside = |level: &f64| *level > least && *level < most;
        if middle > 0.0 && most > UNEVEN * middle {
            let decade = |exponent: i32| libm::exp10(f64::from(exponent));
            let top = libm::log10(most).floor() as i32;
            let levels = (top - 5..=top).flat_map(|e| [1.0, 2.0, 5.0].map(|m| m * decade(e)));
            let mut levels: Vec<f64> = levels.filter(inside).collect();
            levels.drain(..levels.len().saturating_sub(MOST_UNEVEN));
            return Self { lux: levels, by_ratios: true };
        }
        let by_noise =
            if standard_error.is_finite() { STEP_IN_ERRORS * standard_error } else { 0.0 };
        let step = round_step(((most - least) / MOST_LINES).max(by_noise));
        let (first, last) = ((least / step).floor() as i64, (most / step).ceil() as i64);
        let lux = (first..=last).map(|k| k as f64 * step).filter(inside).collect();
        Self { lux, by_ratios: false }
    }

    /// What is interpolated between values: lines by ratios follow logarithms, of what is not far below the lowest of them.
    pub(super) fn scale(&self) -> Scale {
        match self.lux.first() {
            Some(lowest) if self.by_ratios => Scale::Ratios { least: 0.5 * lowest },
            _ => Scale::Even,
        }
    }

    /// Index of the band between two lines that a value lies in.
    pub(super) fn band(&self, value: f64) -> usize {
        self.lux.partition_point(|level| *level <= value)
    }

    /// Colours of the bands from the lowest.
    pub(super) fn inks(&self) -> Vec<Ink> {
        let (table, bands) = (ColourMap::Viridis.table(), self.lux.len() + 1);
        let ink = |band: usize| {
            let share = (band as f64 + 0.5) / bands as f64;
            table[(share * table.len() as f64) as usize]
                .map(|code| (f64::from(code) * (1.0 - PALENESS) + 255.0 * PALENESS).round() as u8)
        };
        (0..bands).map(ink).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_round_and_as_many_as_can_be_read() {
        for (values, error, expected) in [
            (vec![312.0, 480.0, 611.0], 2.0, vec![350.0, 400.0, 450.0, 500.0, 550.0, 600.0]),
            (vec![480.0, 500.0, 520.0], 20.0, vec![500.0]),
            (
                vec![1.0, 2.0, 3.0, 900.0],
                0.0,
                vec![2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0],
            ),
            (vec![500.0; 3], 1.0, vec![]),
            (vec![], 1.0, vec![]),
        ] {
            let found = Levels::of(&values, error);
            assert_eq!(found.lux, expected, "{values:?}");
            assert_eq!(found.inks().len(), expected.len() + 1);
        }
    }

    #[test]
    fn a_value_lies_in_the_band_above_the_level_it_reaches() {
        let levels = Levels { lux: vec![100.0, 200.0], by_ratios: false };
        assert_eq!([99.9, 100.0, 199.0, 200.0].map(|v| levels.band(v)), [0, 1, 1, 2]);
    }
}
