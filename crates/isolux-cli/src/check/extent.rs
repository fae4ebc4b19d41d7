//! Whether the scene has the size of something built, near its origin.

use super::finding::Finding;
use crate::origin::{Extent, Remoteness};
use crate::quantity::significant;
use std::path::Path;

/// A room is larger and a building smaller; outside, the unit is probably not the metre.
const PLAUSIBLE_M: std::ops::RangeInclusive<f64> = 0.5..=1000.0;

pub(super) fn findings(extent: &Extent, source: &Path) -> Vec<Finding> {
    let mut found = Vec::new();
    let largest_m = extent.largest_m();
    if !PLAUSIBLE_M.contains(&largest_m) {
        found.push(Finding::warning(
            "scene",
            format!("its largest side is {} m", significant(largest_m, 2)),
            "coordinates are read as metres: check the unit it was exported in",
        ));
    }
    if let Remoteness::Far(problem) | Remoteness::TooFar(problem) = extent.remoteness(source) {
        found.push(Finding::warning("scene", problem.what, problem.remedy));
    }
    found
}
