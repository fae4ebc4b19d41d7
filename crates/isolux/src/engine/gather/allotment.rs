//! Which receiver gets how many rays.
//!
//! The error of a scene counts noise by area. Nets of n rays err like n^-o, so that of all ways to spend rays the one
//! that leaves the least noise gives receivers a number that grows like their area to the power 1 / (1 + 2 o): the
//! allocation of Neyman (1934), for nets. Where objects are small and many, as in furnished rooms, half of the rays are left.

use super::ray_trial::NET_ORDER;
use crate::ablation::without;
use crate::elements::Subdivision;
use crate::engine::mesh::Carriers;

/// Powers of two that numbers of rays are apart from the mean at most, fewer and more: what is small errs by no more
/// than six times what errs in the mean.
const FEWER: i32 = 3;
const MORE: i32 = 2;

/// Rays of a receiver at least, as a power of two, unless the mean is lower.
const FEWEST: i32 = 3;

/// Steps to a factor of two in which the numbers are tried, and how many either way.
const STEPS: i32 = 8;
const MOST_STEPS: i32 = 8 * STEPS;

/// Surface that the light of every vertex is for, m2: a third of its elements, and its part of that of the vertices that
/// are interpolated from it. Vertices that do not carry light have none.
pub(crate) fn areas_m2(subdivision: &Subdivision, carriers: &Carriers) -> Vec<f64> {
    let mut areas_m2 = vec![0.0; subdivision.vertex_count()];
    for leaf in subdivision.leaves() {
        let third_m2 = subdivision.triangle(leaf).area() / 3.0;
        for vertex in subdivision.node(leaf).0.vertices {
            areas_m2[vertex as usize] += third_m2;
        }
    }
    carriers.hand_down(&mut areas_m2);
    areas_m2
}

/// Rays of receivers that stand for these areas, powers of two, such that the noise over all of it is no more than if
/// each of them had `mean` rays; none where there is no area.
pub(crate) fn allot(areas_m2: &[f64], mean: f64) -> Vec<u32> {
    let count = areas_m2.iter().filter(|&&m2| m2 > 0.0).count();
    let whole_m2: f64 = areas_m2.iter().sum();
    let mean_m2 = whole_m2 / count.max(1) as f64;
    let power = if without("ray-allotment") { 0.0 } else { 1.0 / (1.0 + 2.0 * NET_ORDER) };
    let log = |m2: f64| (m2 > 0.0).then(|| power * libm::log2(m2 / mean_m2));
    let logs: Vec<Option<f64>> = areas_m2.iter().map(|&m2| log(m2)).collect();
    let of_mean = libm::log2(mean.max(1.0));
    let low = ((of_mean.floor() as i32) - FEWER).max(FEWEST.min(of_mean.floor() as i32));
    let high = of_mean.ceil() as i32 + MORE;
    let exponent = |log: f64, step: i32| {
        let wanted = of_mean + log + f64::from(step) / f64::from(STEPS);
        (libm::round(wanted) as i32).clamp(low, high)
    };
    let noise = |exponent: f64| libm::exp2(-2.0 * NET_ORDER * exponent);
    let by_exponent: Vec<f64> = (0..=high).map(|e| noise(f64::from(e))).collect();
    let allowed = whole_m2 * noise(of_mean);
    let is_enough = |step: i32| {
        let of = |(&m2, log): (&f64, &Option<f64>)| {
            log.map_or(0.0, |log| m2 * by_exponent[exponent(log, step) as usize])
        };
        areas_m2.iter().zip(&logs).map(of).sum::<f64>() <= allowed
    };
    // With the fewest none has more than the mean, with the most none has fewer. The more rays, the less noise.
    let (mut too_few, mut enough) = (-MOST_STEPS - 1, MOST_STEPS);
    while enough - too_few > 1 {
        let middle = i32::midpoint(too_few, enough);
        if is_enough(middle) { enough = middle } else { too_few = middle }
    }
    let step = enough;
    logs.iter().map(|log| log.map_or(0, |log| 1 << exponent(log, step))).collect()
}

/// What others may have at most where noise differs, in multiples of the mean.
const MOST_TIMES: f64 = 16.0;
/// Noise that is left, of what there was, at most, or it is not worth it: variances of four samples each that are alike but for
/// chance seem to leave nine tenths.
const WORTH_IT: f64 = 0.7;

/// Rays shared out anew, and what noise that leaves, lx, if it falls with the rays as that of one does from one on; and what there was.
pub(crate) struct Shared {
    pub(crate) rays: Vec<u32>,
    pub(crate) left_lx: f64,
    pub(crate) before_lx: f64,
}

/// As many rays in all for receivers of such variances, lx2 with as many rays each, as they have been allotted by area: half of
/// them as they were, half where they leave the least noise. Nothing where that does not leave much less.
pub(crate) fn allot_by_noise(
    areas_m2: &[f64],
    variances_lx2: &[f64],
    allotted: &[u32],
) -> Option<Shared> {
    let weights: Vec<f64> = areas_m2.iter().zip(variances_lx2).map(|(m2, lx2)| m2 * lx2).collect();
    let shares = weights.iter().map(|w| libm::pow(*w, 1.0 / (1.0 + 2.0 * NET_ORDER)));
    let shares: Vec<f64> = shares.collect();
    let all: f64 = shares.iter().sum();
    let in_all: f64 = allotted.iter().map(|&rays| f64::from(rays)).sum();
    let most = MOST_TIMES * mean_of(allotted);
    let one = |(&rays_then, share): (&u32, &f64)| {
        let wanted = 0.5 * (f64::from(rays_then) + (in_all * share / all).min(most));
        if rays_then == 0 { 0 } else { libm::exp2(libm::round(libm::log2(wanted))) as u32 }
    };
    let rays: Vec<u32> = allotted.iter().zip(&shares).map(one).collect();
    let area_m2: f64 = areas_m2.iter().sum();
    let noise_lx = |rays: &[u32]| -> f64 {
        let with = weights.iter().zip(rays).filter(|(_, rays)| **rays > 0);
        let squared = with.map(|(w, &rays)| w * libm::pow(f64::from(rays), -2.0 * NET_ORDER));
        (squared.sum::<f64>() / area_m2).sqrt()
    };
    let (left_lx, before_lx) = (noise_lx(&rays), noise_lx(allotted));
    (left_lx < WORTH_IT * before_lx).then_some(Shared { rays, left_lx, before_lx })
}

/// How many rays that is for each receiver in the mean.
pub(crate) fn mean_of(rays: &[u32]) -> f64 {
    let with = rays.iter().filter(|&&rays| rays > 0).count();
    rays.iter().map(|&rays| f64::from(rays)).sum::<f64>() / with.max(1) as f64
}
