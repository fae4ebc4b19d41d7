//! Figures with their intervals of 95 %, and whether they keep a bound.

use isolux::map::Figure;
use serde::Serialize;

/// A figure with the ends of its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Interval {
    pub(crate) value: f64,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Whether a bound is kept, at 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Verdict {
    Met,
    NotMet,
    Undecided,
}

impl From<Figure> for Interval {
    fn from(Figure { value, low, high }: Figure) -> Self {
        Self { value, low, high }
    }
}

impl Interval {
    /// Whether it is at least this.
    pub(crate) fn reaches(self, least: f64) -> Verdict {
        Verdict::of(self.low >= least, self.high < least)
    }

    /// Whether it is at most this.
    pub(crate) fn keeps_within(self, most: f64) -> Verdict {
        Verdict::of(self.high <= most, self.low > most)
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
    pub(crate) const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::NotMet, _) | (_, Self::NotMet) => Self::NotMet,
            (Self::Met, Self::Met) => Self::Met,
            _ => Self::Undecided,
        }
    }

    pub(crate) const fn text(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::NotMet => "not met",
            Self::Undecided => "undecided",
        }
    }
}
