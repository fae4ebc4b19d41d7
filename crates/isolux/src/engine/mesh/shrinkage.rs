//! Detail coefficients reduced by their noise before refinement uses them.

use crate::elements::Elements;

/// The reduction of a detail, in its standard errors: noise exceeds it in one case of twenty.
const SIGMAS: f64 = 2.0;

/// Values at vertices with all details reduced towards zero by their noise (soft thresholds: Donoho 1995), coarse
/// ones first; `variances` are those of the values. Values without noise stay unchanged.
pub(crate) fn beyond_noise(
    elements: &Elements,
    values: &[Option<f64>],
    variances: &[f64],
) -> Vec<Option<f64>> {
    let mut shrunk = values.to_vec();
    for (k, vertex) in elements.vertices().iter().enumerate().take(values.len()) {
        let Some(ends) = vertex.parents.map(|ends| ends.map(|end| end as usize)) else { continue };
        let [of_a, of_b] = ends.map(|end| variances[end]);
        let error = (variances[k] + 0.25 * (of_a + of_b)).sqrt();
        if let (Some(value), [Some(a), Some(b)]) = (values[k], ends.map(|end| shrunk[end]))
            && error > 0.0
        {
            let detail = value - 0.5 * (a + b);
            let left = (detail.abs() - SIGMAS * error).max(0.0).copysign(detail);
            shrunk[k] = Some(0.5 * (a + b) + left);
        }
    }
    shrunk
}
