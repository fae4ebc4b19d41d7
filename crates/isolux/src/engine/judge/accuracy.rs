//! How good a map is: the error of the scene from replicates, check points and details.

use super::check_points::InterpolationErrors;
use crate::elements::Elements;
use crate::engine::gather::OF_INTERPOLATED;
use crate::engine::plan::Plan;
use crate::engine::ray::{Accumulator, Estimate};
use crate::map::{Accuracy, Standing};
use rayon::prelude::*;

/// Replicates from which on their spread is believed. The scene figure pools thousands of
/// receivers, so eight give it to a few per cent.
pub(crate) const BELIEVED_INCREMENTS: u64 = 8;

/// Increments after which elements may be seen to be too coarse: the spread of fewer tells little of check points.
pub(crate) const FEWEST_TO_MISS: u64 = 4;

/// Errors are told relative to the root mean square of the light, but to no more than so many times its mean where there is any: of a
/// lamp close below a ceiling a hand's breadth of that can have a hundred times the root mean square of all else.
const MOST_UNEVEN: f64 = 2.0;

/// Vertices whose sums are added up by one task.
const POOLED_TOGETHER: usize = 1024;

/// The error of the scene so far, however few replicates there are; `None` where nothing is
/// known: what paths given up would have brought may be more than what is there.
pub(crate) fn accuracy(
    plan: &Plan,
    pooled: &Pooled,
    interpolation: &InterpolationErrors,
) -> Option<Accuracy> {
    let noise_lx =
        interpolation.noise_lx.unwrap_or((pooled.variance / pooled.light.area_m2).sqrt());
    in_all(plan, (pooled, noise_lx), interpolation)
}

/// The error of a map without replicates, of which check points tell all but what they do not see: the
/// noise of the values at the vertices is part of what they see.
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
        // No light at all is known exactly, if none was lost on the way and the pilot saw none.
        let dark = area > 0.0 && plan.light.reference_lx == 0.0 && interpolation.given_up_lx == 0.0;
        return dark.then_some(NO_ERROR);
    }
    let reference_lx = pooled.light.reference_lx();
    // What has one sign lies where light is: means over all of the surface are larger there.
    let lit = (lit_m2 / area).sqrt();
    let given_up = given_up_share(plan, interpolation.given_up_lx, reference_lx) / lit;
    if given_up > 1.0 {
        return None;
    }
    let statistical = noise_lx / reference_lx;
    let of_readers = interpolation.close * interpolation.untrusted_lx;
    let discretization = libm::hypot(interpolation.indirect_lx, of_readers) / reference_lx;
    // Check points see what their rays read of indirect light; direct light that is read, too, adds what
    // is reflected of its own error.
    let is_read = plan.lighting.are_read_at_ends();
    let direct_lx = if is_read { interpolation.direct_mean_lx } else { 0.0 };
    let mean_lx = interpolation.indirect_mean_lx + plan.light.mean_reflectance * direct_lx;
    // What lookups get wrong on the mean is reflected, and reflected again; all of it has one sign, and so may have
    // the mean of what is wrong where it is read, which is counted for itself already. Rays of vertices read all of it,
    // those of readers what is seen from afar: the larger counts. What differs from place to place has either sign and
    // is reflected as good as no more.
    let rho = plan.light.mean_reflectance.min(0.99);
    let of_each = [rho * mean_lx, interpolation.seen_mean_lx];
    let larger = if of_each[0].abs() > of_each[1].abs() { of_each[0] } else { of_each[1] };
    let reflected = larger / (1.0 - rho) / reference_lx / lit;
    let spread = interpolation.seen_spread_lx / reference_lx;
    let bias_beside = |read_lx: f64| {
        let alike = (2.0 * reflected / lit * read_lx / reference_lx).max(0.0);
        (reflected * reflected + alike + spread * spread).sqrt() + given_up
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

/// The statistical error alone, from two replicates on: not believed by anyone, but good enough to
/// say when a run may end.
pub(crate) fn early_statistical(plan: &Plan, sums: &Accumulator) -> Option<f64> {
    let Pooled { light, variance } = Pooled::of(plan, |k| sums.estimate(k));
    (sums.increments >= 2 && light.squared > 0.0)
        .then(|| (variance / light.area_m2).sqrt() / light.reference_lx())
}

/// The light of some surface: integrals over it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Light {
    area_m2: f64,
    /// Where there is light.
    lit_m2: f64,
    flux_lm: f64,
    squared: f64,
}

impl Light {
    /// Of a surface that is lit everywhere.
    pub(crate) const fn of(area_m2: f64, flux_lm: f64, squared: f64) -> Self {
        Self { area_m2, lit_m2: area_m2, flux_lm, squared }
    }

    /// Of the known surface.
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

    /// What errors are told relative to, lx: zero where there is no light.
    pub(crate) fn reference_lx(&self) -> f64 {
        if self.squared > 0.0 {
            (self.squared / self.area_m2).sqrt().min(MOST_UNEVEN * self.flux_lm / self.lit_m2)
        } else {
            0.0
        }
    }
}

/// Over the known vertices, weighted by area: the light and variances of its mean.
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
            let end = vertices.len().min(start + POOLED_TOGETHER);
            for k in (start..end).filter(|&k| plan.mesh.standings[k].is_some()) {
                pooled.add(vertices[k].area_m2, &estimate(k));
            }
            pooled
        };
        let starts = (0..vertices.len()).into_par_iter().step_by(POOLED_TOGETHER);
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

/// The light of paths given up, relative, once all surfaces have reflected it: by the balance of
/// light what arrives is what was sent over what is absorbed. Without bound where all is reflected.
fn given_up_share(plan: &Plan, given_up_lx: f64, reference_lx: f64) -> f64 {
    if given_up_lx > 0.0 {
        given_up_lx / (1.0 - plan.light.mean_reflectance).max(0.0) / reference_lx
    } else {
        0.0
    }
}
