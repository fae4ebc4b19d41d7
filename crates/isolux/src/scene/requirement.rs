//! What has to hold on a calculation grid.

use serde::{Deserialize, Serialize};

/// Conditions, and where they come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Requirement {
    /// The row of a standard that they follow from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub task: Option<String>,
    /// All of them have to hold.
    pub conditions: Vec<Condition>,
}

/// Areas of emergency lighting (EN 1838).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EmergencyArea {
    /// A strip of at most two metres that leads out.
    EscapeRoute,
    /// A floor from which escape routes are reached.
    OpenArea,
    /// Where something dangerous is to be ended.
    HighRisk {
        /// The illuminance that its task requires, lx.
        task_lx: f64,
    },
}

/// A bound of a figure of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Condition {
    /// The figure.
    pub of: GridQuantity,
    /// Whether the bound is the least that it may be, else the most.
    pub is_least: bool,
    /// The bound, lx, a ratio, or a rating.
    pub bound: f64,
}

/// A figure of a grid; illuminances are maintained.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GridQuantity {
    /// Mean illuminance, lx.
    Mean,
    /// Least illuminance, lx.
    Least,
    /// Greatest illuminance, lx.
    Greatest,
    /// Least over mean.
    Uniformity,
    /// Least over greatest.
    Diversity,
    /// The worst unified glare rating of people who sit there.
    GlareRating,
}

impl GridQuantity {
    /// All of them by the symbols of EN 12464-1.
    pub const ALL: [(&'static str, Self); 6] = [
        ("Em", Self::Mean),
        ("Emin", Self::Least),
        ("Emax", Self::Greatest),
        ("U0", Self::Uniformity),
        ("Ud", Self::Diversity),
        ("UGR", Self::GlareRating),
    ];

    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        Self::ALL.into_iter().find(|(_, of)| *of == self).map_or("", |(symbol, _)| symbol)
    }

    /// Its unit, with a space before it; nothing for ratios.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Mean | Self::Least | Self::Greatest => " lx",
            Self::Uniformity | Self::Diversity | Self::GlareRating => "",
        }
    }

    /// The greatest value that a bound may have, if there is one.
    pub const fn most(self) -> Option<f64> {
        match self {
            Self::Mean | Self::Least | Self::Greatest | Self::GlareRating => None,
            Self::Uniformity | Self::Diversity => Some(1.0),
        }
    }
}

impl Condition {
    /// The condition as it is written: `Em >= 500 lx`.
    pub fn text(&self) -> String {
        let sign = if self.is_least { ">=" } else { "<=" };
        format!("{} {sign} {}{}", self.of.symbol(), self.bound, self.of.unit())
    }
}
