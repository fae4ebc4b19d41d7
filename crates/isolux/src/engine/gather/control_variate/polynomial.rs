//! Polynomials over a rectangle, and the illuminance from a surface whose light is a polynomial.

use super::lanes::{LANES, Lanes};
use crate::quadrature::GaussRule;
use isolux_geometry::{Vector, Vectorized, with_vectors};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_1_PI;
use std::sync::OnceLock;

/// The highest degree. On CUBE, whose walls are five times as bright in the middle as in a corner, polynomials of
/// degree 0, 2, 4, 6 leave 26, 7.7, 2.3, 0.7 % of the light; nets of 64 rays then err by 1.3, 0.56, 0.19, 0.06 %.
pub(super) const DEGREE: usize = 6;
/// The number of coefficients of a polynomial in two variables.
pub(super) const COEFFICIENTS: usize = (DEGREE + 1) * (DEGREE + 2) / 2;
/// The least number of nodes of an integral along an edge, with one more for each unit of the variable.
/// Errors over places of CUBE are 1.2e-5 root mean square and 2.4e-5 at most (decision 40).
const FEWEST_NODES: f64 = 3.0;
/// The largest number of nodes of such an integral.
const MOST_NODES: usize = (FEWEST_NODES + 2.0 * INTEGRATION_LIMIT) as usize;
/// The limit of the variable of integration; the integrand vanishes beyond it.
const INTEGRATION_LIMIT: f64 = 24.0;

/// A polynomial in two variables from -1 to 1: the coefficients of `x^i y^k`, ordered by `i`, then `k`.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Polynomial(pub(super) [f64; COEFFICIENTS]);

/// The position and normal of a place relative to a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// The distance of the place from the plane, m.
    pub(super) height_m: f64,
    /// The foot of the place: the nearest point of the plane, m along its two axes from the middle of the rectangle.
    pub(super) foot_m: [f64; 2],
    /// The normal of the place in the two axes and the normal of the plane.
    pub(super) normal: [f64; 3],
}

/// The index of the coefficient of `x^i y^0`.
const fn first(i: usize) -> usize {
    i * (DEGREE + 1) - i * i.saturating_sub(1) / 2
}

/// All powers `x^i y^k` in the order of the coefficients.
pub(super) fn powers([x, y]: [f64; 2]) -> [f64; COEFFICIENTS] {
    let mut powers = [0.0; COEFFICIENTS];
    let mut of_x = 1.0;
    for i in 0..=DEGREE {
        let mut both = of_x;
        for power in &mut powers[first(i)..first(i + 1)] {
            *power = both;
            both *= y;
        }
        of_x *= x;
    }
    powers
}

impl Polynomial {
    /// The value at a place, by Horner's rule in both variables.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let mut value = 0.0;
        for i in (0..=DEGREE).rev() {
            let of_y = self.0[first(i)..first(i + 1)].iter().rev();
            value = value * x + of_y.fold(0.0, |sum, c| sum * y + c);
        }
        value
    }

    /// The polynomial with its origin shifted to a place.
    fn about(&self, [x, y]: [f64; 2]) -> Self {
        let mut shifted = *self;
        for i in 0..=DEGREE {
            let row = &mut shifted.0[first(i)..first(i + 1)];
            for from in 0..row.len() {
                for k in (from..row.len() - 1).rev() {
                    row[k] += y * row[k + 1];
                }
            }
        }
        for k in 0..=DEGREE {
            for from in 0..=DEGREE - k {
                for i in (from..DEGREE - k).rev() {
                    shifted.0[first(i) + k] += x * shifted.0[first(i + 1) + k];
                }
            }
        }
        shifted
    }

    /// The homogeneous parts of each degree in some directions.
    #[inline(always)]
    fn parts(&self, x: Lanes, y: Lanes) -> [Lanes; DEGREE + 1] {
        let mut of_y = [Lanes::of(1.0); DEGREE + 1];
        for k in 1..=DEGREE {
            of_y[k] = y * of_y[k - 1];
        }
        let mut parts = [Lanes::of(0.0); DEGREE + 1];
        for (degree, own) in parts.iter_mut().enumerate() {
            let mut part = Lanes::of(self.0[first(degree)]);
            for (k, &of_y) in of_y.iter().enumerate().take(degree + 1).skip(1) {
                part = part * x + Lanes::of(self.0[first(degree - k) + k]) * of_y;
            }
            *own = part;
        }
        parts
    }

    /// The illuminance from a rectangle with these half sides, m, whose radiosity is the polynomial, without
    /// obstacles.
    ///
    /// In polar coordinates about the foot of the place the integral over the radius has a closed form. The integral
    /// over the angle runs along the edges of the part of the rectangle above the horizon. At `x = d sinh w` on an
    /// edge at distance `d` the angle grows by `dw / cosh w`, and the rest is smooth in `w`.
    pub(super) fn illuminance(&self, half_m: [f64; 2], view: &View) -> f64 {
        let about = self.about([0, 1].map(|k| view.foot_m[k] / half_m[k]));
        let corners = &view.above_horizon(half_m);
        with_vectors(OfRectangle { light: &about, half_m, view, corners })
    }
}

/// A rectangle as seen from a place.
struct OfRectangle<'a> {
    /// The polynomial with its origin at the foot.
    light: &'a Polynomial,
    half_m: [f64; 2],
    view: &'a View,
    /// The corners of the part above the horizon.
    corners: &'a [[f64; 2]],
}

impl Vectorized for OfRectangle<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let nodes = along_edges(self.corners);
        let mut sum = 0.0;
        for some in nodes.chunks(LANES) {
            sum += self.view.along_radii(self.half_m, some, self.light);
        }
        sum * FRAC_1_PI
    }
}

/// An edge of a polygon, relative to the foot.
#[derive(Clone, Copy, Default)]
struct Edge {
    /// The unit vector from the foot to the nearest point of the edge's line.
    out: [f64; 2],
    /// The unit vector along the edge.
    along: [f64; 2],
    /// The distance of that line from the foot, m.
    away_m: f64,
}

/// A node of the integral over the angle: an edge, the variable there, and the weight.
#[derive(Clone, Copy, Default)]
struct Node {
    edge: Edge,
    place: f64,
    weight: f64,
}

/// The nodes of the integral over the angles of all edges as seen from the foot.
#[inline(always)]
fn along_edges(corners: &[[f64; 2]]) -> Vec<Node> {
    let mut edges = [(Edge::default(), 0.0); LANES];
    let (mut begins, mut ends) = (Lanes::of(0.0), Lanes::of(0.0));
    for (k, &from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % corners.len()];
        let Some((edge, sign)) = Edge::between(from, to) else { continue };
        edges[k] = (edge, sign);
        (begins.0[k], ends.0[k]) = (edge.place(from), edge.place(to));
    }
    let [begins, ends] = [begins, ends]
        .map(|places| places.asinh().map(|w| w.clamp(-INTEGRATION_LIMIT, INTEGRATION_LIMIT)));
    // As many as a rectangle usually takes.
    let mut nodes = Vec::with_capacity(32);
    for (k, (edge, sign)) in edges.into_iter().enumerate() {
        let (begin, end) = (begins.0[k], ends.0[k]);
        if end > begin {
            let count = (FEWEST_NODES + (end - begin)).ceil() as usize;
            let rule = rule_of(count.min(MOST_NODES)).over(begin, end);
            nodes.extend(rule.map(|(place, weight)| Node { edge, place, weight: sign * weight }));
        }
    }
    nodes
}

impl Edge {
    /// The edge between two corners, and the sign of its angle: 1 or -1. `None` for an edge through the foot, which
    /// spans no angle.
    #[inline(always)]
    fn between(from: [f64; 2], to: [f64; 2]) -> Option<(Self, f64)> {
        let side = [to[0] - from[0], to[1] - from[1]];
        let length = (side[0] * side[0] + side[1] * side[1]).sqrt();
        let along = side.map(|s| s / length);
        // Edges run counterclockwise, and this vector points to their right.
        let out = [along[1], -along[0]];
        let apart = from[0] * out[0] + from[1] * out[1];
        let (away_m, sign) = (apart.abs(), apart.signum());
        let edge = Self { out: out.map(|c| c * sign), along, away_m };
        let is_seen = length > 0.0 && [from, to].iter().all(|&at| edge.place(at).is_finite());
        is_seen.then_some((edge, sign))
    }

    /// The position of a place along the edge from the point nearest to the foot, in distances of that point.
    #[inline(always)]
    fn place(&self, at: [f64; 2]) -> f64 {
        (at[0] * self.along[0] + at[1] * self.along[1]) / self.away_m
    }
}

impl View {
    /// The corners of the part of a rectangle that the place may see, relative to the foot, m, counterclockwise.
    fn above_horizon(&self, half_m: [f64; 2]) -> Vec<[f64; 2]> {
        let [a, b] = half_m;
        let corners = [[-a, -b], [a, -b], [a, b], [-a, b]]
            .map(|at| [at[0] - self.foot_m[0], at[1] - self.foot_m[1]]);
        let [n_s, n_t, n_m] = self.normal;
        let above = |at: &[f64; 2]| at[0] * n_s + at[1] * n_t - self.height_m * n_m;
        let mut seen = Vec::with_capacity(5);
        for (k, from) in corners.iter().enumerate() {
            let to = &corners[(k + 1) % 4];
            let [begin, end] = [above(from), above(to)];
            if begin > 0.0 {
                seen.push(*from);
            }
            if (begin > 0.0) != (end > 0.0) {
                let share = begin / (begin - end);
                seen.push([0, 1].map(|k| from[k] + (to[k] - from[k]) * share));
            }
        }
        seen
    }

    /// The sum over nodes of the integrals over the radius.
    #[inline(always)]
    fn along_radii(&self, half_m: [f64; 2], some: &[Node], about: &Polynomial) -> f64 {
        let mut nodes = [Node::default(); LANES];
        nodes[..some.len()].copy_from_slice(some);
        let grown = lanes(&nodes, |node| node.place).exp();
        let shrunk = Lanes::of(1.0) / grown;
        let [cosh, sinh] = [(grown + shrunk) * Lanes::of(0.5), (grown - shrunk) * Lanes::of(0.5)];
        let over_cosh = Lanes::of(1.0) / cosh;
        let toward = [0, 1].map(|k| {
            let (out, along) =
                (lanes(&nodes, |n| n.edge.out[k]), lanes(&nodes, |n| n.edge.along[k]));
            (out + along * sinh) * over_cosh
        });
        let radius_m = lanes(&nodes, |node| node.edge.away_m) * cosh;
        let [n_s, n_t, n_m] = self.normal;
        let across = toward[0] * Lanes::of(n_s) + toward[1] * Lanes::of(n_t);
        let [x, y] = [0, 1].map(|k| toward[k] * Lanes::of(1.0 / half_m[k]));
        let parts = about.parts(x, y);
        let of_height = radial(radius_m * Lanes::of(1.0 / self.height_m));
        let (mut sum, mut height) = (Lanes::of(0.0), 1.0);
        for (j, &part) in parts.iter().enumerate() {
            let both = across * of_height[j + 2] - Lanes::of(n_m) * of_height[j + 1];
            sum = sum + part * Lanes::of(height) * both;
            height *= self.height_m;
        }
        (sum * over_cosh * lanes(&nodes, |node| node.weight)).sum()
    }

    /// The view of a place relative to a plane; the third axis is the plane's normal.
    pub(super) fn new(from_middle: Vector, normal: Vector, axes: &[Vector; 3]) -> Self {
        Self {
            height_m: from_middle.dot(axes[2]),
            foot_m: [from_middle.dot(axes[0]), from_middle.dot(axes[1])],
            normal: axes.map(|axis| normal.dot(axis)),
        }
    }
}

/// The inverse of each number; entry zero is not used.
const INVERSES: [f64; DEGREE + 2] = {
    let mut inverse = [0.0; DEGREE + 2];
    let mut k = 1;
    while k < DEGREE + 2 {
        inverse[k] = 1.0 / k as f64;
        k += 1;
    }
    inverse
};

/// A value of each node.
#[inline(always)]
fn lanes(nodes: &[Node; LANES], of: impl Fn(&Node) -> f64) -> Lanes {
    let mut all = Lanes::of(0.0);
    for (own, node) in all.0.iter_mut().zip(nodes) {
        *own = of(node);
    }
    all
}

/// The integrals of `u^k / (1 + u^2)^2` from zero to `to`, by `k`.
#[inline(always)]
fn radial(to: Lanes) -> [Lanes; DEGREE + 3] {
    let squared = to * to;
    let fall = Lanes::of(1.0) / (Lanes::of(1.0) + squared);
    let mut once = [Lanes::of(0.0); DEGREE + 3];
    once[0] = to.atan();
    once[1] = (Lanes::of(1.0) + squared).ln() * Lanes::of(0.5);
    let mut power = Lanes::of(1.0);
    for k in 2..DEGREE + 3 {
        power = power * to;
        once[k] = power * Lanes::of(INVERSES[k - 1]) - once[k - 2];
    }
    let mut twice = [Lanes::of(0.0); DEGREE + 3];
    twice[0] = Lanes::of(0.5) * (once[0] + to * fall);
    twice[1] = Lanes::of(0.5) * squared * fall;
    for k in 2..DEGREE + 3 {
        twice[k] = once[k - 2] - twice[k - 2];
    }
    twice
}

fn rule_of(nodes: usize) -> &'static GaussRule {
    RULES[nodes].get_or_init(|| GaussRule::new(nodes))
}

/// The Gauss rules by number of nodes, each made on first use.
static RULES: [OnceLock<GaussRule>; MOST_NODES + 1] = [const { OnceLock::new() }; MOST_NODES + 1];

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative error of the sum over panels.
    const PANELS_ERROR: f64 = 2e-5;

    fn some() -> Polynomial {
        Polynomial(std::array::from_fn(|k| {
            1.0 / (1.0 + k as f64) * if k % 3 == 1 { -1.0 } else { 1.0 }
        }))
    }

    #[test]
    fn a_shifted_polynomial_is_the_same() {
        let (own, by) = (some(), [0.3, -1.7]);
        let shifted = own.about(by);
        for at in [[0.1, 0.2], [-0.4, 1.1]] {
            let there = [at[0] + by[0], at[1] + by[1]];
            assert!((shifted.at(at) - own.at(there)).abs() < 1e-10, "{at:?}");
            let sum: f64 = powers(there).iter().zip(own.0).map(|(p, c)| p * c).sum();
            assert!((sum - own.at(there)).abs() < 1e-12, "{at:?}");
        }
    }

    #[test]
    fn illuminance_from_a_rectangle_is_what_its_parts_give() {
        let half_m = [1.5, 0.8];
        let slope = 0.48_f64.sqrt();
        let places = [
            ([0.3, 0.2], 1.0, [0.0, 0.0, -1.0]),
            ([0.3, 0.8], 0.4, [0.0, -1.0, 0.0]),
            ([-1.2, -0.8], 0.05, [0.0, 1.0, 0.0]),
            ([2.5, 0.1], 0.7, [-slope, 0.4, -0.6]),
            ([1.0, -3.0], 2.0, [0.6, 0.8, 0.0]),
            ([0.5, 0.5], 9.0, [0.0, 0.6, -0.8]),
        ];
        for (foot_m, height_m, normal) in places {
            let view = View { height_m, foot_m, normal };
            let found = some().illuminance(half_m, &view);
            let panels = GaussRule::new(400);
            let mut expected = 0.0;
            for (x, wx) in panels.over(-1.0, 1.0) {
                for (y, wy) in panels.over(-1.0, 1.0) {
                    let to = [x * half_m[0] - foot_m[0], y * half_m[1] - foot_m[1], -height_m];
                    let squared = to.iter().map(|c| c * c).sum::<f64>();
                    let cos: f64 = (0..3).map(|k| to[k] * normal[k]).sum();
                    let kernel = cos.max(0.0) * height_m / (squared * squared);
                    expected += wx * wy * kernel * some().at([x, y]);
                }
            }
            expected *= half_m[0] * half_m[1] * FRAC_1_PI;
            assert!(
                (found / expected - 1.0).abs() < PANELS_ERROR,
                "{foot_m:?}: {found} {expected}"
            );
        }
    }
}
