//! Where axes begin and end, and what is marked on them.

use super::plan::Scale;
use crate::report::quantity::short;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// Room beyond the outermost values, as a share of what they span.
const ROOM: f64 = 0.05;

/// What an axis spans at least: two doublings, a fifth of a decade, of a linear one a hundredth of its unit.
const LEAST_DOUBLING: f64 = 2.0;
const LEAST_DECADES: f64 = 0.2;
const LEAST_LINEAR: f64 = 0.01;

/// Marks of an axis: few enough to be read on a phone, and enough to read values between them.
const MOST: usize = 9;
const FEWEST: usize = 3;

/// Digits that marks need at most.
const DIGITS: usize = 4;

/// Marks within a decade, the fewest first.
const WITHIN: [&[f64]; 3] = [&[1.0], &[1.0, 2.0, 5.0], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0]];

/// Steps between marks of a linear axis, of any power of ten.
const STEPS: [f64; 3] = [1.0, 2.0, 5.0];

/// What an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Span {
    pub(super) scale: Scale,
    /// From and to, as places.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Places of its marks.
    pub(super) marks: Vec<f64>,
}

impl Span {
    /// An axis that shows all of these places, and nothing if there are none.
    pub(super) fn of(scale: Scale, places: &[f64]) -> Self {
        let (low, high) = places
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let (from, to) = widened(scale, low, high);
        Self { scale, from, to, marks: marks(scale, from, to) }
    }

    /// Two axes that show the same.
    pub(super) fn common(scale: Scale, x: &[f64], y: &[f64]) -> Self {
        Self::of(scale, &[x, y].concat())
    }

    /// The text of a mark.
    pub(super) fn label(&self, mark: f64) -> String {
        short(self.scale.value(mark), DIGITS)
    }
}

/// The library lays an axis out by this.
impl Ranged for Span {
    type ValueType = f64;
    type FormatOption = NoDefaultFormatting;

    fn map(&self, place: &f64, (first, last): (i32, i32)) -> i32 {
        let share = (place - self.from) / (self.to - self.from);
        first + (share * f64::from(last - first)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.marks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for Span {
    fn format_ext(&self, place: &f64) -> String {
        self.label(*place)
    }
}

fn widened(scale: Scale, low: f64, high: f64) -> (f64, f64) {
    let least = match scale {
        Scale::Linear => LEAST_LINEAR,
        Scale::Doubling => LEAST_DOUBLING,
        Scale::Decades => LEAST_DECADES,
    };
    let span = (high - low).max(least);
    let middle = 0.5 * (low + high);
    let (from, to) = (middle - (0.5 + ROOM) * span, middle + (0.5 + ROOM) * span);
    match scale {
        Scale::Linear => (0.0_f64.min(low), to),
        _ => (from, to),
    }
}

fn marks(scale: Scale, from: f64, to: f64) -> Vec<f64> {
    match scale {
        Scale::Linear => evenly(from, to),
        Scale::Doubling => whole(from, to),
        Scale::Decades => {
            let choices = WITHIN.map(|within| decades(within, from, to));
            let fits = |marks: &Vec<f64>| (FEWEST..=MOST).contains(&marks.len());
            choices.into_iter().find(fits).unwrap_or_else(|| other(from, to))
        }
    }
}

/// The marks of a span that none of those fits: even steps where it is a part of a decade, else every so many decades.
fn other(from: f64, to: f64) -> Vec<f64> {
    if to - from > 1.0 {
        return whole(from, to);
    }
    let values = evenly(libm::exp10(from), libm::exp10(to));
    values.into_iter().map(libm::log10).collect()
}

/// Whole powers, every so many that they can be read.
fn whole(from: f64, to: f64) -> Vec<f64> {
    let (first, last) = (from.ceil() as i64, to.floor() as i64);
    let step = ((last - first) as f64 / MOST as f64).floor() as usize + 1;
    (first..=last).step_by(step).map(|k| k as f64).collect()
}

fn decades(within: &[f64], from: f64, to: f64) -> Vec<f64> {
    let powers = from.floor() as i64..=to.ceil() as i64;
    powers
        .flat_map(|power| within.iter().map(move |&m| power as f64 + libm::log10(m)))
        .filter(|place| (from..=to).contains(place))
        .collect()
}

fn evenly(from: f64, to: f64) -> Vec<f64> {
    let rough = (to - from) / (MOST - 1) as f64;
    let power = libm::exp10(libm::log10(rough).floor());
    let wide_enough = |step: &f64| *step >= rough;
    let step = STEPS.iter().map(|s| s * power).find(wide_enough).unwrap_or(10.0 * power);
    let (first, last) = ((from / step).ceil() as i64, (to / step).floor() as i64);
    (first..=last).map(|k| k as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, values: [f64; 2]) -> Vec<String> {
        let places = values.map(|v| scale.place(v).unwrap());
        let span = Span::of(scale, &places);
        span.marks.iter().map(|&mark| span.label(mark)).collect()
    }

    #[test]
    fn marks_are_round_and_few() {
        assert_eq!(labels(Scale::Doubling, [0.5, 8.0]), ["0.5", "1", "2", "4", "8"]);
        assert_eq!(labels(Scale::Decades, [0.01, 10.0]), ["0.01", "0.1", "1", "10"]);
        assert_eq!(labels(Scale::Decades, [0.9, 12.0]), ["1", "2", "5", "10"]);
        assert_eq!(labels(Scale::Decades, [0.85, 1.2]), ["0.8", "0.9", "1", "1.1", "1.2", "1.3"]);
        assert_eq!(labels(Scale::Decades, [1e-9, 1e9])[..2], ["1×10⁻⁹", "1×10⁻⁶"]);
        assert_eq!(labels(Scale::Linear, [1.0, 100.0]), ["0", "20", "40", "60", "80", "100"]);
        for span in [0.5, 1.0, 3.0, 7.0, 20.0] {
            for scale in [Scale::Linear, Scale::Doubling, Scale::Decades] {
                let marks = Span::of(scale, &[0.0, span]).marks;
                assert!((2..=2 * MOST).contains(&marks.len()), "{scale:?} {span}: {marks:?}");
            }
        }
    }

    #[test]
    fn nothing_and_one_value_have_axes() {
        for scale in [Scale::Linear, Scale::Doubling, Scale::Decades] {
            for places in [vec![], vec![0.0], vec![3.0, 3.0]] {
                let span = Span::of(scale, &places);
                assert!(span.from < span.to && !span.marks.is_empty(), "{scale:?} {span:?}");
                assert!(places.iter().all(|p| (span.from..=span.to).contains(p)));
            }
        }
    }
}
