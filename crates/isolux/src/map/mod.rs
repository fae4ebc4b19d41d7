//! Illumination maps: plain values.

mod grid;
mod illuminance;
mod provenance;
mod standing;

pub use grid::{Figure, GridFigures};
pub use illuminance::Illuminance;
pub use provenance::{Accuracy, FilterReport, Fresh, Method, Provenance};
pub use standing::Standing;

use crate::elements::Elements;

/// The illuminance on every surface of a scene, with its standard error: a value for every vertex
/// of the elements, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct IlluminationMap {
    /// The subdivided surfaces.
    pub elements: Elements,
    /// One a vertex of `elements`; `None` where it is not known (hidden inside other geometry, or
    /// too few samples).
    pub values: Vec<Option<Illuminance>>,
    /// Where it came from and how good it is.
    pub provenance: Provenance,
}

impl IlluminationMap {
    /// The map at barycentric weights `(1 - u - v, u, v)` of a triangle of the scene, on one side:
    /// linear over the element there, over those of its vertices that are known and of the highest
    /// standing. `None` where the
    /// side carries no map or none of them is known.
    pub fn interpolate(&self, triangle: u32, back: bool, u: f64, v: f64) -> Option<Illuminance> {
        let corners = self.elements.locate(triangle, back, u, v)?;
        Illuminance::mix(corners.map(|(vertex, weight)| (self.values[vertex as usize], weight)))
    }
}
