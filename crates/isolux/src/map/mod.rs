//! Illumination maps: plain values.

mod audit;
mod energy;
mod figure;
mod grid;
mod hot_spots;
mod illuminance;
mod provenance;
mod standing;
mod vertex_light;

pub use audit::{Audit, AuditTrust, AuditedError, AuditedPlace, AuditedReadings, AuditedSurface};
pub use energy::{EnergyBalance, MeasuredFlux, SurfaceBalance};
pub use figure::{Figure, NORMAL_95, Verdict};
pub use grid::GridFigures;
pub use hot_spots::{HotSpots, KnownSurface};
pub use illuminance::Illuminance;
pub use provenance::{Accuracy, FilterReport, Fresh, Method, MixedPart, Provenance, Unshot};
pub use standing::Standing;
pub use vertex_light::VertexLight;

use crate::elements::Elements;
use crate::units::Rgb;

/// The illuminance on every surface of a scene, with its standard error: a value for every vertex
/// of the elements, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct IlluminationMap {
    /// The subdivided surfaces.
    pub elements: Elements,
    /// One a vertex of `elements`; `None` where it is not known (hidden inside other geometry, or
    /// too few samples).
    pub values: Vec<Option<VertexLight>>,
    /// Where it came from and how good it is.
    pub provenance: Provenance,
}

impl IlluminationMap {
    /// The map at barycentric weights `(1 - u - v, u, v)` of a triangle of the scene, on one side:
    /// linear over the element there, over those of its vertices that are known and of the highest
    /// standing, with the ambient term. `None` where the
    /// side carries no map or none of them is known.
    pub fn interpolate(&self, triangle: u32, back: bool, u: f64, v: f64) -> Option<Illuminance> {
        let corners = self.elements.locate(triangle, back, u, v)?;
        let values = corners.map(|(vertex, weight)| (self.values[vertex as usize], weight));
        VertexLight::mix(values).map(|found| self.with_ambient(found).into())
    }

    /// The light of a vertex as readers have it: with the ambient term.
    pub fn read_at_vertex(&self, vertex: u32) -> Option<VertexLight> {
        self.values[vertex as usize].map(|stored| self.with_ambient(stored))
    }

    fn with_ambient(&self, stored: VertexLight) -> VertexLight {
        let doubt_lx = self.ambient_doubt_lx();
        let with = |error_lx: f64| libm::hypot(error_lx, doubt_lx);
        VertexLight {
            indirect_lx: stored.indirect_lx + self.ambient_lx(),
            standard_error_lx: with(stored.standard_error_lx),
            indirect_standard_error_lx: with(stored.indirect_standard_error_lx),
            ..stored
        }
    }

    /// The share of all light on the known surface that comes by specular ways without virtual luminaires.
    pub fn caustic_share(&self) -> f64 {
        let (mut caustic, mut all) = (0.0, 0.0);
        for (vertex, value) in self.elements.vertices().iter().zip(&self.values) {
            let Some(value) = value else { continue };
            caustic += vertex.area_m2 * value.caustic_lx.luminance();
            all += vertex.area_m2 * value.illuminance_lx();
        }
        if all > 0.0 { caustic / all } else { 0.0 }
    }

    /// Whether it is better known how the light is here than in another map of the same scene: its error is smaller, one that is known being
    /// smaller than one that is not; where both are alike, it has more increments, or as many of more receivers.
    pub fn knows_more_than(&self, other: &Self) -> bool {
        let known = |map: &Self| {
            let Provenance { accuracy, increments, .. } = &map.provenance;
            let error = accuracy.map_or(f64::INFINITY, |accuracy| accuracy.reached);
            (error, *increments, map.values.len())
        };
        let ((own, increments, receivers), (others, of_others, receivers_of_others)) =
            (known(self), known(other));
        own < others || own == others && (increments, receivers) > (of_others, receivers_of_others)
    }

    /// What stands in place of indirect light that was not computed, the same everywhere; readers add
    /// it to the values of vertices, lx.
    pub fn ambient_lx(&self) -> Rgb {
        self.provenance.unshot.map_or(Rgb::BLACK, |unshot| unshot.ambient_lx)
    }

    /// The standard error of readings for that, lx.
    pub fn ambient_doubt_lx(&self) -> f64 {
        self.provenance.unshot.map_or(0.0, |unshot| unshot.doubt_lx)
    }
}
