//! Noise of vertices, bounded below by that of their neighbours.
//!
//! Where few rays bring much of the light, as through a small opening or from a patch in the sun, all of them may
//! miss a vertex. It then shows too little light and too little noise, since its replicates agree. Its neighbours
//! have other rays and show the noise.

use crate::elements::Elements;
use crate::map::VertexLight;

/// The least variance of a vertex, as a share of the mean of its elements. By eight replicates one vertex in ten
/// shows less of its true variance.
pub(crate) const LEAST: f64 = 0.4;

/// Raises the noise of indirect light at each vertex to at least a share of the mean over the vertices of its
/// elements.
pub(crate) fn lend_noise(elements: &Elements, values: &mut [Option<VertexLight>]) {
    let variance =
        |value: &VertexLight| value.indirect_standard_error_lx * value.indirect_standard_error_lx;
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
