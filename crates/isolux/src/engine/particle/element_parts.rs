//! Parts of elements in which caustics are checked.
//!
//! Caustics cannot be gathered, so check points do not measure their error. Particles do: in every increment
//! the flux on each sixteenth of an element is counted, and the increment's own map there is subtracted. The
//! square of the mean of that difference over increments, less its variance, is an unbiased squared error, as
//! at check points. It leaves out variations within the parts.

use crate::elements::Subdivision;
use crate::engine::gather::known_weights;
use crate::engine::mesh::NO_INDEX;
use crate::engine::ray::{Accumulator, Noise, Sample};
use crate::map::Standing;
use crate::units::Rgb;
use serde::{Deserialize, Serialize};

/// The number of parts from one division of an element, at the midpoints of its edges.
const QUARTERS: usize = 4;
/// The number of parts of an element: each part of the first division is divided again.
pub(crate) const PARTS: usize = QUARTERS * QUARTERS;

/// The factor from the squared error of the means of parts to the whole squared error. Below a ball of glass,
/// parts showed four thirds of the error of quarters. At a border, parts of half the size leave out half as
/// much.
const WITHIN_PARTS_FACTOR: f64 = 1.25;

/// The checked elements.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct ElementParts {
    elements: Vec<Checked>,
    /// The index in `elements` of each node.
    of_node: Vec<u32>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Checked {
    corners: [u32; 3],
    area_m2: f64,
}

/// The unbiased squared error over some surface, lx2 m2, and its variance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Squared {
    pub(crate) sum: f64,
    pub(crate) variance: f64,
}

impl ElementParts {
    /// The checked elements, from nodes that are not bisected.
    pub(crate) fn new(subdivision: &Subdivision, nodes: &[u32]) -> Self {
        let mut of_node =
            vec![NO_INDEX; if nodes.is_empty() { 0 } else { subdivision.node_count() }];
        let checked = |(k, &node): (usize, &u32)| {
            of_node[node as usize] = k as u32;
            let corners = subdivision.node(node).0.vertices;
            Checked { corners, area_m2: subdivision.triangle(node).area() }
        };
        Self { elements: nodes.iter().enumerate().map(checked).collect(), of_node }
    }

    /// Whether the checked elements are some of so many nodes, over so many vertices.
    pub(crate) fn are_of(&self, nodes: usize, vertices: usize) -> bool {
        let is_checked = |&k: &u32| k == NO_INDEX || (k as usize) < self.elements.len();
        self.of_node.len() <= nodes
            && self.of_node.iter().all(is_checked)
            && self.elements.iter().flat_map(|e| e.corners).all(|v| (v as usize) < vertices)
    }

    /// The number of parts.
    pub(crate) fn count(&self) -> usize {
        self.elements.len() * PARTS
    }

    /// Whether an element is checked.
    pub(crate) fn has(&self, node: u32) -> bool {
        self.of_node.get(node as usize).is_some_and(|&k| k != NO_INDEX)
    }

    /// Whether each of `count` vertices is a corner of a checked element.
    pub(crate) fn vertices(&self, count: usize) -> Vec<bool> {
        let mut of = vec![false; count];
        self.elements.iter().flat_map(|e| e.corners).for_each(|v| of[v as usize] = true);
        of
    }

    /// The part at some barycentric weights; `None` if the element is not checked.
    pub(crate) fn at(&self, node: u32, weights: [f64; 3]) -> Option<usize> {
        let element = *self.of_node.get(node as usize)?;
        (element != NO_INDEX).then(|| element as usize * PARTS + part_of(weights))
    }

    /// The mean light that the map lacks in every part, lx, given the flux on each part, lm.
    pub(crate) fn lacking(
        &self,
        flux_lm: impl Fn(usize) -> f64,
        light: impl Fn(u32) -> f64,
        standings: &[Option<Standing>],
    ) -> Vec<f64> {
        let mut lacking = Vec::with_capacity(self.count());
        for Checked { corners, area_m2 } in &self.elements {
            let values = corners.map(&light);
            let read = read_in_parts(*corners, values, standings);
            for read in read {
                let came = flux_lm(lacking.len()) * PARTS as f64 / area_m2;
                lacking.push(came - read);
            }
        }
        lacking
    }

    /// The errors of the elements, given the light that increments lacked in the parts.
    pub(crate) fn errors(&self, lacking: &Accumulator) -> Vec<Squared> {
        let of_one = |(element, checked): (usize, &Checked)| {
            let estimates = std::array::from_fn(|part| {
                let estimate = lacking.estimate(element * PARTS + part);
                (estimate.mean.caustic.luminance(), estimate.indirect_variance)
            });
            squared_error(&estimates, checked.area_m2)
        };
        self.elements.iter().enumerate().map(of_one).collect()
    }

    /// The mean squared error of the elements at every vertex, lx2. The standard error of the total is added,
    /// divided among elements by their variances.
    pub(crate) fn at_vertices(&self, errors: &[Squared]) -> Vec<(u32, f64)> {
        let all: Squared = errors.iter().copied().sum();
        let hidden = all.variance.max(0.0).sqrt();
        let mut at_vertices: Vec<(u32, f64, f64)> = Vec::new();
        for (checked, error) in self.elements.iter().zip(errors) {
            let share = error.variance.max(0.0) / all.variance.max(f64::MIN_POSITIVE);
            let squared = error.sum + hidden * share;
            at_vertices.extend(checked.corners.map(|v| (v, squared, checked.area_m2)));
        }
        at_vertices.sort_by_key(|&(v, ..)| v);
        let of_one = |of: &[(u32, f64, f64)]| {
            let (squared, m2) = of.iter().fold((0.0, 0.0), |sum, of| (sum.0 + of.1, sum.1 + of.2));
            (of[0].0, squared.max(0.0) / m2)
        };
        at_vertices.chunk_by(|a, b| a.0 == b.0).map(of_one).collect()
    }

    /// The integral of the variance of interpolated light, from that at the vertices, lx2 m2.
    pub(crate) fn noise(&self, variance: impl Fn(u32) -> f64, of_interpolated: f64) -> f64 {
        let of_one = |Checked { corners, area_m2 }: &Checked| {
            area_m2 * of_interpolated * corners.map(&variance).iter().sum::<f64>() / 3.0
        };
        self.elements.iter().map(of_one).sum()
    }
}

impl std::ops::AddAssign for Squared {
    fn add_assign(&mut self, other: Self) {
        self.sum += other.sum;
        self.variance += other.variance;
    }
}

impl std::iter::Sum for Squared {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |mut sum, one| {
            sum += one;
            sum
        })
    }
}

impl Squared {
    /// The reported value, given the treatment of noise.
    pub(crate) fn with(self, noise_is: Noise) -> f64 {
        noise_is.of_squared(self.sum, self.variance.max(0.0).sqrt())
    }

    /// Whether it exceeds noise by this many standard errors.
    pub(crate) fn is_believed(self, standard_errors: f64) -> bool {
        self.sum > standard_errors * self.variance.sqrt()
    }
}

/// The samples that an increment adds to the sums of the parts.
pub(crate) fn samples(lacking: &[f64]) -> impl Iterator<Item = Sample> {
    lacking.iter().map(|&lx| Sample { caustic: Rgb::grey(lx), ..Sample::default() })
}

/// The squared error of an element, given the mean lack of light in each part and its variance.
pub(crate) fn squared_error(parts: &[(f64, f64); PARTS], area_m2: f64) -> Squared {
    let each_m2 = WITHIN_PARTS_FACTOR * area_m2 / PARTS as f64;
    parts.iter().fold(Squared::default(), |sum, (mean, variance)| Squared {
        sum: sum.sum + each_m2 * (mean * mean - variance),
        // This is the variance of `mean^2 - variance` for a normal mean of zero.
        variance: sum.variance + 2.0 * each_m2 * each_m2 * variance * variance,
    })
}

/// The interpolated value in the middle of every part; zero where nothing is known.
pub(crate) fn read_in_parts(
    corners: [u32; 3],
    values: [f64; 3],
    standings: &[Option<Standing>],
) -> [f64; PARTS] {
    std::array::from_fn(|part| {
        let middle = middle_of(part);
        let weights = known_weights([0, 1, 2].map(|k| (corners[k], middle[k])), standings);
        weights.map_or(0.0, |weights| (0..3).map(|k| values[k] * weights[k]).sum())
    })
}

/// The part at some barycentric weights.
pub(crate) fn part_of(weights: [f64; 3]) -> usize {
    let (first, within) = quarter(weights);
    QUARTERS * first + quarter(within).0
}

/// The quarter at some weights (a corner or the middle one), and the weights within it.
fn quarter(weights: [f64; 3]) -> (usize, [f64; 3]) {
    match weights.iter().position(|&weight| weight >= 0.5) {
        Some(k) => {
            let within = [0, 1, 2].map(|m| 2.0 * weights[m] - if m == k { 1.0 } else { 0.0 });
            (k, within)
        }
        None => (3, weights.map(|weight| 1.0 - 2.0 * weight)),
    }
}

/// The barycentric weights of the middle of a part.
fn middle_of(part: usize) -> [f64; 3] {
    let out_of = |quarter: usize, within: [f64; 3]| {
        [0, 1, 2].map(|k| match quarter {
            3 => 0.5 * (1.0 - within[k]),
            corner => 0.5 * (within[k] + if k == corner { 1.0 } else { 0.0 }),
        })
    };
    out_of(part / QUARTERS, out_of(part % QUARTERS, [1.0 / 3.0; 3]))
}
