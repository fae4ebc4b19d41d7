//! Lengths that everything in the hall is placed by.

/// From the west wall to the east wall, m.
pub(super) const LENGTH_M: f64 = 36.0;
/// From the south wall to the north wall, m.
pub(super) const WIDTH_M: f64 = 24.0;
/// From the floor to the ceiling, m.
pub(super) const HEIGHT_M: f64 = 4.0;
/// Columns stand this far apart along the hall, the first and last half of it from the walls, m.
pub(super) const BAY_M: f64 = 6.0;
/// Number of columns in a row.
pub(super) const COLUMNS: u32 = 6;
/// The rows of columns, distance from the south wall, m.
pub(super) const ROWS_M: [f64; 2] = [8.0, 16.0];
/// Between solids that touch: what is coplanar is decided by rounding.
pub(super) const GAP_M: f64 = 0.001;
