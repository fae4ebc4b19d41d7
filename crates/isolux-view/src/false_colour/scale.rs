//! From values to steps of a colour map, and the round numbers beside it.

use super::colour_map::STEPS;
use crate::error::ViewError;

/// How values are spread over the colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// Evenly in the logarithm, for scenes of many orders of magnitude.
    Logarithmic,
}

/// The share of pixels that automatic limits may leave outside at either end.
const OUTSIDE: f64 = 0.005;
/// Automatic logarithmic limits span at most this ratio.
const WIDEST_RATIO: f64 = 1e4;
/// Numbers beside a linear scale at most, but for the ends.
const MOST_TICKS: f64 = 10.0;
/// Decimal numbers that differ by less, relatively, are the same but for rounding.
const ROUNDING: f64 = 1e-9;

/// A scale with its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
}

/// Whether some values lie beyond the limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Overflow {
    pub(super) below: bool,
    pub(super) above: bool,
}

impl Axis {
    /// With the limits given, or round ones around the values.
    pub(super) fn new(
        scale: Scale,
        limits: Option<(f64, f64)>,
        values: &[Option<f64>],
    ) -> Result<Self, ViewError> {
        let (low, high) = match limits {
            Some(limits) => limits,
            None => round_limits(scale, values)?,
        };
        let positive = scale == Scale::Linear || low > 0.0;
        if low < high && low.is_finite() && high.is_finite() && positive {
            Ok(Self { scale, low, high })
        } else {
            Err(ViewError::Limits { low, high })
        }
    }

    /// Where a value lies between the limits: 0 at the lower, 1 at the upper.
    pub(super) fn position(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic if value <= 0.0 => f64::NEG_INFINITY,
            Scale::Logarithmic => libm::log(value / self.low) / libm::log(self.high / self.low),
        }
    }

    /// The colour of a value.
    pub(super) fn step(&self, value: f64) -> usize {
        let step = self.position(value) * STEPS as f64;
        step.clamp(0.0, STEPS as f64 - 1.0) as usize
    }

    /// Round numbers from the lower to the upper limit.
    pub(super) fn ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear => self.linear_ticks(),
            Scale::Logarithmic => self.logarithmic_ticks(),
        }
    }

    fn linear_ticks(&self) -> Vec<f64> {
        let span = self.high - self.low;
        let least = span / MOST_TICKS;
        let decade = libm::exp10(libm::log10(least).floor());
        let steps = [1.0, 2.0, 2.5, 5.0, 10.0].map(|m| m * decade);
        let few = || steps.into_iter().filter(|step| *step >= least * (1.0 - ROUNDING));
        let whole = |step: &f64| (span / step - (span / step).round()).abs() < ROUNDING;
        let step = few().find(whole).or_else(|| few().next()).unwrap_or(span);
        let first = (self.low / step - ROUNDING).ceil() as i64;
        let last = (self.high / step + ROUNDING).floor() as i64;
        (first..=last).map(|k| k as f64 * step).collect()
    }

    fn logarithmic_ticks(&self) -> Vec<f64> {
        let decades = libm::log10(self.high / self.low);
        let mantissas: &[f64] = match decades {
            d if d <= 1.0 => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0],
            d if d <= 4.0 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let every = (decades / MOST_TICKS).ceil().max(1.0) as usize;
        let (first, last) = (libm::log10(self.low).floor(), libm::log10(self.high).ceil());
        let inside =
            |t: &f64| (self.low * (1.0 - ROUNDING)..=self.high * (1.0 + ROUNDING)).contains(t);
        (first as i32..=last as i32)
            .step_by(every)
            .flat_map(|decade| mantissas.iter().map(move |m| m * libm::exp10(f64::from(decade))))
            .filter(inside)
            .collect()
    }

    /// Whether values lie beyond the limits.
    pub(super) fn overflow(&self, values: &[Option<f64>]) -> Overflow {
        let known = || values.iter().flatten();
        Overflow { below: known().any(|v| *v < self.low), above: known().any(|v| *v > self.high) }
    }
}

/// Round limits that hold all but the outermost half per cent of the values at either end; a linear scale begins at zero.
pub fn round_limits(scale: Scale, values: &[Option<f64>]) -> Result<(f64, f64), ViewError> {
    let positive = |v: &f64| scale == Scale::Linear || *v > 0.0;
    let mut known: Vec<f64> = values.iter().flatten().copied().filter(positive).collect();
    known.sort_by(f64::total_cmp);
    let (Some(&least), Some(&most)) = (known.first(), known.last()) else {
        return Err(ViewError::NothingKnown);
    };
    let outside = (OUTSIDE * known.len() as f64) as usize;
    let (low, high) = (known[outside], known[known.len() - 1 - outside]);
    // Where the middle is all one value the ends decide.
    let (low, high) = if low < high { (low, high) } else { (least, most) };
    Ok(match scale {
        Scale::Linear if high > 0.0 => (0.0, round_up(high, &EVENLY_DIVIDED)),
        Scale::Linear => (0.0, 1.0),
        Scale::Logarithmic => {
            let high = round_up(high, &LABELLED);
            let low = round_down(low.max(high / WIDEST_RATIO));
            (low, if high > low { high } else { 10.0 * low })
        }
    })
}

/// Leading digits of limits that round steps divide.
const EVENLY_DIVIDED: [f64; 9] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
/// Leading digits that stand beside every logarithmic scale of up to four decades.
const LABELLED: [f64; 3] = [1.0, 2.0, 5.0];

/// The least of the leading digits times a power of ten that is not below `value > 0`.
fn round_up(value: f64, digits: &[f64]) -> f64 {
    let decade = libm::exp10(libm::log10(value).floor());
    let enough = |m: &&f64| **m * decade >= value * (1.0 - ROUNDING);
    digits.iter().find(enough).map_or(10.0 * decade, |m| m * decade)
}

/// The greatest labelled number that is not above `value > 0`.
fn round_down(value: f64) -> f64 {
    let decade = libm::exp10(libm::log10(value).floor());
    let enough = |m: &&f64| **m * decade <= value * (1.0 + ROUNDING);
    LABELLED.iter().rev().find(enough).map_or(decade, |m| m * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(scale: Scale, values: &[f64]) -> Result<Axis, ViewError> {
        Axis::new(scale, None, &values.iter().copied().map(Some).collect::<Vec<_>>())
    }

    #[test]
    fn automatic_limits_are_round_and_hold_the_values() {
        for (scale, values, limits) in [
            (Scale::Linear, vec![12.0, 873.0], (0.0, 1000.0)),
            (Scale::Linear, vec![0.0, 0.0], (0.0, 1.0)),
            (Scale::Linear, vec![500.0; 4], (0.0, 500.0)),
            (Scale::Logarithmic, vec![0.0, 3.0, 640.0], (2.0, 1000.0)),
            (Scale::Logarithmic, vec![100.0; 3], (100.0, 1000.0)),
            (Scale::Logarithmic, vec![1e-12, 1e3], (0.1, 1000.0)),
        ] {
            let axis = axis(scale, &values).unwrap();
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
            assert!(close(axis.low, limits.0) && close(axis.high, limits.1), "{values:?} {axis:?}");
        }
    }

    #[test]
    fn nothing_known_has_no_scale() {
        assert_eq!(axis(Scale::Linear, &[]), Err(ViewError::NothingKnown));
        assert_eq!(axis(Scale::Logarithmic, &[0.0]), Err(ViewError::NothingKnown));
    }

    #[test]
    fn limits_must_enclose_something() {
        for (scale, low, high) in [
            (Scale::Linear, 5.0, 5.0),
            (Scale::Linear, 5.0, 1.0),
            (Scale::Linear, 0.0, f64::INFINITY),
            (Scale::Linear, f64::NAN, 1.0),
            (Scale::Logarithmic, 0.0, 10.0),
        ] {
            assert!(Axis::new(scale, Some((low, high)), &[]).is_err(), "{low} {high}");
        }
    }

    #[test]
    fn colours_run_from_limit_to_limit() {
        let linear = Axis::new(Scale::Linear, Some((0.0, 512.0)), &[]).unwrap();
        let steps = [-1.0, 0.0, 1.9, 2.0, 511.9, 512.0, 1e9, f64::NAN].map(|v| linear.step(v));
        assert_eq!(steps, [0, 0, 0, 1, 255, 255, 255, 0]);
        let log = Axis::new(Scale::Logarithmic, Some((1.0, 100.0)), &[]).unwrap();
        assert_eq!([0.0, 1.0, 10.0, 100.0].map(|v| log.step(v)), [0, 0, 128, 255]);
    }

    #[test]
    fn ticks_are_few_and_round() {
        for (scale, low, high, expected) in [
            (Scale::Linear, 0.0, 500.0, vec![0, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500]),
            (Scale::Linear, 0.0, 3000.0, vec![0, 500, 1000, 1500, 2000, 2500, 3000]),
            (Scale::Linear, 0.0, 1500.0, vec![0, 250, 500, 750, 1000, 1250, 1500]),
            (Scale::Linear, 95.0, 203.0, vec![100, 120, 140, 160, 180, 200]),
            (Scale::Logarithmic, 10.0, 1000.0, vec![10, 20, 50, 100, 200, 500, 1000]),
        ] {
            let ticks = Axis::new(scale, Some((low, high)), &[]).unwrap().ticks();
            let rounded: Vec<i64> = ticks.iter().map(|t| t.round() as i64).collect();
            assert_eq!(rounded, expected);
        }
    }
}
