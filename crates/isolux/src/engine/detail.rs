//! Where elements are too coarse: detail coefficients of a function on the tree of bisections.
//!
//! A vertex made by bisection has a detail coefficient: its value minus the mean of the ends of its
//! edge. A quantity that is smooth has a quarter of it at the next level, one with a kink a half, a
//! shadow border all of it. So details at the finest level tell the error that interpolation still
//! makes there.

use crate::elements::{Elements, Subdivision};

/// Root mean square of the linear interpolation error over an element, as a share of the detail of
/// its newest vertex. For a parabola across the edge the error at the middle of the next edge is a
/// quarter of the detail and the root mean square over the edge is 0.73 of that; kinks and shadow
/// borders, which come to matter as the rest is resolved, make it up to twice as much.
const ERROR_OF_DETAIL: f64 = 0.3;

/// The same for an element of the input, which has no detail, as a share of the spread of its
/// vertices: what a detail of half the spread would give.
const ERROR_OF_SPREAD: f64 = 0.15;

/// The same, as a share of what interpolation errs by in the middle. A quadratic function errs by a
/// twenty-fourth of its three second differences along the edges in the mean, by an eighteenth in the
/// middle, and somewhat more in the root mean square; a gap that only the vertices on its rim see
/// light from, by all of it.
const ERROR_OF_MIDDLE: f64 = 0.9;

/// A detail belongs to an element if the edge it was made on is at most so many times its own.
const RECENT: f64 = 2.9;

/// The error estimated for an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeafError {
    pub(super) node: u32,
    pub(super) area_m2: f64,
    /// Root mean square over the element, in the unit of the values.
    pub(super) error: f64,
    /// Whether readers gather there anyway, as something stands close.
    pub(super) is_beset: bool,
}

impl LeafError {
    /// Contribution to the squared error of the scene.
    pub(super) fn squared(&self) -> f64 {
        self.area_m2 * self.error * self.error
    }
}

/// Errors of all elements for values at the vertices (`None` where hidden), and in the middle of
/// elements without details, where known; `is_beset` says where readers gather anyway.
pub(super) fn leaf_errors(
    subdivision: &Subdivision,
    elements: &Elements,
    values: &[Option<f64>],
    in_the_middle: impl Fn(u32) -> Option<f64>,
    is_beset: impl Fn(u32) -> bool,
) -> Vec<LeafError> {
    let leaf = |node: u32| {
        let area_m2 = subdivision.triangle(node).area();
        let error = told_error(subdivision, elements, values, node).unwrap_or_else(|| {
            let corners = subdivision.node(node).0.vertices;
            untold_error(corners.map(|v| values[v as usize]), in_the_middle(node))
        });
        LeafError { node, area_m2, error, is_beset: is_beset(node) }
    };
    subdivision.leaves().map(leaf).collect()
}

/// The error of an element that details tell; `None` if it has none, or vertices that say nothing.
pub(super) fn told_error(
    subdivision: &Subdivision,
    elements: &Elements,
    values: &[Option<f64>],
    node: u32,
) -> Option<f64> {
    let corners = subdivision.node(node).0.vertices;
    if corners.iter().any(|&v| values[v as usize].is_none()) {
        return None;
    }
    let reach = RECENT * subdivision.longest_edge_m(node);
    let details = corners.iter().filter_map(|&v| detail(elements, values, v, reach));
    details.reduce(f64::max).map(|detail| ERROR_OF_DETAIL * detail)
}

/// The error of an element without details.
fn untold_error(values: [Option<f64>; 3], in_the_middle: Option<f64>) -> f64 {
    let known: Vec<f64> = values.into_iter().flatten().collect();
    let Some(high) = known.iter().copied().reduce(f64::max) else { return 0.0 };
    let low = known.iter().copied().fold(high, f64::min);
    match in_the_middle {
        Some(middle) => {
            let read = known.iter().sum::<f64>() / known.len() as f64;
            ERROR_OF_MIDDLE * (middle - read).abs()
        }
        None if known.len() == 3 => ERROR_OF_SPREAD * (high - low),
        // Extrapolation over a vertex that says nothing: as uncertain as the value is large.
        None => ERROR_OF_SPREAD * high,
    }
}

/// The detail of a vertex made on an edge no longer than `reach_m`.
fn detail(elements: &Elements, values: &[Option<f64>], vertex: u32, reach_m: f64) -> Option<f64> {
    let vertices = elements.vertices();
    let ends = vertices[vertex as usize].parents?;
    let [a, b] = ends.map(|end| vertices[end as usize].position);
    if (b - a).length() > reach_m {
        return None;
    }
    let [a, b] = ends.map(|end| values[end as usize]);
    Some((values[vertex as usize]? - 0.5 * (a? + b?)).abs())
}

/// What a fit to the light over elements leaves of the error of interpolation, where details shrink
/// to a quarter from level to level (smooth: a parabola is 2.4 times as near), and by how much more
/// for each unit by which they shrink less: all of it at three quarters, between kinks and borders.
const LEFT_OF_SMOOTH: f64 = 0.42;
const SMOOTH: f64 = 0.25;
const LEFT_FOR_ROUGH: f64 = (1.0 - LEFT_OF_SMOOTH) / (0.75 - SMOOTH);

/// The share of the error of all elements that a fit leaves: told by how details shrink from one level
/// to the next. Elements that have no two levels of details keep their errors.
pub(super) fn left_by_fit(
    subdivision: &Subdivision,
    elements: &Elements,
    values: &[Option<f64>],
    errors: &[LeafError],
) -> f64 {
    let (mut newer, mut older) = (0.0, 0.0);
    let (mut told, mut untold) = (0.0, 0.0);
    for leaf in errors {
        let reach = RECENT * subdivision.longest_edge_m(leaf.node);
        let corners = subdivision.node(leaf.node).0.vertices;
        let levels = corners.iter().filter_map(|&vertex| {
            let own = detail(elements, values, vertex, reach)?;
            let ends = elements.vertices()[vertex as usize].parents?;
            let above = ends.iter().filter_map(|&end| detail(elements, values, end, 2.0 * reach));
            Some((own, above.reduce(f64::max)?))
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
    let left = (LEFT_OF_SMOOTH + (shrinking - SMOOTH) * LEFT_FOR_ROUGH).clamp(LEFT_OF_SMOOTH, 1.0);
    ((told * left * left + untold) / (told + untold)).sqrt()
}

/// Share of the squared error that one round of refinement removes at most by marking the worst
/// elements (Dörfler 1996).
const MARKED_SHARE: f64 = 0.75;

/// What bisecting an element twice leaves of its squared error where light is smooth.
const LEFT: f64 = 1.0 / 16.0;

/// How far refinement goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refinement {
    /// How far the error of the scene is to fall.
    pub(super) wanted: f64,
    /// Elements with edges below this are left alone, m.
    pub(super) least_edge_m: f64,
    pub(super) max_vertices: usize,
}

/// Bisects the worst elements, twice each so that both directions are halved. Returns whether
/// anything was bisected.
pub(super) fn refine_worst(
    subdivision: &mut Subdivision,
    errors: &[LeafError],
    how_far: Refinement,
) -> bool {
    let Refinement { wanted, least_edge_m, max_vertices } = how_far;
    // No more than it takes, if all goes well.
    let share = ((1.0 - wanted * wanted) / (1.0 - LEFT)).clamp(0.0, MARKED_SHARE);
    let mut worst: Vec<&LeafError> = errors
        .iter()
        .filter(|e| e.error > 0.0 && subdivision.longest_edge_m(e.node) > 2.0 * least_edge_m)
        .collect();
    // Ties in the order of the nodes: the same mesh on every machine.
    worst.sort_by(|a, b| b.squared().total_cmp(&a.squared()).then(a.node.cmp(&b.node)));
    let total: f64 = worst.iter().map(|e| e.squared()).sum();
    let (mut marked, mut any) = (0.0, false);
    for error in worst {
        if marked >= share * total || subdivision.vertex_count() >= max_vertices {
            break;
        }
        marked += error.squared();
        any = true;
        bisect_twice(subdivision, error.node);
    }
    any
}

/// Bisects an element and its children.
pub(super) fn bisect_twice(subdivision: &mut Subdivision, node: u32) {
    subdivision.bisect(node);
    if let Some(split) = subdivision.node(node).0.split {
        subdivision.bisect(split.first_child);
        subdivision.bisect(split.first_child + 1);
    }
}
