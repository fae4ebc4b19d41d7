//! The error of the scene, from replicates, check points and details.

use super::check_points::InterpolationErrors;
use crate::elements::Elements;
use crate::engine::gather::OF_INTERPOLATED;
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Estimate};
use crate::map::{Accuracy, Standing};
use rayon::prelude::*;

/// The number of replicates from which their spread is reported. The scene figure pools thousands of
/// receivers, so eight replicates give it to a few per cent.
pub(crate) const BELIEVED_INCREMENTS: u64 = 8;

/// The number of increments from which elements may be found too coarse. The spread of fewer says little at
/// check points.
pub(crate) const FEWEST_TO_MISS: u64 = 4;

/// The most that the reference of relative errors may be, in multiples of the mean over the lit area. The
/// reference is the root mean square of the light: 1.13 times the mean in CUBE, 1.23 in the hall, 1.93 with a
/// lamp 30 cm below a ceiling (decision 40). Below a ceiling with a lamp close to it, a hand's breadth can
/// have a hundred times the root mean square of all else.
const MOST_REFERENCE_RATIO: f64 = 2.0;

/// The number of vertices that one task sums.
const TASK_VERTICES: usize = 1024;

/// The error of the scene so far, from any number of replicates. `None` where it is unknown: the light of
/// paths given up may exceed all that was found.
pub(crate) fn accuracy(
    plan: &Plan,
    pooled: &Pooled,
    interpolation: &InterpolationErrors,
) -> Option<Accuracy> {
    let noise_lx =
        interpolation.noise_lx.unwrap_or((pooled.variance / pooled.light.area_m2).sqrt());
    in_all(plan, (pooled, noise_lx), interpolation)
}

/// The error of a map without replicates. Differences at check points include the noise of vertex values, so
/// the noise is subtracted from them and reported apart.
pub(crate) fn accuracy_of_map(
    plan: &Plan,
    estimate: impl Fn(usize) -> Estimate + Sync,
    seen: &InterpolationErrors,
) -> Option<Accuracy> {
    let pooled = Pooled::of(plan, estimate);
    let noise_lx = (OF_INTERPOLATED * pooled.variance / pooled.light.area_m2).sqrt();
    let beyond = |lx: f64| (lx * lx - noise_lx * noise_lx).max(0.0).sqrt();
    let rest = InterpolationErrors {
        indirect_lx: beyond(seen.indirect_lx),
        total_lx: beyond(seen.total_lx),
        ..*seen
    };
    in_all(plan, (&pooled, noise_lx), &rest)
}

fn in_all(
    plan: &Plan,
    (pooled, noise_lx): (&Pooled, f64),
    interpolation: &InterpolationErrors,
) -> Option<Accuracy> {
    let Light { area_m2: area, lit_m2, squared, .. } = pooled.light;
    if !(squared > 0.0 && area > 0.0) {
        // A map without light is exact if no path was given up and the pilot found no light.
        let dark = area > 0.0 && plan.light.reference_lx == 0.0 && interpolation.given_up_lx == 0.0;
        return dark.then_some(NO_ERROR);
    }
    let reference_lx = pooled.light.reference_lx();
    // Errors of one sign lie where light is: their root mean square over all of the surface is the mean over
    // `lit`.
    let lit = (lit_m2 / area).sqrt();
    let given_up = given_up_share(plan, interpolation.given_up_lx, reference_lx) / lit;
    if given_up > 1.0 {
        return None;
    }
    let statistical = noise_lx / reference_lx;
    let of_readers = interpolation.close * interpolation.untrusted_lx;
    let discretization = libm::hypot(interpolation.indirect_lx, of_readers) / reference_lx;
    // Check points measure the error of indirect light as rays read it. If rays read direct light, too, the
    // reflected part of its mean error is added.
    let is_read = plan.lighting.are_read_at_ends();
    let direct_lx = if is_read { interpolation.direct_mean_lx } else { 0.0 };
    let mean_lx = interpolation.indirect_mean_lx + plan.light.mean_reflectance * direct_lx;
    // The mean error of what rays read is reflected again and again. It has one sign, so it may correlate with the
    // mean error at the place that is read, which is counted already.
    let rho = plan.light.mean_reflectance.min(0.99);
    let reflected = rho * mean_lx / (1.0 - rho) / reference_lx / lit;
    let bias_beside = |read_lx: f64| {
        let alike = (2.0 * reflected / lit * read_lx / reference_lx).max(0.0);
        (reflected * reflected + alike).sqrt() + given_up
    };
    let bias = bias_beside(interpolation.trusted_mean_lx);
    let bias_of_bare_map = bias_beside(mean_lx);
    let root = |parts: &[f64]| parts.iter().map(|p| p * p).sum::<f64>().sqrt();
    Some(Accuracy {
        reached: root(&[statistical, discretization, bias]),
        statistical,
        discretization,
        caustics: interpolation.caustics_lx / reference_lx,
        bias,
        interpolated: root(&[statistical, interpolation.total_lx / reference_lx, bias_of_bare_map]),
    })
}

/// The statistical error alone, from two replicates on, relative. It is too uncertain to report, but good
/// enough to forecast when a run may end.
pub(crate) fn early_statistical(plan: &Plan, sums: &Accumulator) -> Option<f64> {
    let Pooled { light, variance } = Pooled::of(plan, |k| sums.estimate(k));
    (sums.increments >= 2 && light.squared > 0.0)
        .then(|| (variance / light.area_m2).sqrt() / light.reference_lx())
}

/// Integrals of light over a surface.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Light {
    area_m2: f64,
    /// The area with light, m2.
    lit_m2: f64,
    flux_lm: f64,
    squared: f64,
}

impl Light {
    /// The light of a surface that is lit everywhere.
    pub(crate) const fn of(area_m2: f64, flux_lm: f64, squared: f64) -> Self {
        Self { area_m2, lit_m2: area_m2, flux_lm, squared }
    }

    /// The light of the known surface.
    pub(crate) fn of_vertices(
        elements: &Elements,
        standings: &[Option<Standing>],
        lx: impl Fn(usize) -> f64,
    ) -> Self {
        let mut light = Self::default();
        let vertices = elements.vertices().iter().enumerate();
        vertices
            .filter(|&(k, _)| standings[k].is_some())
            .for_each(|(k, vertex)| light.add(vertex.area_m2, lx(k)));
        light
    }

    pub(crate) fn add(&mut self, area_m2: f64, lx: f64) {
        self.area_m2 += area_m2;
        self.lit_m2 += if lx == 0.0 { 0.0 } else { area_m2 };
        self.flux_lm += area_m2 * lx;
        self.squared += area_m2 * lx * lx;
    }

    fn with(self, other: Self) -> Self {
        Self {
            area_m2: self.area_m2 + other.area_m2,
            lit_m2: self.lit_m2 + other.lit_m2,
            flux_lm: self.flux_lm + other.flux_lm,
            squared: self.squared + other.squared,
        }
    }

    /// The reference of relative errors, lx; zero where there is no light.
    pub(crate) fn reference_lx(&self) -> f64 {
        if self.squared > 0.0 {
            (self.squared / self.area_m2)
                .sqrt()
                .min(MOST_REFERENCE_RATIO * self.flux_lm / self.lit_m2)
        } else {
            0.0
        }
    }
}

/// Light and variance of the mean, integrated over the known vertices.
#[derive(Default)]
pub(crate) struct Pooled {
    light: Light,
    variance: f64,
}

impl Pooled {
    pub(crate) fn of(plan: &Plan, estimate: impl Fn(usize) -> Estimate + Sync) -> Self {
        let vertices = plan.mesh.elements.vertices();
        let part = |start: usize| {
            let mut pooled = Self::default();
            let end = vertices.len().min(start + TASK_VERTICES);
            for k in (start..end).filter(|&k| plan.mesh.standings[k].is_some()) {
                pooled.add(vertices[k].area_m2, &estimate(k));
            }
            pooled
        };
        let starts = (0..vertices.len()).into_par_iter().step_by(TASK_VERTICES);
        let parts: Vec<Self> = starts.map(part).collect();
        parts.into_iter().fold(Self::default(), Self::with)
    }

    fn add(&mut self, area_m2: f64, estimate: &Estimate) {
        let mean = &estimate.mean;
        let lx = (mean.direct + mean.caustic + mean.indirect).luminance();
        self.light.add(area_m2, lx);
        self.variance += area_m2 * estimate.variance;
    }

    fn with(self, other: Self) -> Self {
        Self { light: self.light.with(other.light), variance: self.variance + other.variance }
    }
}

/// The error of a map without light.
const NO_ERROR: Accuracy = Accuracy {
    reached: 0.0,
    statistical: 0.0,
    discretization: 0.0,
    caustics: 0.0,
    bias: 0.0,
    interpolated: 0.0,
};

/// The light of paths given up after all reflections, relative. By the energy balance, received flux is
/// emitted flux over absorptance; it is infinite where all light is reflected.
fn given_up_share(plan: &Plan, given_up_lx: f64, reference_lx: f64) -> f64 {
    if given_up_lx > 0.0 {
        given_up_lx / (1.0 - plan.light.mean_reflectance).max(0.0) / reference_lx
    } else {
        0.0
    }
}
