//! What is found on one grid.

use super::warnings::Outside;
use crate::grid_values::GridValues;
use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::Point;
use isolux::scene::{CalculationGrid, Scene};

/// A grid with its values, and what its figures do not say.
pub(crate) struct GridResult {
    pub(crate) read: GridValues,
    /// Whether some points lie in free space, where caustics are unknown.
    pub(crate) in_space: bool,
    pub(crate) outside: Outside,
}

impl GridResult {
    pub(crate) fn of(grid: CalculationGrid, (scene, reader): (&Scene, &MapReader)) -> Self {
        let read =
            GridValues::of(grid, (scene, reader)).expect("a grid without problems has a normal");
        let on_surface =
            |&position: &Point| reader.is_on_surface(ProbePoint { position, normal: read.normal });
        let in_space = !read.points.iter().all(on_surface);
        let outside = Outside::of(&read, reader);
        Self { read, in_space, outside }
    }
}
