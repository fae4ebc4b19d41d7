//! What a map says at the points of a calculation grid.

use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::{Normal, Point};
use isolux::map::{GridFigures, Illuminance};
use isolux::scene::CalculationGrid;
use rayon::prelude::*;

/// A grid with its values.
pub(crate) struct GridValues {
    /// As it was asked for.
    pub(crate) grid: CalculationGrid,
    /// The way its points face.
    pub(crate) normal: Normal,
    /// Along `u` first.
    pub(crate) points: Vec<Point>,
    /// Initial illuminance.
    pub(crate) values: Vec<Option<Illuminance>>,
    /// What is told of all points, maintained; `None` where none is known.
    pub(crate) figures: Option<GridFigures>,
}

impl GridValues {
    /// Reads a map; `None` of a grid that has no area.
    pub(crate) fn of(grid: CalculationGrid, reader: &MapReader<'_>) -> Option<Self> {
        let (normal, points) = (grid.normal()?, grid.points());
        let read = |&position: &Point| reader.measure(ProbePoint { position, normal });
        let values: Vec<Option<Illuminance>> = points.par_iter().map(read).collect();
        let figures = GridFigures::of(&grid, &values);
        Some(Self { grid, normal, points, values, figures })
    }

    /// Values as they are maintained.
    pub(crate) fn maintained(&self) -> impl Iterator<Item = Option<Illuminance>> + '_ {
        let factor = self.grid.maintenance_factor;
        self.values.iter().map(move |value| value.map(|value| value.dimmed(factor)))
    }
}
