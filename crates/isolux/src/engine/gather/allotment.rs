//! The number of rays of each receiver.
//!
//! The error of a scene weights noise by area. Nets of n rays err like n^-o. The least noise for a given number of
//! rays then needs numbers that grow like the area of receivers to the power 1 / (1 + 2 o): the allocation of Neyman
//! (1934), for nets. Where objects are small and many, as in furnished rooms, this halves the number of rays.

use super::ray_trial::{FEWEST_UNJUDGED, NET_ORDER};
use crate::ablation::without;
use crate::elements::Subdivision;
use crate::engine::mesh::Carriers;

/// The largest number of halvings from the mean to the fewest rays of a receiver. The noise of small receivers is
/// then no more than six times the mean.
const MOST_HALVINGS: i32 = 3;
/// The largest number of doublings from the mean to the most rays of a receiver.
const MOST_DOUBLINGS: i32 = 2;

/// Steps per factor of two in the search for the numbers.
const STEPS_A_DOUBLING: i32 = 8;
/// The largest number of those steps in either direction.
const MOST_STEPS: i32 = 8 * STEPS_A_DOUBLING;

/// The surface that the light of each vertex stands for, m2: a third of its elements, and a share of the areas of the
/// vertices interpolated from it. Vertices that do not carry light have zero.
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

/// The rays of receivers that stand for these areas, as powers of two. The noise over the whole surface is no more
/// than with `mean` rays for each. Receivers without area get no rays.
pub(crate) fn allot(areas_m2: &[f64], mean: f64) -> Vec<u32> {
    let count = areas_m2.iter().filter(|&&m2| m2 > 0.0).count();
    let whole_m2: f64 = areas_m2.iter().sum();
    let mean_m2 = whole_m2 / count.max(1) as f64;
    let power = if without("ray-allotment") { 0.0 } else { 1.0 / (1.0 + 2.0 * NET_ORDER) };
    let log = |m2: f64| (m2 > 0.0).then(|| power * libm::log2(m2 / mean_m2));
    let logs: Vec<Option<f64>> = areas_m2.iter().map(|&m2| log(m2)).collect();
    let of_mean = libm::log2(mean.max(1.0));
    let (fewest, floor) = (FEWEST_UNJUDGED.ilog2() as i32, of_mean.floor() as i32);
    let low = (floor - MOST_HALVINGS).max(fewest.min(floor));
    let high = of_mean.ceil() as i32 + MOST_DOUBLINGS;
    let exponent = |log: f64, step: i32| {
        let wanted = of_mean + log + f64::from(step) / f64::from(STEPS_A_DOUBLING);
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
    // At the lowest step no receiver has more rays than the mean, at the highest none has fewer. Noise falls with
    // rays.
    let (mut too_few, mut enough) = (-MOST_STEPS - 1, MOST_STEPS);
    while enough - too_few > 1 {
        let middle = i32::midpoint(too_few, enough);
        if is_enough(middle) { enough = middle } else { too_few = middle }
    }
    let step = enough;
    logs.iter().map(|log| log.map_or(0, |log| 1 << exponent(log, step))).collect()
}

/// The largest number of rays where noise differs, in multiples of the mean.
const MOST_RAYS_FACTOR: f64 = 16.0;
/// The largest ratio of noise after to noise before for which new shares are worth it. Variances from four samples
/// each that differ by chance alone seem to leave nine tenths.
const WORTHWHILE_NOISE_RATIO: f64 = 0.7;

/// Rays shared out anew, with the noise before and after. Each variance counts as that of one ray and falls with more
/// rays like the noise of a net.
pub(crate) struct Shared {
    /// The rays of each receiver, powers of two or zero.
    pub(crate) rays: Vec<u32>,
    /// The noise after, root mean square over the surface, lx.
    pub(crate) left_lx: f64,
    /// The noise before, root mean square over the surface, lx.
    pub(crate) before_lx: f64,
}

/// Rays shared out by variance, lx2, measured with equally many rays for each receiver. The total is about that of
/// `allotted`: half of it stays as allotted by area, half goes where it reduces noise most. `None` if noise falls too
/// little.
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
    let most = MOST_RAYS_FACTOR * mean_of(allotted);
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
    (left_lx < WORTHWHILE_NOISE_RATIO * before_lx).then_some(Shared { rays, left_lx, before_lx })
}

/// The mean number of rays over receivers that have any.
pub(crate) fn mean_of(rays: &[u32]) -> f64 {
    let with = rays.iter().filter(|&&rays| rays > 0).count();
    rays.iter().map(|&rays| f64::from(rays)).sum::<f64>() / with.max(1) as f64
}
