//! Parts of elements in which caustics are checked.
//!
//! Nothing can gather a caustic, so no check point sees what a map lacks of it. But particles tell it: of each increment what came
//! to the sixteenth parts of an element is counted, and what its own map has there taken off. The mean of that over increments
//! squared, less its variance, is the squared error without bias, as at check points, but for what differs within the parts.

use crate::elements::Subdivision;
use crate::engine::gather::known_weights;
use crate::engine::ray::{Accumulator, Noise, Sample};
use crate::map::Standing;
use crate::units::Rgb;

/// Parts of an element: the four that the middles of its edges make, each of them so divided again.
const QUARTERS: usize = 4;
pub(crate) const PARTS: usize = QUARTERS * QUARTERS;

/// All of the squared error, as a multiple of what parts tell in the mean: below a ball of glass they told four thirds of what
/// quarters did. Of borders, parts of half the size leave half as much untold.
const WITHIN: f64 = 1.25;

/// No element.
const NONE: u32 = u32::MAX;

/// Elements that are checked.
#[derive(Debug, Default)]
pub(crate) struct ElementParts {
    elements: Vec<Checked>,
    /// By node, which of them it is.
    of_node: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Checked {
    corners: [u32; 3],
    area_m2: f64,
}

/// A squared error over some surface, lx2 m2, without bias, and its variance that is noise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Squared {
    pub(crate) sum: f64,
    pub(crate) variance: f64,
}

impl ElementParts {
    /// Of these nodes, which are not bisected.
    pub(crate) fn new(subdivision: &Subdivision, nodes: &[u32]) -> Self {
        let mut of_node = vec![NONE; if nodes.is_empty() { 0 } else { subdivision.node_count() }];
        let checked = |(k, &node): (usize, &u32)| {
            of_node[node as usize] = k as u32;
            let corners = subdivision.node(node).0.vertices;
            Checked { corners, area_m2: subdivision.triangle(node).area() }
        };
        Self { elements: nodes.iter().enumerate().map(checked).collect(), of_node }
    }

    /// How many parts there are.
    pub(crate) fn count(&self) -> usize {
        self.elements.len() * PARTS
    }

    /// Whether an element is checked.
    pub(crate) fn has(&self, node: u32) -> bool {
        self.of_node.get(node as usize).is_some_and(|&k| k != NONE)
    }

    /// Which of so many vertices are corners of such elements.
    pub(crate) fn vertices(&self, count: usize) -> Vec<bool> {
        let mut of = vec![false; count];
        self.elements.iter().flat_map(|e| e.corners).for_each(|v| of[v as usize] = true);
        of
    }

    /// The part that weights of its vertices tell.
    pub(crate) fn at(&self, node: u32, weights: [f64; 3]) -> Option<usize> {
        let element = *self.of_node.get(node as usize)?;
        (element != NONE).then(|| element as usize * PARTS + part_of(weights))
    }

    /// What a map lacks in every part in the mean, lx, of which flux came to it, lm.
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

    /// What elements err by, given what increments lacked in the parts.
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

    /// What is said of these errors in the mean of the elements at every vertex, lx2: all of it together, what noise may hide shared
    /// out as it is expected.
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

    /// The integral of the variance of what is interpolated, from that at the vertices, lx2 m2.
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
    /// What it is said to be, given what noise may hide.
    pub(crate) fn with(self, noise_is: Noise) -> f64 {
        noise_is.of_squared(self.sum, self.variance.max(0.0).sqrt())
    }

    /// Whether it is more than noise makes it.
    pub(crate) fn is_believed(self, standard_errors: f64) -> bool {
        self.sum > standard_errors * self.variance.sqrt()
    }
}

/// What an increment adds to the sums of the parts.
pub(crate) fn samples(lacking: &[f64]) -> impl Iterator<Item = Sample> {
    lacking.iter().map(|&lx| Sample { caustic: Rgb::grey(lx), ..Sample::default() })
}

/// The squared error of an element whose parts lack so much in the mean, with the variances of that.
pub(crate) fn squared_error(parts: &[(f64, f64); PARTS], area_m2: f64) -> Squared {
    let each_m2 = WITHIN * area_m2 / PARTS as f64;
    parts.iter().fold(Squared::default(), |sum, (mean, variance)| Squared {
        sum: sum.sum + each_m2 * (mean * mean - variance),
        // That of `mean^2 - variance` for a normal mean of zero.
        variance: sum.variance + 2.0 * each_m2 * each_m2 * variance * variance,
    })
}

/// What is read in the middle of every part of an element with such values at its vertices; nothing where none is known.
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

/// The part that barycentric weights lie in.
pub(crate) fn part_of(weights: [f64; 3]) -> usize {
    let (first, within) = quarter(weights);
    QUARTERS * first + quarter(within).0
}

/// The quarter that weights lie in, at a vertex or amid them, and the weights in it.
fn quarter(weights: [f64; 3]) -> (usize, [f64; 3]) {
    match weights.iter().position(|&weight| weight >= 0.5) {
        Some(k) => {
            let within = [0, 1, 2].map(|m| 2.0 * weights[m] - if m == k { 1.0 } else { 0.0 });
            (k, within)
        }
        None => (3, weights.map(|weight| 1.0 - 2.0 * weight)),
    }
}

/// Weights in the middle of a part.
fn middle_of(part: usize) -> [f64; 3] {
    let out_of = |quarter: usize, within: [f64; 3]| {
        [0, 1, 2].map(|k| match quarter {
            3 => 0.5 * (1.0 - within[k]),
            corner => 0.5 * (within[k] + if k == corner { 1.0 } else { 0.0 }),
        })
    };
    out_of(part / QUARTERS, out_of(part % QUARTERS, [1.0 / 3.0; 3]))
}
