//! Figures with their intervals of 95 %, and whether they keep a bound.

use serde::Serialize;
use std::f64::consts::SQRT_2;

/// Half the width of an interval of 95 % in standard deviations of the normal distribution.
pub const NORMAL_95: f64 = 1.96;

/// A figure and its interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// The figure.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// Whether a bound is kept, at 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The whole interval keeps the bound.
    Met,
    /// No part of the interval keeps it.
    NotMet,
    /// The bound lies within the interval.
    Undecided,
}

impl Figure {
    /// A figure without an error.
    pub const fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }

    /// The figure and the ends of its interval times a factor of zero or more.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let Self { value, low, high } = self;
        Self { value: factor * value, low: factor * low, high: factor * high }
    }

    /// Half of the width of its interval.
    pub fn half_width(self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// Whether it is at least this.
    pub fn reaches(self, least: f64) -> Verdict {
        Verdict::of(self.low >= least, self.high < least)
    }

    /// Whether it is at most this.
    pub fn keeps_within(self, most: f64) -> Verdict {
        Verdict::of(self.high <= most, self.low > most)
    }

    /// The probability that it is at least this: each side of the interval is half of a normal distribution.
    pub fn probability_above(self, least: f64) -> f64 {
        let off = least - self.value;
        let half = if off > 0.0 { self.high - self.value } else { self.value - self.low };
        if half <= 0.0 {
            return f64::from(u8::from(off <= 0.0));
        }
        0.5 * libm::erfc(off * NORMAL_95 / half / SQRT_2)
    }
}

impl Verdict {
    const fn of(surely: bool, never: bool) -> Self {
        match (surely, never) {
            (true, _) => Self::Met,
            (_, true) => Self::NotMet,
            _ => Self::Undecided,
        }
    }

    /// Whether both are met.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::NotMet, _) | (_, Self::NotMet) => Self::NotMet,
            (Self::Met, Self::Met) => Self::Met,
            _ => Self::Undecided,
        }
    }

    /// The word for it.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::NotMet => "not met",
            Self::Undecided => "undecided",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_within_an_interval_are_undecided() {
        let figure = Figure { value: 500.0, low: 490.0, high: 520.0 };
        for (bound, least, most) in [
            (489.0, Verdict::Met, Verdict::NotMet),
            (500.0, Verdict::Undecided, Verdict::Undecided),
            (521.0, Verdict::NotMet, Verdict::Met),
        ] {
            assert_eq!(figure.reaches(bound), least, "{bound}");
            assert_eq!(figure.keeps_within(bound), most, "{bound}");
        }
        assert_eq!(Verdict::Met.and(Verdict::Undecided), Verdict::Undecided);
        assert_eq!(Verdict::Undecided.and(Verdict::NotMet), Verdict::NotMet);
    }

    #[test]
    fn ends_of_an_interval_have_a_probability_of_a_fortieth() {
        let figure = Figure { value: 500.0, low: 490.0, high: 520.0 };
        assert!((figure.probability_above(500.0) - 0.5).abs() < 1e-12);
        assert!((figure.probability_above(490.0) - 0.975).abs() < 1e-4);
        assert!((figure.probability_above(520.0) - 0.025).abs() < 1e-4);
        assert_eq!(Figure::exact(500.0).probability_above(500.0), 1.0);
        assert_eq!(Figure::exact(500.0).probability_above(500.1), 0.0);
    }
}
