//! Deposits of flux on the vertices of a map.
//!
//! A particle gives its flux to the vertices of the element that it hits, weighted by their hat functions.
//! Divided by the integrals of the hats, this is a mean of the illuminance about each vertex. The mean is
//! biased where the illuminance bends, and more so at borders, where a hat has one side only. One step of Van
//! Cittert's deconvolution (twice the mean less the mean of the means) removes the first order of the bias
//! and gives its size.

use crate::engine::gather::known_weights;
use crate::engine::judge::InterpolationErrors;
use crate::engine::mesh::{Carriers, Details, HatFunctions};
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Estimate, SurfacePoint};
use crate::units::Rgb;
use std::sync::atomic::{AtomicI64, Ordering};

/// The number of fixed-point units of the flux of all particles of an increment. A particle deposits at most
/// its flux at every reflection; 2^14 times that flux, half of the range, would need a mean reflectance of
/// 0.9999.
const UNITS_OF_FLUX: f64 = (1u64 << 48) as f64;

/// The deposits of one increment, in integers, so that the order of the particles does not matter.
pub(crate) struct Tally<'p, 's> {
    plan: &'p Plan<'s>,
    hats: HatFunctions,
    parts: usize,
    units_per_lm: f64,
    flux: Vec<AtomicI64>,
    /// The flux in the checked parts of elements, all quantities together.
    came: Vec<AtomicI64>,
    given_up: AtomicI64,
}

impl<'p, 's> Tally<'p, 's> {
    /// A tally of `parts` separate quantities over the vertices that indirect light lives on.
    pub(crate) fn new(plan: &'p Plan<'s>, flux_lm: f64, parts: usize) -> Self {
        let zeros = |count: usize| (0..count).map(|_| AtomicI64::new(0)).collect();
        Self {
            plan,
            hats: hats(plan),
            parts,
            units_per_lm: UNITS_OF_FLUX / flux_lm,
            flux: zeros(plan.mesh.indirect_vertices * parts * 3),
            came: zeros(plan.errors.parts.count()),
            given_up: AtomicI64::new(0),
        }
    }

    /// Counts the flux of a particle that is given up.
    pub(crate) fn give_up(&self, flux_lm: Rgb) {
        let units = (flux_lm.luminance() * self.units_per_lm).round_ties_even() as i64;
        self.given_up.fetch_add(units, Ordering::Relaxed);
    }

    /// The illuminance of the flux given up, spread over all surfaces, lx.
    pub(crate) fn given_up_lx(&self) -> f64 {
        self.given_up.load(Ordering::Relaxed) as f64 / self.units_per_lm / self.plan.area_m2()
    }

    /// Deposits flux at a place.
    pub(crate) fn add(&self, part: usize, at: &SurfacePoint, flux_lm: Rgb) {
        let plan = self.plan;
        let place = plan.mesh.elements.place(plan.mesh.level, at.triangle, at.back, [at.u, at.v]);
        let Some(place) = place else { return };
        let corners = plan.mesh.elements.corners(place);
        let Some(weights) = known_weights(corners, &plan.mesh.standings) else { return };
        for ((vertex, _), weight) in corners.into_iter().zip(weights) {
            let first = (vertex as usize * self.parts + part) * 3;
            for (channel, value) in flux_lm.0.into_iter().enumerate() {
                let units = (value * weight * self.units_per_lm).round_ties_even() as i64;
                self.flux[first + channel].fetch_add(units, Ordering::Relaxed);
            }
        }
        if let Some(part) = plan.errors.parts.at(place.node(), corners.map(|(_, weight)| weight)) {
            let units = (flux_lm.luminance() * self.units_per_lm).round_ties_even() as i64;
            self.came[part].fetch_add(units, Ordering::Relaxed);
        }
    }

    /// The mean illuminance about every vertex, lx.
    pub(crate) fn means(&self, part: usize) -> Vec<Rgb> {
        let flux = |vertex: usize| {
            let first = (vertex * self.parts + part) * 3;
            let channel = |k: usize| self.flux[first + k].load(Ordering::Relaxed) as f64;
            Rgb([0, 1, 2].map(|k| channel(k) / self.units_per_lm))
        };
        self.hats.means((0..self.plan.mesh.indirect_vertices).map(flux))
    }

    /// The light that the vertices lack in the checked parts of elements, all quantities together, lx.
    pub(crate) fn lacking(&self, light: impl Fn(usize) -> Rgb) -> Vec<f64> {
        self.plan.errors.parts.lacking(
            |part| self.came[part].load(Ordering::Relaxed) as f64 / self.units_per_lm,
            |vertex| light(vertex as usize).luminance(),
            &self.plan.mesh.standings,
        )
    }

    /// The illuminance at the vertices after deconvolution, lx.
    pub(crate) fn illuminance(&self, part: usize) -> Vec<Rgb> {
        self.hats.corrected(&self.means(part))
    }
}

/// The hat functions of the elements that indirect light lives on.
fn hats(plan: &Plan) -> HatFunctions {
    HatFunctions::new(&plan.mesh.subdivision, &plan.mesh.standings)
}

/// The errors of a map of particles beyond its noise: the remaining blur and the interpolation error, both
/// less the part that noise explains. Elements whose parts are checked are left out.
pub(crate) fn errors(plan: &Plan, sums: &Accumulator) -> InterpolationErrors {
    let estimates: Vec<Estimate> =
        (0..plan.mesh.indirect_vertices).map(|k| sums.estimate(k)).collect();
    let indirect = |e: &Estimate| (e.mean.indirect + e.mean.caustic).luminance();
    let total = |e: &Estimate| indirect(e) + e.mean.direct.luminance();
    let indirect_lx = error_lx(plan, &estimates, indirect, |e| e.indirect_variance);
    let total_lx = error_lx(plan, &estimates, total, |e| e.variance);
    InterpolationErrors { indirect_lx, total_lx, ..InterpolationErrors::default() }
}

/// The root mean square error of a quantity at vertices beyond its noise, from blur and details, lx.
fn error_lx(
    plan: &Plan,
    estimates: &[Estimate],
    value: impl Fn(&Estimate) -> f64,
    variance: impl Fn(&Estimate) -> f64,
) -> f64 {
    let values: Vec<f64> = estimates.iter().map(value).collect();
    let variances: Vec<f64> = estimates.iter().map(variance).collect();
    (blur_squared(plan, &values, &variances) + detail_squared(plan, &values, &variances)).sqrt()
}

/// The mean square of the change that one more step of the deconvolution would make, lx2: the remaining blur.
fn blur_squared(plan: &Plan, values: &[f64], variances: &[f64]) -> f64 {
    let hats = hats(plan);
    let blurred = hats.blur(values);
    let is_checked = plan.errors.parts.vertices(values.len());
    let (mut area, mut sum) = (0.0, 0.0);
    for (k, &m2) in
        hats.areas_m2().iter().enumerate().filter(|&(k, _)| plan.mesh.standings[k].is_some())
    {
        let change = values[k] - blurred[k];
        area += m2;
        if is_checked[k] {
            continue;
        }
        // A vertex has half the weight in its own mean; its neighbours share the rest. So noise of
        // independent vertices contributes a quarter of the variance and a little more.
        sum += m2 * (change * change - 0.3 * variances[k]);
    }
    if area > 0.0 { (sum / area).max(0.0) } else { 0.0 }
}

/// The mean square interpolation error, from details, lx2.
fn detail_squared(plan: &Plan, values: &[f64], variances: &[f64]) -> f64 {
    let known: Vec<Option<f64>> =
        (0..values.len()).map(|k| plan.is_open(k as u32).then_some(values[k])).collect();
    let (mut area, mut sum) = (0.0, 0.0);
    // Particles reach all vertices, so all of them carry light.
    let (carriers, no) = (Carriers::all(), |_, _| false);
    let details = Details::of(&plan.mesh.subdivision, &plan.mesh.elements, &known, &carriers, no);
    for error in details.leaf_errors(|_| None, |_| false, |_, _| false) {
        let corners = plan.mesh.subdivision.node(error.node).0.vertices;
        let noise: f64 = corners.iter().map(|&v| variances[v as usize]).sum::<f64>() / 3.0;
        area += error.area_m2;
        if plan.errors.parts.has(error.node) {
            continue;
        }
        // A detail of three independent values has one and a half times their variance. The estimate takes
        // the square of 0.3 of that; the largest of three details is twice as large.
        sum += error.squared() - error.area_m2 * 0.27 * noise;
    }
    if area > 0.0 { (sum / area).max(0.0) } else { 0.0 }
}
