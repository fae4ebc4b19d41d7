//! Maps of light that is known.

use isolux::elements::Subdivision;
use isolux::geometry::{Normal, Point};
use isolux::map::{IlluminationMap, Method, Provenance, VertexLight};
use isolux::scene::Scene;

/// The map of a scene whose light is told at every vertex.
pub(crate) fn map(
    scene: &Scene,
    lit: impl Fn(Point, Normal) -> Option<VertexLight>,
) -> IlluminationMap {
    let elements = Subdivision::new(scene).elements();
    let values = elements.vertices().iter().map(|v| lit(v.position, v.normal)).collect();
    let provenance = Provenance {
        scene: scene.name().into(),
        scene_hash: scene.hash(),
        version: "0.1.0".into(),
        method: Method::Hybrid,
        seed: 1,
        increments: 8,
        rays: 1,
        accuracy_target: None,
        fresh: None,
        filter: None,
        unshot: None,
        diffuse_only: false,
        audit: None,
        mixed: Vec::new(),
        complete: true,
        accuracy: None,
    };
    IlluminationMap { elements, values, provenance }
}
