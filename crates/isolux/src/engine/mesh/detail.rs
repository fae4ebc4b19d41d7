//! Detail coefficients of a function on the tree of bisections, which show where elements are too coarse.
//!
//! A vertex made by bisection has a detail coefficient (hierarchical surplus): its value minus the mean of the ends
//! of its edge. From level to level, a smooth quantity keeps a quarter of it, one with a kink a half, a shadow border
//! all of it. So details at the finest level tell the error of interpolation there.

use super::MIN_TASK_LENGTH;
use super::carriers::{Carriers, ERROR_OF_DETAIL, Told};
use crate::elements::{Elements, Subdivision};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The interpolation error of an element, root mean square, as a share of the error in its middle. A quadratic
/// function has a mean error of a twenty-fourth of its three second differences along the edges, of an eighteenth in
/// the middle, and a somewhat larger root mean square. A gap where only the vertices on the rim see light has all of
/// the error.
const ERROR_OF_MIDDLE: f64 = 0.9;

/// The longest edge on which a detail of an element was made, in longest edges of the element.
const RECENT_EDGE_RATIO: f64 = 2.9;

/// The error expected of an element.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct LeafError {
    pub(crate) node: u32,
    pub(crate) area_m2: f64,
    /// The root mean square error over the element, in the unit of the values.
    pub(crate) error: f64,
    /// The approximate mean difference of the values to their interpolation; zero where it is not known.
    pub(crate) excess: f64,
    /// Whether something stands close, so that readers gather there anyway.
    pub(crate) is_beset: bool,
    /// Whether readers gather there only because vertices farther apart than its own carry its light, or because it
    /// lies at the rim of something that stands closer to them.
    pub(crate) is_beset_afar: bool,
    /// The weight of its error relative to others: dim rooms beside bright ones are to be right, too.
    pub(crate) weight: f64,
    /// The weight of its error for dim places that see it; zero where that is no more.
    pub(crate) seen: f64,
}

impl LeafError {
    /// Whether its numbers can be those of an element.
    pub(crate) fn is_sound(&self) -> bool {
        let sizes = [self.area_m2, self.error, self.weight, self.seen];
        sizes.iter().all(|size| size.is_finite() && *size >= 0.0) && self.excess.is_finite()
    }

    /// The contribution to the squared error of the scene.
    pub(crate) fn squared(&self) -> f64 {
        let counted = self.weight * self.error;
        self.area_m2 * counted * counted
    }

    /// The error with the weight that it has for dim places that see it.
    pub(crate) fn seen_from_dim(&self) -> Self {
        Self { weight: self.seen, ..*self }
    }
}

/// A function on elements: its values at the vertices, `None` where these say nothing, and the vertices that carry
/// it.
pub(crate) struct Details<'a> {
    subdivision: &'a Subdivision,
    elements: &'a Elements,
    values: &'a [Option<f64>],
    carriers: &'a Carriers,
    told: Vec<Option<Told>>,
}

impl<'a> Details<'a> {
    /// The details of a function with these values.
    pub(crate) fn of(
        subdivision: &'a Subdivision,
        elements: &'a Elements,
        values: &'a [Option<f64>],
        carriers: &'a Carriers,
        is_beset: impl Fn(u32, f64) -> bool + Sync,
    ) -> Self {
        let told = carriers.told(values, is_beset);
        Self { subdivision, elements, values, carriers, told }
    }

    fn told_at(&self, vertex: u32) -> Option<Told> {
        self.told.get(vertex as usize).copied().flatten()
    }

    /// The errors of all elements: from details, or from values in the middle where there are none. `is_beset` tells
    /// whether something stands close to an element, so that readers gather there anyway. `is_hemmed` tells whether
    /// something stands so close to a vertex that it tells nothing at such a distance.
    pub(crate) fn leaf_errors(
        &self,
        in_the_middle: impl Fn(u32) -> Option<f64> + Sync,
        is_beset: impl Fn(u32) -> bool + Sync,
        is_hemmed: impl Fn(u32, f64) -> bool + Sync,
    ) -> Vec<LeafError> {
        let leaf = |node: u32| {
            let area_m2 = self.subdivision.triangle(node).area();
            let corners = self.subdivision.node(node).0.vertices;
            let (error, excess) = self.told_error(node).unwrap_or_else(|| {
                untold_error(corners.map(|v| self.values[v as usize]), in_the_middle(node))
            });
            let beset = is_beset(node);
            let edge_m = self.subdivision.longest_edge_m(node);
            let is_told = |v: u32| self.told_at(v).is_some_and(|told| told.is_beset);
            let is_beset_afar =
                !beset && corners.iter().any(|&v| is_told(v) || is_hemmed(v, edge_m));
            LeafError {
                node,
                area_m2,
                error,
                excess,
                is_beset: beset || is_beset_afar,
                is_beset_afar,
                weight: 1.0,
                seen: 0.0,
            }
        };
        let leaves: Vec<u32> = self.subdivision.leaves().collect();
        leaves.into_par_iter().with_min_len(MIN_TASK_LENGTH).map(leaf).collect()
    }

    /// The error of an element from its details, with the mean excess; `None` without details, or if vertices say
    /// nothing.
    pub(crate) fn told_error(&self, node: u32) -> Option<(f64, f64)> {
        let corners = self.subdivision.node(node).0.vertices;
        if corners.iter().any(|&v| self.values[v as usize].is_none()) {
            return None;
        }
        let reach = RECENT_EDGE_RATIO * self.subdivision.longest_edge_m(node);
        let of_corner = |v: u32| match self.told_at(v) {
            Some(told) => Some((told.error, 0.0)),
            None => self.detail(v, reach).map(|detail| told(ERROR_OF_DETAIL * detail)),
        };
        let greater = |a: (f64, f64), b: (f64, f64)| if b.0 > a.0 { b } else { a };
        corners.into_iter().filter_map(of_corner).reduce(greater)
    }

    /// The detail of a vertex made on an edge no longer than `reach_m`, or between carriers no farther apart.
    fn detail(&self, vertex: u32, reach_m: f64) -> Option<f64> {
        let vertices = self.elements.vertices();
        let Some(ends) = vertices[vertex as usize].parents else {
            let (detail, spacing_m) = self.carriers.detail(self.values, vertex)?;
            return (spacing_m <= reach_m).then_some(detail);
        };
        let [a, b] = ends.map(|end| vertices[end as usize].position);
        if (b - a).length() > reach_m {
            return None;
        }
        let [a, b] = ends.map(|end| self.values[end as usize]);
        Some(self.values[vertex as usize]? - 0.5 * (a? + b?))
    }

    /// The share of the error of all elements that a fit leaves, from the decrease of details between levels.
    /// Elements without details on two levels keep their errors.
    pub(crate) fn left_by_fit(&self, errors: &[LeafError]) -> f64 {
        let (mut newer, mut older) = (0.0, 0.0);
        let (mut told, mut untold) = (0.0, 0.0);
        for leaf in errors {
            let reach = RECENT_EDGE_RATIO * self.subdivision.longest_edge_m(leaf.node);
            let corners = self.subdivision.node(leaf.node).0.vertices;
            let levels = corners.iter().filter_map(|&vertex| {
                let ends = self.elements.vertices()[vertex as usize].parents?;
                let own = self.detail(vertex, reach)?.abs();
                let above = ends.iter().filter_map(|&end| self.detail(end, 2.0 * reach));
                Some((own, above.map(f64::abs).reduce(f64::max)?))
            });
            match levels.max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((own, above)) => {
                    newer += leaf.area_m2 * own * own;
                    older += leaf.area_m2 * above * above;
                    told += leaf.squared();
                }
                None => untold += leaf.squared(),
            }
        }
        if told + untold == 0.0 || older == 0.0 {
            return 1.0;
        }
        let shrinking = (newer / older).sqrt();
        // All error is left at a ratio of three quarters, between kinks and borders.
        let slope = (1.0 - SMOOTH_LEFT_SHARE) / (0.75 - SMOOTH_DETAIL_RATIO);
        let left = SMOOTH_LEFT_SHARE + (shrinking - SMOOTH_DETAIL_RATIO) * slope;
        let left = left.clamp(SMOOTH_LEFT_SHARE, 1.0);
        ((told * left * left + untold) / (told + untold)).sqrt()
    }
}

/// The error and the excess from a signed excess.
const fn told(excess: f64) -> (f64, f64) {
    (excess.abs(), excess)
}

/// The error and excess of an element without details.
fn untold_error(values: [Option<f64>; 3], in_the_middle: Option<f64>) -> (f64, f64) {
    let known: Vec<f64> = values.into_iter().flatten().collect();
    let Some(high) = known.iter().copied().reduce(f64::max) else { return (0.0, 0.0) };
    let low = known.iter().copied().fold(high, f64::min);
    // An element of the input has no detail: half of the range of its vertices stands for it.
    let of_range = 0.5 * ERROR_OF_DETAIL;
    match in_the_middle {
        Some(middle) => {
            let read = known.iter().sum::<f64>() / known.len() as f64;
            told(ERROR_OF_MIDDLE * (middle - read))
        }
        None if known.len() == 3 => (of_range * (high - low), 0.0),
        // Extrapolation over a vertex that says nothing is as uncertain as the value is large.
        None => (of_range * high, 0.0),
    }
}

/// The share of the interpolation error that a fit to the light over elements leaves, where light is smooth (a
/// parabola is 2.4 times as near).
const SMOOTH_LEFT_SHARE: f64 = 0.42;
/// The ratio of details between levels where light is smooth: on edges of half the length, second differences are a
/// quarter.
const SMOOTH_DETAIL_RATIO: f64 = 0.25;

/// The largest share of the squared error that one round of refinement removes by marking the worst elements (Dörfler
/// 1996).
pub(crate) const MARKED_SHARE: f64 = 0.75;

/// The limits of refinement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Refinement {
    /// The ratio to which the error of the scene is to fall.
    pub(crate) wanted: f64,
    /// The edge length below which elements are not bisected, m.
    pub(crate) least_edge_m: f64,
    pub(crate) max_vertices: usize,
}

/// Refines the worst elements, and returns whether there was anything to refine. Where vertices wait, these become
/// carriers. Otherwise an element is bisected twice, so that both directions are halved.
pub(crate) fn refine_worst(
    subdivision: &mut Subdivision,
    carriers: &mut Carriers,
    errors: &[LeafError],
    how_far: Refinement,
) -> bool {
    let Refinement { wanted, least_edge_m, max_vertices } = how_far;
    // No more elements are marked than needed if every error falls as expected: two bisections halve both directions.
    let left = SMOOTH_DETAIL_RATIO * SMOOTH_DETAIL_RATIO;
    let share = ((1.0 - wanted * wanted) / (1.0 - left)).clamp(0.0, MARKED_SHARE);
    let waits = |carriers: &Carriers, corners: [u32; 3]| {
        corners.into_iter().any(|vertex| !carriers.is_active(vertex))
    };
    let can_be = |e: &&LeafError| {
        e.error > 0.0
            && (waits(carriers, subdivision.node(e.node).0.vertices)
                || subdivision.longest_edge_m(e.node) > 2.0 * least_edge_m)
    };
    let mut worst: Vec<&LeafError> = errors.iter().filter(can_be).collect();
    // Ties are broken by node number, so that the mesh is the same on every machine.
    worst
        .par_sort_unstable_by(|a, b| b.squared().total_cmp(&a.squared()).then(a.node.cmp(&b.node)));
    let total: f64 = worst.iter().map(|e| e.squared()).sum();
    let (mut marked, mut any) = (0.0, false);
    let mut asked: Vec<u32> = Vec::new();
    for error in worst {
        if marked >= share * total {
            break;
        }
        let corners = subdivision.node(error.node).0.vertices;
        if waits(carriers, corners) {
            asked.extend(corners);
        } else if subdivision.size() < max_vertices {
            subdivision.bisect_twice(error.node);
        } else {
            continue;
        }
        marked += error.squared();
        any = true;
    }
    carriers.activate(&asked);
    any
}
