//! What a map says at the points of a calculation grid.

use crate::beside;
use crate::caller::{look, lookout};
use crate::unlit::{is_dark, known_dark};
use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::{Normal, Point};
use isolux::map::{GridFigures, Illuminance};
use isolux::scene::{CalculationGrid, Scene};
use rayon::prelude::*;

/// A grid with its values.
pub(crate) struct GridValues {
    /// As it was asked for.
    pub(crate) grid: CalculationGrid,
    /// The way its points face.
    pub(crate) normal: Normal,
    /// Along `u` first.
    pub(crate) points: Vec<Point>,
    /// Initial illuminance; `None` where it is not known, and outside of the room.
    pub(crate) values: Vec<Option<Illuminance>>,
    /// Of every point whether it lies outside of the room: no light reaches it, and it sees nothing that is lit, while
    /// other points of the grid are lit.
    pub(crate) are_outside: Vec<bool>,
    /// What is told of all points, maintained; `None` where none is known.
    pub(crate) figures: Option<GridFigures>,
}

impl GridValues {
    /// Reads the illuminance of planes that face the way of the grid.
    pub(crate) fn of(
        grid: CalculationGrid,
        (scene, reader): (&Scene, &MapReader<'_>),
    ) -> Option<Self> {
        Self::read(grid, (scene, reader), |at| reader.measure(at))
    }

    /// Reads a map; `None` of a grid that has no area. Points inside of things have no value.
    pub(crate) fn read(
        grid: CalculationGrid,
        (scene, reader): (&Scene, &MapReader<'_>),
        measure: impl Fn(ProbePoint) -> Option<Illuminance> + Sync,
    ) -> Option<Self> {
        let (normal, points) = (grid.normal()?, grid.points());
        let is_left = lookout();
        let all = |read: &(dyn Fn(ProbePoint) -> Option<Illuminance> + Sync)| {
            let read = |&position: &Point| {
                let at = ProbePoint { position, normal };
                if is_left() { None } else { beside::read(scene, at, read) }
            };
            points.par_iter().map(read).collect::<Vec<_>>()
        };
        let mut values = all(&measure);
        if values.iter().all(Option::is_none) {
            values = all(&|at| known_dark((scene, reader), at));
        }
        let are_outside = are_outside((&points, &values), normal, reader);
        look();
        for (value, is_outside) in values.iter_mut().zip(&are_outside) {
            *value = value.filter(|_| !is_outside);
        }
        let figures = GridFigures::of(&grid, &values);
        Some(Self { grid, normal, points, values, are_outside, figures })
    }

    /// Values as they are maintained.
    pub(crate) fn maintained(&self) -> impl Iterator<Item = Option<Illuminance>> + '_ {
        let factor = self.grid.maintenance_factor;
        self.values.iter().map(move |value| value.map(|value| value.dimmed(factor)))
    }
}

/// Of every point whether it lies outside of the room that others lie in.
fn are_outside(
    (points, values): (&[Point], &[Option<Illuminance>]),
    normal: Normal,
    reader: &MapReader<'_>,
) -> Vec<bool> {
    if values.iter().flatten().all(is_dark) {
        return vec![false; points.len()];
    }
    let is_left = lookout();
    let all = points.par_iter().zip(values);
    all.map(|(&position, value)| {
        let is_dark = !is_left() && value.as_ref().is_some_and(is_dark);
        is_dark && !reader.sees_lit(ProbePoint { position, normal })
    })
    .collect()
}
