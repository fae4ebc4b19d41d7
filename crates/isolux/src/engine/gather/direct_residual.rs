//! Direct light as rays read it from a map, corrected to be right in the mean where it varies between vertices.
//!
//! Where luminaires are many, rays interpolate direct light between vertices. This errs where light varies from
//! element to element, as on a ceiling close above rows of lamps. Where elements and lamps both lie in rows, many
//! elements have the same error, so means over the visible surface err, too. All increments share this error, and
//! their spread does not show it. Each increment therefore samples the light that lands on such elements and
//! distributes it to the vertices around. The light that elements reflect is then right in the mean over increments,
//! and their spread tells its error. A vertex gets the mean of light weighted by its hat function; other elements add
//! the vertex's own value. Light is so conserved and never negative.
//!
//! A reader of a map takes its samples once, and all its readings share their noise. They tell it. An element `e` brings its
//! flux `X` to its vertices with the shares `a`, 1/m2, and a reading has the weight `w` of a vertex: it errs by the sum over elements of
//! `(sum_v a w) X`, whose variance is that of `X` times `(sum_v a w)^2`. That is at most `(sum_v a) (sum_v a w^2)` (Cauchy and
//! Schwarz), and equal to it where `w` is the same at all vertices of the element. So a value at each vertex is enough,
//! with which the squares of the weights are summed.

use super::bright_surfaces::BrightSurfaces;
use super::gatherer::known_weights;
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::light::{Goal, Lighting};
use crate::engine::ray::{Deadline, Dice, SurfacePoint};
use crate::map::Standing;
use crate::sampling::{Key, Sequence};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Point;
use rayon::prelude::*;
use std::collections::HashMap;

/// The number of places where the residual of interpolated direct light is measured: enough to find that of one
/// surface in a hundred.
const RESIDUAL_PLACES: usize = 1024;

/// A map of direct light with its scene.
#[derive(Clone, Copy)]
pub(crate) struct Over<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a Lighting<'a>,
    pub(crate) elements: &'a Elements,
    pub(crate) standings: &'a [Option<Standing>],
    pub(crate) direct: &'a [Rgb],
    /// Bright surfaces, where rays evaluate direct light.
    pub(crate) bright: Option<&'a BrightSurfaces>,
}

/// Elements whose direct light is sampled.
pub(crate) struct DirectResidual {
    leaves: Vec<Leaf>,
    /// Whether each node is such an element.
    pub(crate) varying: Vec<bool>,
    /// The integral of the function that rays read for each vertex, m2.
    hats_m2: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Leaf {
    node: u32,
    triangle: u32,
    back: bool,
    vertices: [u32; 3],
    area_m2: f64,
    /// The range of reflected light over the vertices, or its measured residual, lx. If the vertices tell all, the
    /// mean error of the element is at most half of this.
    varies_lx: f64,
}

/// Direct light at vertices as rays are to read it.
pub(crate) struct Kept {
    /// The light, lx.
    pub(crate) values: Vec<Rgb>,
    /// What the square of a weight of a vertex adds to the variance of a reading at most, lx2; unknown of one sample, and then zero.
    pub(crate) variances_lx2: Vec<f64>,
}

/// The flux on an element, and the vertices and weights that it is distributed to.
struct Lit {
    lm: Rgb,
    corners: [(u32, f64); 3],
}

impl DirectResidual {
    /// The elements to sample if a mean error of `allowed_lx` may remain; `None` where rays do not read direct light
    /// or its interpolation is good enough. After the end of the time no residual is measured.
    pub(crate) fn of(
        over: &Over<'_>,
        allowed_lx: f64,
        (key, end): (Key, &Deadline),
    ) -> Option<Self> {
        if !over.lighting.are_read_at_ends() || without("direct-residual") {
            return None;
        }
        let mut hats_m2 = vec![0.0; over.elements.vertices().len()];
        let (mut leaves, mut lit_m2) = (Vec::new(), 0.0);
        for (node, triangle, back) in over.elements.leaves() {
            let vertices = over.elements.node(node).vertices;
            let Some(thirds) = over.thirds(vertices) else { continue };
            let leaf = over.leaf((node, vertices), triangle, back);
            thirds.iter().for_each(|&(v, w)| hats_m2[v as usize] += w * leaf.area_m2);
            if vertices.iter().any(|&v| !over.direct[v as usize].is_black()) {
                lit_m2 += leaf.area_m2;
            }
            leaves.push(leaf);
        }
        over.look(&mut leaves, key, end);
        let needs = |leaf: &Leaf| leaf.area_m2 * leaf.varies_lx;
        leaves.sort_by(|a, b| needs(b).total_cmp(&needs(a)));
        let mut left: f64 = leaves.iter().map(needs).sum();
        let is_left = |leaf: &Leaf| {
            let is_left = left <= allowed_lx * lit_m2;
            left -= needs(leaf);
            is_left
        };
        let count = leaves.iter().position(is_left).unwrap_or(leaves.len());
        leaves.truncate(count);
        let mut varying = vec![false; over.elements.node_count()];
        leaves.iter().for_each(|leaf| varying[leaf.node as usize] = true);
        (count > 0).then_some(Self { leaves, varying, hats_m2 })
    }

    /// The approximate number of rays to find these elements and to take `samples` samples of each.
    pub(crate) const fn rays(&self, samples: u64) -> u64 {
        RESIDUAL_PLACES as u64 + samples * self.leaves.len() as u64
    }

    /// The noise of a reading that sees all elements evenly, if none absorbs anything, lx.
    pub(crate) fn noise_lx(&self, kept: &Kept) -> f64 {
        let all_m2: f64 = self.hats_m2.iter().sum();
        let of_vertices = self.hats_m2.iter().zip(&kept.variances_lx2);
        let variance: f64 =
            of_vertices.map(|(hat_m2, lx2)| (hat_m2 / all_m2) * (hat_m2 / all_m2) * lx2).sum();
        variance.sqrt()
    }

    /// Direct light at vertices as rays are to read it, lx, from `samples` samples of each element; `None` if the deadline
    /// passes meanwhile.
    pub(crate) fn read(
        &self,
        over: &Over<'_>,
        (samples, key): (u64, Key),
        deadline: &Deadline,
    ) -> Option<Kept> {
        let one = |(number, leaf): (usize, &Leaf)| {
            let sequence = Sequence::new(key.with(number as u64));
            let sample = |k| over.sample(leaf, &mut Dice::new(sequence, k));
            (!deadline.has_passed()).then(|| (0..samples as u32).map(sample).collect())
        };
        let all: Option<Vec<Vec<Lit>>> = self.leaves.par_iter().enumerate().map(one).collect();
        let all = all?;
        let mut sums_lm = vec![Rgb::BLACK; over.direct.len()];
        let mut sampled_m2 = vec![0.0; over.direct.len()];
        let mut variances_lx2 = vec![0.0; over.direct.len()];
        for (leaf, all) in self.leaves.iter().zip(all) {
            let variance_lm2 = variance_of_mean(&all);
            let thirds = over.thirds(leaf.vertices);
            // A vertex that nothing is read of stands for no area.
            let share = |(vertex, weight): (u32, f64)| match self.hats_m2[vertex as usize] {
                0.0 => 0.0,
                hat_m2 => weight / hat_m2,
            };
            let shares: f64 = thirds.iter().flatten().map(|&corner| share(corner)).sum();
            for (vertex, weight) in thirds.into_iter().flatten() {
                sampled_m2[vertex as usize] += weight * leaf.area_m2;
                variances_lx2[vertex as usize] += variance_lm2 * shares * share((vertex, weight));
            }
            for Lit { lm, corners } in all {
                for (vertex, weight) in corners {
                    sums_lm[vertex as usize] += lm * (weight / samples as f64);
                }
            }
        }
        let read = |v: usize| {
            let (own, hat_m2) = (over.direct[v], self.hats_m2[v]);
            if sampled_m2[v] == 0.0 {
                return own;
            }
            // Rounding may make the share of other elements negative.
            own * (1.0 - sampled_m2[v] / hat_m2).max(0.0) + sums_lm[v] / hat_m2
        };
        Some(Kept { values: (0..over.direct.len()).map(read).collect(), variances_lx2 })
    }
}

/// The variance of the mean flux of some samples, lm2; zero of one.
fn variance_of_mean(all: &[Lit]) -> f64 {
    let n = all.len() as f64;
    if n < 2.0 {
        return 0.0;
    }
    let mean = all.iter().map(|lit| lit.lm.luminance()).sum::<f64>() / n;
    let squares = all.iter().map(|lit| lit.lm.luminance() - mean).map(|off| off * off);
    squares.sum::<f64>() / (n * (n - 1.0))
}

impl Over<'_> {
    /// The shares of an element that each of its vertices stands for where rays read.
    fn thirds(&self, vertices: [u32; 3]) -> Option<[(u32, f64); 3]> {
        let weights = known_weights(vertices.map(|v| (v, 1.0 / 3.0)), self.standings)?;
        Some([0, 1, 2].map(|k| (vertices[k], weights[k])))
    }

    fn corners(&self, vertices: [u32; 3]) -> [Point; 3] {
        vertices.map(|vertex| self.elements.vertices()[vertex as usize].position)
    }

    fn leaf(&self, (node, vertices): (u32, [u32; 3]), triangle: u32, back: bool) -> Leaf {
        let [a, b, c] = self.corners(vertices);
        let area_m2 = 0.5 * (b - a).cross(c - a).length();
        let lx = vertices.map(|v| self.direct[v as usize].luminance());
        let [high, low] =
            [lx.into_iter().fold(f64::MIN, f64::max), lx.into_iter().fold(f64::MAX, f64::min)];
        let middle = self.place(vertices, (triangle, back), [1.0 / 3.0; 3]);
        let reflectance = middle.reflectance(self.scene).luminance();
        Leaf { node, triangle, back, vertices, area_m2, varies_lx: reflectance * (high - low) }
    }

    fn place(
        &self,
        vertices: [u32; 3],
        (triangle, back): (u32, bool),
        weights: [f64; 3],
    ) -> SurfacePoint {
        let [p, q, r] = self.corners(vertices);
        let point = p + (q - p) * weights[1] + (r - p) * weights[2];
        let [u, v] = self.scene.triangle(triangle).barycentric(point);
        SurfacePoint::new(self.scene, triangle, back, u, v)
    }

    /// Measures the residual at some places, since vertices may agree and light still vary between them.
    fn look(&self, leaves: &mut [Leaf], key: Key, end: &Deadline) {
        let sums: Vec<f64> = leaves
            .iter()
            .scan(0.0, |sum, leaf| {
                *sum += leaf.area_m2;
                Some(*sum)
            })
            .collect();
        let Some(&all_m2) = sums.last() else { return };
        let shift = key.with(u64::MAX).uniform();
        let one = |k: usize| {
            if end.has_passed() {
                return None;
            }
            let within = (k as f64 + shift) / RESIDUAL_PLACES as f64 * all_m2;
            let number = sums.partition_point(|&sum| sum <= within).min(leaves.len() - 1);
            let leaf = &leaves[number];
            let sequence = Sequence::new(key.with(k as u64));
            let place = self.somewhere_on(leaf, &mut Dice::new(sequence, 0));
            let (at, corners) = place.filter(|(at, _)| !self.is_bright(at))?;
            let measured = self.lighting.measured(&at, Goal::ANY, sequence);
            let lacking_lx = (measured.lx - self.told(corners)).luminance();
            let share = at.reflectance(self.scene).luminance();
            let square_lx2 = share * share * (lacking_lx * lacking_lx - measured.variance);
            Some(((leaf.triangle, leaf.back), square_lx2))
        };
        let looks: Vec<_> = (0..RESIDUAL_PLACES).into_par_iter().map(one).collect();
        let mut sides: HashMap<(u32, bool), (f64, f64)> = HashMap::new();
        for (side, square_lx2) in looks.into_iter().flatten() {
            let (sum, count) = sides.entry(side).or_default();
            (*sum, *count) = (*sum + square_lx2, *count + 1.0);
        }
        for leaf in leaves {
            let side = sides.get(&(leaf.triangle, leaf.back));
            let of_side_lx = side.map_or(0.0, |(sum, count)| (sum / count).max(0.0).sqrt());
            leaf.varies_lx = leaf.varies_lx.max(of_side_lx);
        }
    }

    /// A place of an element, uniform over its area, with vertices and weights; `None` where vertices are not known.
    fn somewhere_on(
        &self,
        leaf: &Leaf,
        dice: &mut Dice,
    ) -> Option<(SurfacePoint, [(u32, f64); 3])> {
        let Leaf { triangle, back, vertices, .. } = *leaf;
        let [a, b] = dice.pair();
        let root = a.sqrt();
        let weights = [1.0 - root, root * (1.0 - b), root * b];
        let at = self.place(vertices, (triangle, back), weights);
        let weights = known_weights([0, 1, 2].map(|k| (vertices[k], weights[k])), self.standings)?;
        Some((at, [0, 1, 2].map(|k| (vertices[k], weights[k]))))
    }

    fn told(&self, corners: [(u32, f64); 3]) -> Rgb {
        corners.iter().map(|&(vertex, weight)| self.direct[vertex as usize] * weight).sum()
    }

    /// The flux on an element from one place of it.
    fn sample(&self, leaf: &Leaf, dice: &mut Dice) -> Lit {
        let Some((at, corners)) = self.somewhere_on(leaf, dice) else {
            return Lit { lm: Rgb::BLACK, corners: leaf.vertices.map(|v| (v, 0.0)) };
        };
        let lx = match self.is_bright(&at) {
            true => self.told(corners),
            false => self.lighting.estimate(&at, dice),
        };
        Lit { lm: lx * leaf.area_m2, corners }
    }

    /// Whether rays evaluate direct light there instead of reading it.
    fn is_bright(&self, at: &SurfacePoint) -> bool {
        self.bright.is_some_and(|bright| bright.at(at).is_some())
    }
}
