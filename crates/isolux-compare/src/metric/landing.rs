//! The balance of energy.

use isolux::geometry::Triangle;
use isolux::map::{IlluminationMap, VertexLight};
use isolux::scene::Scene;

/// The luminous flux that lands on the surfaces of a map, each time it is reflected anew, over that which luminaires emit; where no value is known the
/// mean of the known surface stands for it. `None` of a scene whose luminaires emit no finite flux, or of a map that knows nothing.
pub fn landed_over_emitted(scene: &Scene, map: &IlluminationMap) -> Option<f64> {
    let vertices = map.elements.vertices();
    let (mut area_m2, mut known_m2, mut flux_lm) = (0.0, 0.0, 0.0);
    for element in map.elements.elements() {
        let corners = element.vertices.map(|vertex| vertices[vertex as usize].position);
        let third_m2 = Triangle { corners }.area() / 3.0;
        area_m2 += 3.0 * third_m2;
        for value in element.vertices.iter().filter_map(|&vertex| map.read_at_vertex(vertex)) {
            known_m2 += third_m2;
            flux_lm += third_m2 * VertexLight::illuminance_lx(&value);
        }
    }
    let emitted_lm = scene.luminous_flux_lm();
    (known_m2 > 0.0 && emitted_lm > 0.0).then(|| flux_lm * area_m2 / known_m2 / emitted_lm)
}
