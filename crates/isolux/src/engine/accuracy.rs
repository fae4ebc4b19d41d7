//! How good a map is: the error of the scene from replicates, check points and details.

use super::accumulate::{Accumulator, Estimate};
use super::checks::InterpolationErrors;
use super::plan::Plan;
use super::trial::OF_INTERPOLATED;
use crate::map::Accuracy;
use rayon::prelude::*;

/// Replicates from which on their spread is believed. The scene figure pools thousands of
/// receivers, so eight give it to a few per cent.
pub(super) const BELIEVED_INCREMENTS: u64 = 8;

/// Increments after which elements may be seen to be too coarse: the spread of fewer tells little of check points.
pub(super) const FEWEST_TO_MISS: u64 = 4;

/// Vertices whose sums are added up by one task.
const POOLED_TOGETHER: usize = 1024;

/// The error of the scene so far, however few replicates there are; `None` where nothing is
/// known: what paths given up would have brought may be more than what is there.
pub(super) fn accuracy(
    plan: &Plan,
    pooled: &Pooled,
    interpolation: &InterpolationErrors,
) -> Option<Accuracy> {
    let noise_lx = interpolation.noise_lx.unwrap_or((pooled.variance / pooled.area_m2).sqrt());
    in_all(plan, (pooled, noise_lx), interpolation)
}

/// The error of a map without replicates, of which check points tell all but what they do not see: the
/// noise of the values at the vertices is part of what they see.
pub(super) fn accuracy_of_map(
    plan: &Plan,
    estimate: impl Fn(usize) -> Estimate + Sync,
    seen: &InterpolationErrors,
) -> Option<Accuracy> {
    let pooled = Pooled::of(plan, estimate);
    let noise_lx = (OF_INTERPOLATED * pooled.variance / pooled.area_m2).sqrt();
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
    let Pooled { area_m2: area, lit_m2, squared, .. } = *pooled;
    if !(squared > 0.0 && area > 0.0) {
        // No light at all is known exactly, if none was lost on the way and the pilot saw none.
        let dark = area > 0.0 && plan.rms_lx == 0.0 && interpolation.given_up_lx == 0.0;
        return dark.then_some(NO_ERROR);
    }
    let rms_lx = (squared / area).sqrt();
    // What has one sign lies where light is: means over all of the surface are larger there.
    let lit = (lit_m2 / area).sqrt();
    let given_up = given_up_share(plan, interpolation.given_up_lx, rms_lx) / lit;
    if given_up > 1.0 {
        return None;
    }
    let statistical = noise_lx / rms_lx;
    let of_readers = interpolation.close * interpolation.untrusted_lx;
    let discretization = libm::hypot(interpolation.indirect_lx, of_readers) / rms_lx;
    // Check points see what their rays read of indirect light; direct light that is read, too, adds what
    // is reflected of its own error.
    let is_read = plan.lighting.are_read_at_ends();
    let direct_lx = if is_read { interpolation.direct_mean_lx } else { 0.0 };
    let mean_lx = interpolation.indirect_mean_lx + plan.mean_reflectance * direct_lx;
    // What lookups get wrong on the mean is reflected, and reflected again; all of it has one sign, and so may have
    // the mean of what is wrong where it is read, which is counted for itself already. Rays of vertices read all of it,
    // those of readers what is seen from afar: the larger counts. What differs from place to place has either sign and
    // is reflected as good as no more.
    let rho = plan.mean_reflectance.min(0.99);
    let of_each = [rho * mean_lx, interpolation.seen_mean_lx];
    let larger = if of_each[0].abs() > of_each[1].abs() { of_each[0] } else { of_each[1] };
    let reflected = larger / (1.0 - rho) / rms_lx / lit;
    let spread = interpolation.seen_spread_lx / rms_lx;
    let bias_beside = |read_lx: f64| {
        let alike = (2.0 * reflected / lit * read_lx / rms_lx).max(0.0);
        (reflected * reflected + alike + spread * spread).sqrt() + given_up
    };
    let bias = bias_beside(interpolation.trusted_mean_lx);
    let bias_of_bare_map = bias_beside(mean_lx);
    let root = |parts: &[f64]| parts.iter().map(|p| p * p).sum::<f64>().sqrt();
    Some(Accuracy {
        reached: root(&[statistical, discretization, bias]),
        statistical,
        discretization,
        caustics: interpolation.caustics_lx / rms_lx,
        bias,
        interpolated: root(&[statistical, interpolation.total_lx / rms_lx, bias_of_bare_map]),
    })
}

/// The statistical error alone, from two replicates on: not believed by anyone, but good enough to
/// say when a run may end.
pub(super) fn early_statistical(plan: &Plan, sums: &Accumulator) -> Option<f64> {
    let Pooled { squared, variance, .. } = Pooled::of(plan, |k| sums.estimate(k));
    (sums.increments >= 2 && squared > 0.0).then(|| (variance / squared).sqrt())
}

/// Over the known vertices, weighted by area: squares of the light and variances of its mean.
#[derive(Default)]
pub(super) struct Pooled {
    area_m2: f64,
    /// Where there is light.
    lit_m2: f64,
    squared: f64,
    variance: f64,
}

impl Pooled {
    pub(super) fn of(plan: &Plan, estimate: impl Fn(usize) -> Estimate + Sync) -> Self {
        let vertices = plan.elements.vertices();
        let part = |start: usize| {
            let mut pooled = Self::default();
            let end = vertices.len().min(start + POOLED_TOGETHER);
            for k in (start..end).filter(|&k| plan.standings[k].is_some()) {
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
        self.area_m2 += area_m2;
        self.lit_m2 += if lx == 0.0 { 0.0 } else { area_m2 };
        self.squared += area_m2 * lx * lx;
        self.variance += area_m2 * estimate.variance;
    }

    fn with(self, other: Self) -> Self {
        Self {
            area_m2: self.area_m2 + other.area_m2,
            lit_m2: self.lit_m2 + other.lit_m2,
            squared: self.squared + other.squared,
            variance: self.variance + other.variance,
        }
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
fn given_up_share(plan: &Plan, given_up_lx: f64, rms_lx: f64) -> f64 {
    if given_up_lx > 0.0 {
        given_up_lx / (1.0 - plan.mean_reflectance).max(0.0) / rms_lx
    } else {
        0.0
    }
}
