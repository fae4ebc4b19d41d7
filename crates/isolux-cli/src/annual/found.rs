//! What is found on a grid.

use super::figures::GridYear;
use super::place::PlaceYear;
use isolux::geometry::Point;
use isolux::scene::CalculationGrid;

/// A grid with its year.
pub(crate) struct Found {
    pub(crate) grid: CalculationGrid,
    pub(super) points: Vec<Point>,
    pub(super) years: Vec<PlaceYear>,
    pub(crate) figures: GridYear,
}

impl Found {
    /// Daylight factors of the points with their standard errors, as fractions.
    pub(crate) fn factors(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.years.iter().map(|year| {
            let factor = &year.daylight_factor;
            (factor.value, factor.standard_error())
        })
    }
}
