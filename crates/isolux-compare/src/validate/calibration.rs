//! Whether error bars keep their promise.

use super::row::ValidateRow;
use crate::statistics::accepted_outliers;
use crate::tolerance::{COVERAGE, SIGNIFICANCE};
use isolux::map::Method;
use serde::Serialize;

/// How often intervals of 95 % held the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Calibration {
    /// Engine.
    pub method: Method,
    /// Readings with a statistical error, over all its rows.
    pub readings: u64,
    /// Of them, outside their interval.
    pub outside: u64,
    /// Share inside; `None` of nothing.
    pub coverage: Option<f64>,
    /// Outside readings that chance allows.
    pub accepted_outside: u64,
}

impl Calibration {
    pub(super) fn of(method: Method, rows: &[ValidateRow]) -> Self {
        let rows = || rows.iter().filter(|row| row.method == method);
        let readings: u64 = rows().map(|row| row.statistical).sum();
        let outside: u64 = rows().map(|row| row.outside_interval).sum();
        Self {
            method,
            readings,
            outside,
            coverage: (readings > 0).then(|| 1.0 - outside as f64 / readings as f64),
            accepted_outside: accepted_outliers(readings, 1.0 - COVERAGE, SIGNIFICANCE),
        }
    }
}
