//! Noise of vertices as those about them have it.
//!
//! Where few rays bring much of the light, as through a small opening or from a patch in the sun, a vertex that they have all missed
//! shows too little light and too little noise, as its replicates agree. Those about it, by other rays, know better.

use crate::elements::Elements;
use crate::map::Illuminance;

/// The least variance of a vertex, as a share of the mean of those of its elements. By eight replicates one vertex in ten shows less of
/// what it has.
pub(crate) const LEAST: f64 = 0.4;

/// Lets no vertex have less noise in its indirect light than a share of what the vertices of its elements have in the mean.
pub(crate) fn lend_noise(elements: &Elements, values: &mut [Option<Illuminance>]) {
    let variance =
        |value: &Illuminance| value.indirect_standard_error_lx * value.indirect_standard_error_lx;
    let own: Vec<Option<f64>> = values.iter().map(|v| v.as_ref().map(variance)).collect();
    let mut about = vec![(0.0, 0.0); values.len()];
    for element in elements.elements() {
        let known = element.vertices.map(|v| own[v as usize]);
        for vertex in element.vertices {
            let (sum, count) = &mut about[vertex as usize];
            *sum += known.iter().flatten().sum::<f64>();
            *count += known.iter().flatten().count() as f64;
        }
    }
    for ((value, own), (sum, count)) in values.iter_mut().zip(own).zip(about) {
        let Some((value, own)) = value.as_mut().zip(own).filter(|_| count > 0.0) else { continue };
        let least = own.max(LEAST * sum / count);
        let beside = value.standard_error_lx * value.standard_error_lx - own;
        value.indirect_standard_error_lx = least.sqrt();
        value.standard_error_lx = (beside.max(0.0) + least).sqrt();
    }
}
