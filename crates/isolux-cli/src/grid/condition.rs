//! Bounds of figures of a grid.

use crate::interval::{Interval, Verdict};
use isolux::map::{Figure, GridFigures, NORMAL_95};
use std::f64::consts::SQRT_2;

/// A bound of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Condition {
    pub(super) of: Quantity,
    pub(super) is_least: bool,
    pub(super) bound: f64,
}

/// A figure of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Mean,
    Least,
    Greatest,
    Uniformity,
    Diversity,
}

impl Quantity {
    const ALL: [(&'static str, Self); 5] = [
        ("Em", Self::Mean),
        ("Emin", Self::Least),
        ("Emax", Self::Greatest),
        ("U0", Self::Uniformity),
        ("Ud", Self::Diversity),
    ];

    fn word(self) -> &'static str {
        Self::ALL.into_iter().find(|(_, of)| *of == self).map_or("", |(word, _)| word)
    }

    /// What it is on a grid.
    pub(super) const fn of(self, figures: &GridFigures) -> Figure {
        match self {
            Self::Mean => figures.mean_lx,
            Self::Least => figures.least_lx,
            Self::Greatest => figures.greatest_lx,
            Self::Uniformity => figures.uniformity,
            Self::Diversity => figures.diversity,
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Mean | Self::Least | Self::Greatest => " lx",
            Self::Uniformity | Self::Diversity => "",
        }
    }
}

/// Reads one condition.
pub(super) fn condition(text: &str) -> Result<Condition, String> {
    let how =
        "write `Em >= 500`, with Em, Emin, Emax, U0 or Ud, and >= or <=; or `EN 12464-1 34.2`";
    let parts = [(">=", true), ("<=", false)]
        .into_iter()
        .find_map(|(sign, is_least)| Some((text.split_once(sign)?, is_least)));
    let Some(((word, number), is_least)) = parts else {
        return Err(format!("`{}` is no condition; {how}", text.trim()));
    };
    let of = Quantity::ALL.into_iter().find(|(known, _)| *known == word.trim());
    let Some((_, of)) = of else {
        return Err(format!("`{}` is no figure of a grid; {how}", word.trim()));
    };
    let number = number.trim().strip_suffix("lx").unwrap_or(number).trim();
    match number.parse::<f64>() {
        Ok(bound) if bound.is_finite() && bound >= 0.0 => Ok(Condition { of, is_least, bound }),
        _ => Err(format!("`{number}` is no number of zero or more; {how}")),
    }
}

impl Condition {
    /// As it is read.
    pub(super) fn text(&self) -> String {
        let sign = if self.is_least { ">=" } else { "<=" };
        format!("{} {sign} {}{}", self.of.word(), self.bound, self.of.unit())
    }

    pub(super) fn verdict(&self, figure: Figure) -> Verdict {
        let of = Interval::from(figure);
        if self.is_least { of.reaches(self.bound) } else { of.keeps_within(self.bound) }
    }

    /// How likely it holds: each side of the interval has its own half of a normal distribution.
    pub(super) fn probability(&self, figure: Figure) -> f64 {
        let off = self.bound - figure.value;
        let half = if off > 0.0 { figure.high - figure.value } else { figure.value - figure.low };
        if half <= 0.0 {
            let holds = if self.is_least { off <= 0.0 } else { off >= 0.0 };
            return f64::from(u8::from(holds));
        }
        let above = 0.5 * libm::erfc(off * NORMAL_95 / half / SQRT_2);
        if self.is_least { above } else { 1.0 - above }
    }
}
