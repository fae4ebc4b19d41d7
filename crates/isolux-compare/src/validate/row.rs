//! What is said of one case, one engine and one seed.

use crate::expectation::Quantity;
use crate::statistics::{student_quantile, student_two_sided};
use crate::tolerance::{COVERAGE, SIGNIFICANCE, STANDARD_ERRORS};
use isolux::map::{Accuracy, Audit, Method};
use serde::Serialize;

/// One case through one engine from one seed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ValidateRow {
    /// Name of the case.
    pub case: &'static str,
    /// Engine.
    pub method: Method,
    /// Seed.
    pub seed: u64,
    /// Readings compared.
    pub readings: u64,
    /// Of them, those with a statistical error.
    pub statistical: u64,
    /// Of those, farther off than three standard errors and all bounds.
    pub outliers: u64,
    /// Outliers that chance allows.
    pub accepted_outliers: u64,
    /// Of `statistical`, outside their interval of 95 %, bounds included.
    pub outside_interval: u64,
    /// The reading farthest off in units of what it may be.
    pub worst: Option<Reading>,
    /// What the map says of itself.
    pub accuracy: Option<Accuracy>,
    /// What the independent test of the run has found.
    pub audit: Option<Audit>,
    /// Independent replicates.
    pub increments: u64,
    /// Rays traced.
    pub rays: u64,
    /// Time of the solution, s.
    pub time_s: f64,
    /// Whether the engine is right.
    pub verdict: Verdict,
}

/// A reading beside what it should be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Where, m.
    pub position: [f64; 3],
    /// Which part of the light.
    pub quantity: Quantity,
    /// What it should be, lx.
    pub expected_lx: f64,
    /// What it is, lx.
    pub measured_lx: f64,
    /// Its standard error, lx.
    pub standard_error_lx: f64,
    /// Independent values behind the standard error, less one.
    pub degrees_of_freedom: f64,
    /// What else it may be off by, lx.
    pub bound_lx: f64,
    /// Error over three standard errors and the bound, the largest of photometric value and
    /// channels.
    pub ratio: f64,
}

impl Reading {
    pub(super) fn is_statistical(&self) -> bool {
        self.standard_error_lx > 0.0
    }

    /// Beyond its errors and bounds at a level of confidence.
    fn is_beyond(&self, confidence: f64) -> bool {
        let deviations = student_quantile(0.5 + 0.5 * confidence, self.degrees_of_freedom);
        let allowed_lx = deviations * self.standard_error_lx + self.bound_lx;
        (self.measured_lx - self.expected_lx).abs() > allowed_lx
    }

    pub(super) fn is_outside_interval(&self) -> bool {
        self.is_beyond(COVERAGE)
    }

    /// Farther off than the farthest of so many readings would be, but for one table in many.
    pub(super) fn is_impossible(&self, trials: u64) -> bool {
        self.is_statistical() && self.is_beyond(1.0 - SIGNIFICANCE / trials as f64)
    }

    /// Probability that a right reading is off nevertheless.
    pub(super) fn chance_to_be_off(&self) -> f64 {
        student_two_sided(STANDARD_ERRORS, self.degrees_of_freedom)
    }

    pub(super) fn is_off(&self) -> bool {
        self.ratio > 1.0
    }
}

/// Whether an engine is right.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase", tag = "verdict")]
pub enum Verdict {
    /// It is.
    Pass,
    /// It is not, or gave no answer.
    Fail {
        /// What is wrong.
        reason: String,
    },
}
