//! Whether the scene has the size of something built, near its origin.

use super::finding::Finding;
use crate::quantity::significant;
use isolux::scene::Scene;

/// A room is larger and a building smaller; outside, the unit is probably not the metre.
const PLAUSIBLE_M: std::ops::RangeInclusive<f64> = 0.5..=1000.0;
/// `f32` coordinates resolve a millimetre up to here: 2^-23 of it is 1.2 mm.
const FAR_M: f64 = 10_000.0;

/// The box around all surfaces.
pub(super) struct Extent {
    pub size_m: [f64; 3],
    farthest_m: f64,
}

impl Extent {
    pub(super) fn of(scene: &Scene) -> Self {
        let Some((low, high)) = scene.bvh().mesh().bounds() else {
            return Self { size_m: [0.0; 3], farthest_m: 0.0 };
        };
        let (low, high) = (<[f64; 3]>::from(low), <[f64; 3]>::from(high));
        let farthest_m = low.iter().chain(&high).fold(0.0_f64, |far, c| far.max(c.abs()));
        Self { size_m: std::array::from_fn(|k| high[k] - low[k]), farthest_m }
    }

    pub(super) fn findings(&self) -> Vec<Finding> {
        let mut found = Vec::new();
        let largest = self.size_m.iter().fold(0.0_f64, |a, &b| a.max(b));
        if !PLAUSIBLE_M.contains(&largest) {
            found.push(Finding::warning(
                "scene",
                format!("its largest side is {} m", significant(largest, 2)),
                "coordinates are read as metres: check the unit it was exported in",
            ));
        }
        if self.farthest_m > FAR_M {
            found.push(Finding::warning(
                "scene",
                format!("it lies {} m from its origin", significant(self.farthest_m, 2)),
                "move it to the origin: single precision resolves too little there",
            ));
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_that_are_not_metres_and_places_far_away_are_found() {
        for (largest, farthest_m, expected) in
            [(10.0, 5.0, 0), (0.01, 0.01, 1), (4000.0, 4000.0, 1), (10.0, 5e5, 1), (5e4, 5e4, 2)]
        {
            let extent = Extent { size_m: [1e-3, largest, 1e-3], farthest_m };
            assert_eq!(extent.findings().len(), expected, "{largest} m, {farthest_m} m");
        }
    }
}
