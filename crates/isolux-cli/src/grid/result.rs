//! What is found on one grid.

use super::asked::Asked;
use super::modelling::Modelling;
use super::warnings::Outside;
use crate::grid_values::GridValues;
use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::Point;
use isolux::map::Illuminance;
use isolux::scene::{CalculationGrid, Scene};

/// A grid with its values, and what its figures do not say.
pub(crate) struct GridResult {
    pub(crate) read: GridValues,
    /// Whether some points lie in free space, where caustics are unknown.
    pub(crate) in_space: bool,
    pub(crate) outside: Outside,
    /// If it is asked for.
    pub(super) modelling: Option<Modelling>,
}

impl GridResult {
    pub(crate) fn of(
        grid: CalculationGrid,
        (scene, reader): (&Scene, &MapReader),
        asked: &Asked,
    ) -> Self {
        let values = |read: &(dyn Fn(ProbePoint) -> Option<Illuminance> + Sync)| {
            let read = GridValues::read(grid.clone(), (scene, reader), read);
            read.expect("a grid without problems has a normal")
        };
        let read = values(&|at| asked.read(reader, at));
        let modelling = asked
            .is_modelling()
            .then(|| Modelling::of(&read, &values(&|at| asked.horizontal(reader, at))));
        let on_surface =
            |&position: &Point| reader.is_on_surface(ProbePoint { position, normal: read.normal });
        let in_space = !(asked.is_planar() && read.points.iter().all(on_surface));
        let outside = Outside::of(&read, reader);
        Self { read, in_space, outside, modelling }
    }
}
