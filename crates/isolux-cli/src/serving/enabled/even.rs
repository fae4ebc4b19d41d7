//! What is shown before any light is known.

use isolux::elements::Subdivision;
use isolux::lightmap::lit_area_m2;
use isolux::map::{IlluminationMap, Method, Provenance, VertexLight};
use isolux::scene::Scene;
use isolux::units::Rgb;

/// A map with the luminous flux of all luminaires spread evenly over all surfaces: nothing is known but how bright a scene
/// is about, so that standard errors are infinite.
pub(crate) fn even_light(scene: &Scene) -> IlluminationMap {
    let elements = Subdivision::new(scene).elements();
    let even_lx = scene.luminous_flux_lm() / lit_area_m2(scene).max(f64::MIN_POSITIVE);
    let even_lx = if even_lx.is_finite() { even_lx } else { 0.0 };
    let value = VertexLight {
        indirect_lx: Rgb::grey(even_lx),
        standard_error_lx: f64::INFINITY,
        indirect_standard_error_lx: f64::INFINITY,
        ..VertexLight::NOTHING
    };
    let values = vec![Some(value); elements.vertices().len()];
    let provenance = Provenance {
        scene: scene.name().to_owned(),
        scene_hash: scene.hash(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        method: Method::Hybrid,
        seed: 0,
        increments: 0,
        rays: 0,
        accuracy_target: None,
        complete: false,
        accuracy: None,
        fresh: None,
        filter: None,
        unshot: None,
        diffuse_only: false,
        audit: None,
        mixed: Vec::new(),
    };
    IlluminationMap { elements, values, provenance }
}
