//! Points with right values.

use isolux::engine::ProbePoint;

/// Points at which a scene is judged.
pub(super) struct PointSet {
    pub(super) name: &'static str,
    pub(super) points: Vec<ExactPoint>,
    /// What the expected values are off by themselves, in the measure of errors.
    pub(super) own_error: f64,
    /// Whether they hold the light that glass and gloss throw on surfaces.
    pub(super) has_caustics: bool,
}

impl PointSet {
    pub(super) fn exact(name: &'static str, points: Vec<ExactPoint>) -> Self {
        Self { name, points, own_error: 0.0, has_caustics: true }
    }
}

/// The exact illuminance at a place, and how much the place counts.
pub(super) struct ExactPoint {
    pub(super) at: ProbePoint,
    pub(super) expected_lx: f64,
    pub(super) weight: f64,
}

impl ExactPoint {
    pub(super) fn of((at, expected_lx): (ProbePoint, f64)) -> Self {
        Self { at, expected_lx, weight: 1.0 }
    }
}
