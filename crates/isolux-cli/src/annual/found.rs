//! What is found on a grid.

use super::figures::GridYear;
use super::place::PlaceYear;
use isolux::geometry::Point;
use isolux::scene::CalculationGrid;

/// A grid with its year.
pub(super) struct Found {
    pub(super) grid: CalculationGrid,
    pub(super) points: Vec<Point>,
    pub(super) years: Vec<PlaceYear>,
    pub(super) figures: GridYear,
}
