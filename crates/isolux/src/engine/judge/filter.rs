//! The noise filter: a Wiener filter on the mesh.
//!
//! The detail of a vertex is its difference from the mean about it. Replicates give the detail that noise
//! alone would show. The squared excess of a detail, pooled over the neighbours, is signal, and the share of
//! signal is kept of each detail. So noise falls where light is smooth and edges stay. As replicates
//! accumulate, every detail becomes signal: the filter switches itself off, as that of Inspirer did (Kopylov,
//! Khodulev, Volevich 1998).
//!
//! * It never reaches over creases, borders or hidden vertices, since elements do not.
//! * In rooms light bends one way nearly everywhere, so the details taken off have one sign. Each piece of
//!   surface gets its mean loss back, spread evenly over its smoothed parts.
//! * The control variate (`behind`) has no noise; only the difference from it is filtered.
//! * Standard errors stay those of the unfiltered values.

use crate::engine::mesh::Range;
use crate::engine::plan::Plan;
use crate::map::FilterReport;
use crate::units::Rgb;

/// The number of passes; each smooths over one more ring of neighbours.
const PASSES: usize = 4;

/// The weights of the mean about every vertex, over itself and its neighbours; each row sums to one.
struct Means {
    rows: Vec<Vec<(u32, f64)>>,
}

/// Filtered values, and a report of the filter.
pub(crate) struct Filtered {
    /// Colour quantities, in the order given, filtered.
    pub(crate) values: Vec<Vec<Rgb>>,
    pub(crate) report: FilterReport,
}

/// Filters `parts`, colour quantities at the vertices that indirect light lives on, by the photometric sum of
/// all of them and its variance. The first part is indirect light.
pub(crate) fn filter(
    plan: &Plan,
    parts: &[Vec<Rgb>],
    variance: &[f64],
    reference_lx: f64,
) -> Filtered {
    let (elements, areas_m2) = acts_on(plan);
    let means = Means::of(plan, elements);
    let pieces = means.pieces();
    let behind = means.behind(plan, &pieces);
    let mut parts = parts.to_vec();
    parts[0].iter_mut().zip(&behind).for_each(|(value, &behind)| *value = *value - behind);
    let mut values = parts.clone();
    let mut variance = variance.to_vec();
    let (mut smoothed_m2, mut bias, mut first) = (0.0, 0.0, Vec::new());
    for pass in 0..PASSES {
        let total: Vec<f64> = (0..variance.len())
            .map(|k| values.iter().map(|part| part[k].luminance()).sum())
            .collect();
        let kept = means.shares_of_signal(&total, &variance);
        if pass == 0 {
            (smoothed_m2, bias) = smoothing(&areas_m2, &kept);
            first = kept.iter().map(|k| 1.0 - k.share).collect();
        }
        for part in &mut values {
            *part = means.shrink(part, &kept);
        }
        variance = means.noise_left(&variance, &kept);
    }
    for (filtered, part) in values.iter_mut().zip(&parts) {
        give_back(&areas_m2, (&pieces, &first), filtered, part);
    }
    values[0].iter_mut().zip(&behind).for_each(|(value, &behind)| *value += behind);
    parts[0].iter_mut().zip(&behind).for_each(|(value, &behind)| *value += behind);
    for (filtered, part) in values.iter_mut().zip(&parts) {
        means.hold(filtered, part);
        // The light that `hold` took is given back in proportion to the light, so none becomes negative.
        let light = first.iter().zip(&*filtered).map(|(share, value)| share * value.luminance());
        give_back(&areas_m2, (&pieces, &light.collect::<Vec<f64>>()), filtered, part);
    }
    let bias = if reference_lx > 0.0 { bias / reference_lx } else { 0.0 };
    Filtered { values, report: FilterReport { share: smoothed_m2, bias } }
}

/// The elements that the filter acts on, and the area of every vertex, m2. Where light is resolved towards
/// walls, these are the elements that carry light; the others have no noise of their own.
fn acts_on(plan: &Plan) -> (Vec<u32>, Vec<f64>) {
    let vertices = &plan.mesh.elements.vertices()[..plan.mesh.indirect_vertices];
    (plan.mesh.subdivision.leaves().collect(), vertices.iter().map(|v| v.area_m2).collect())
}

/// The share of signal in a detail, and the square of the signal, lx2.
#[derive(Clone, Copy, Debug)]
struct Kept {
    share: f64,
    signal: f64,
}

impl Means {
    /// The means over elements of open vertices, weighted by the overlap of hat functions.
    fn of(plan: &Plan, elements: Vec<u32>) -> Self {
        let mut rows: Vec<Vec<(u32, f64)>> = vec![Vec::new(); plan.mesh.indirect_vertices];
        for leaf in elements {
            let corners = plan.mesh.subdivision.node(leaf).0.vertices;
            if !corners.iter().all(|&v| plan.is_open(v)) {
                continue;
            }
            let sixth = plan.mesh.subdivision.triangle(leaf).area() / 6.0;
            for &i in &corners {
                for &j in &corners {
                    let overlap = if i == j { sixth } else { 0.5 * sixth };
                    match rows[i as usize].iter_mut().find(|(vertex, _)| *vertex == j) {
                        Some((_, weight)) => *weight += overlap,
                        None => rows[i as usize].push((j, overlap)),
                    }
                }
            }
        }
        for (vertex, row) in rows.iter_mut().enumerate() {
            let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
            if sum > 0.0 {
                row.iter_mut().for_each(|(_, weight)| *weight /= sum);
            } else {
                row.push((vertex as u32, 1.0));
            }
        }
        Self { rows }
    }

    /// The light of the control variate at vertices, which has no noise and nearly all of the details. It is
    /// black on pieces of surface where some vertices do not know theirs.
    fn behind(&self, plan: &Plan, pieces: &[u32]) -> Vec<Rgb> {
        let of = |k: usize| plan.mesh.gatherers[k].behind;
        let mut is_known = vec![true; self.rows.len()];
        for (k, _) in self.rows.iter().enumerate().filter(|(_, row)| row.len() > 1) {
            is_known[pieces[k] as usize] &= of(k).is_some();
        }
        let behind = |k: usize| of(k).filter(|_| is_known[pieces[k] as usize]);
        (0..self.rows.len()).map(|k| behind(k).unwrap_or(Rgb::BLACK)).collect()
    }

    /// The first vertex of the connected piece that each vertex belongs to.
    fn pieces(&self) -> Vec<u32> {
        let mut pieces = vec![u32::MAX; self.rows.len()];
        let mut waiting = Vec::new();
        for first in 0..self.rows.len() {
            waiting.push(first as u32);
            while let Some(vertex) = waiting.pop() {
                let piece = &mut pieces[vertex as usize];
                if *piece == u32::MAX {
                    *piece = first as u32;
                    waiting.extend(self.rows[vertex as usize].iter().map(|(next, _)| next));
                }
            }
        }
        pieces
    }

    /// Clamps filtered values to the range of the unfiltered values about them, so that the light given back
    /// to pieces makes no new extremes. Vertices that do not carry light have a larger neighbourhood.
    fn hold(&self, filtered: &mut [Rgb], before: &[Rgb]) {
        let held = |(k, &value): (usize, &Rgb)| {
            let mut range = Range::of(before[k]);
            self.rows[k].iter().for_each(|&(v, _)| range.include(before[v as usize]));
            range.hold(value)
        };
        let held: Vec<Rgb> = filtered.iter().enumerate().map(held).collect();
        filtered.copy_from_slice(&held);
    }

    fn mean(&self, vertex: usize, value: impl Fn(usize) -> f64) -> f64 {
        self.rows[vertex].iter().map(|&(j, weight)| weight * value(j as usize)).sum()
    }

    fn shares_of_signal(&self, values: &[f64], variance: &[f64]) -> Vec<Kept> {
        let detail = |i: usize| values[i] - self.mean(i, |j| values[j]);
        let noise = |i: usize| -> f64 {
            let own = |j: u32, weight: f64| if j as usize == i { 1.0 - weight } else { -weight };
            let part = |&(j, weight): &(u32, f64)| {
                let factor = own(j, weight);
                factor * factor * variance[j as usize]
            };
            self.rows[i].iter().map(part).sum()
        };
        let noise: Vec<f64> = (0..values.len()).map(noise).collect();
        let excess: Vec<f64> =
            (0..values.len()).map(|i| detail(i) * detail(i) - noise[i]).collect();
        let once: Vec<f64> = (0..values.len()).map(|i| self.mean(i, |j| excess[j])).collect();
        let kept = |i: usize| {
            // The excess is pooled over two rings, and what noise alone may cause of it is no signal: half of the
            // variance, sqrt(2 / 8), the standard deviation of the mean of about eight squared normal numbers.
            let pooled = self.mean(i, |j| once[j]);
            let signal = (pooled - 0.5 * noise[i]).max(0.0);
            let both = signal + noise[i];
            Kept { share: if both > 0.0 { signal / both } else { 1.0 }, signal }
        };
        (0..values.len()).map(kept).collect()
    }

    fn shrink(&self, values: &[Rgb], kept: &[Kept]) -> Vec<Rgb> {
        let one = |i: usize| {
            let mean: Rgb =
                self.rows[i].iter().map(|&(j, weight)| values[j as usize] * weight).sum();
            mean + (values[i] - mean) * kept[i].share
        };
        (0..values.len()).map(one).collect()
    }

    fn noise_left(&self, variance: &[f64], kept: &[Kept]) -> Vec<f64> {
        let one = |i: usize| {
            let part = |&(j, weight): &(u32, f64)| {
                let own = if j as usize == i { kept[i].share } else { 0.0 };
                let factor = weight * (1.0 - kept[i].share) + own;
                factor * factor * variance[j as usize]
            };
            self.rows[i].iter().map(part).sum()
        };
        (0..variance.len()).map(one).collect()
    }
}

/// Gives every piece of surface the light that the filter took from it, in proportion to the weights of its
/// vertices.
fn give_back(
    areas_m2: &[f64],
    (pieces, weights): (&[u32], &[f64]),
    filtered: &mut [Rgb],
    unfiltered: &[Rgb],
) {
    let mut lost = vec![(Rgb::BLACK, 0.0); filtered.len()];
    for (k, &own_m2) in areas_m2.iter().enumerate() {
        let of_piece = &mut lost[pieces[k] as usize];
        of_piece.0 += (unfiltered[k] - filtered[k]) * own_m2;
        of_piece.1 += weights[k] * own_m2;
    }
    for (k, value) in filtered.iter_mut().enumerate() {
        let (flux_lm, weights_m2) = lost[pieces[k] as usize];
        if weights_m2 > 0.0 {
            *value += flux_lm * (weights[k] / weights_m2);
        }
    }
}

/// The share of the surface where less than half of the detail is kept, and the signal that may be lost, root
/// mean square in lx.
fn smoothing(areas_m2: &[f64], kept: &[Kept]) -> (f64, f64) {
    let (mut area, mut smoothed, mut lost) = (0.0, 0.0, 0.0);
    for (&own_m2, k) in areas_m2.iter().zip(kept) {
        area += own_m2;
        if k.share < 0.5 {
            smoothed += own_m2;
        }
        lost += own_m2 * (1.0 - k.share) * (1.0 - k.share) * k.signal;
    }
    if area > 0.0 { (smoothed / area, (lost / area).sqrt()) } else { (0.0, 0.0) }
}
