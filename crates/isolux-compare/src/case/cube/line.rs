//! Functions along an edge of the cube: even on [-1, 1], piecewise polynomial on panels that shrink
//! geometrically towards the ends.
//!
//! Near an edge the illuminance behaves like `c + d a^gamma` with a fractional exponent of the
//! distance `a` (the Mellin symbol of the kernel between perpendicular planes), so panels of
//! constant ratio with Gauss nodes converge exponentially (hp collocation; Stephan and Suri 1989).
//! Orders fall linearly towards the end, where panels count less.

use isolux::quadrature::GaussRule;

/// How finely the panels resolve the solution and the kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Resolution {
    /// Panels between the middle and the end.
    pub(super) panels: usize,
    /// Gauss nodes on the panel at the middle.
    pub(super) first_order: usize,
    /// Gauss nodes on the panel at the end.
    pub(super) last_order: usize,
    /// Relative error allowed to the quadrature of the kernel on one panel.
    pub(super) tolerance: f64,
}

/// The panels of [0, 1] and their nodes.
#[derive(Clone, Debug)]
pub(super) struct Line {
    panels: Vec<Panel>,
    /// Nodes in [0, 1], ascending.
    pub(super) nodes: Vec<f64>,
    /// Quadrature weights over [0, 1].
    pub(super) weights: Vec<f64>,
    /// Quadrature for pieces of panels.
    fine: GaussRule,
    tolerance: f64,
}

#[derive(Clone, Debug)]
struct Panel {
    start: f64,
    end: f64,
    first: usize,
    rule: GaussRule,
}

/// Points of [-1, 1] with weights, each with the recipe to interpolate a function there.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    /// Where.
    pub(super) positions: Vec<f64>,
    /// Quadrature weight.
    pub(super) weights: Vec<f64>,
    recipes: Vec<Recipe>,
    coefficients: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Recipe {
    first_node: usize,
    first_coefficient: usize,
    count: usize,
}

/// A singularity of the integrand, `at + i height` in the complex plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole {
    pub(super) at: f64,
    pub(super) height: f64,
}

/// Ratio of neighbouring panels; see [`Pole::parameter`]: with a singularity at the end, panels of
/// this ratio have the parameter 3.
const RATIO: f64 = 0.25;
/// Pieces shorter than the rounding of coordinates near one are not cut.
const SMALLEST_PIECE: f64 = f64::EPSILON;
/// The parameter of a panel that ends at `RATIO` of its length from a pole.
const GRADED_PARAMETER: f64 = 3.0;

impl Pole {
    fn distance(self, x: f64) -> f64 {
        ((x - self.at) * (x - self.at) + self.height * self.height).sqrt()
    }

    /// The Bernstein parameter `r` of the largest ellipse around an interval without the pole: the
    /// error of `n` Gauss points falls as `r^(-2 n)` (Trefethen 2013, "Approximation Theory and
    /// Approximation Practice", theorem 19.3). The sum of the distances from the foci to the
    /// ellipse is `(r + 1 / r) / 2` lengths of the interval.
    fn parameter(self, start: f64, end: f64) -> f64 {
        let axis = (self.distance(start) + self.distance(end)) / (end - start);
        axis + (axis * axis - 1.0).max(0.0).sqrt()
    }

    /// Where to cut an interval that is too near: at the foot of the pole, else so that the outer
    /// part is as long as it may be.
    fn cut(self, start: f64, end: f64) -> f64 {
        // Just inside the ratio, so that rounding does not call for another cut.
        let ratio = RATIO * 1.001;
        let outer = |reach: f64| (reach * ratio).max((1.8 * self.height).min(0.9 * reach));
        if self.at <= start {
            let cut = self.at + outer(end - self.at);
            if cut > start { cut } else { 0.5 * (start + end) }
        } else if self.at >= end {
            let cut = self.at - outer(self.at - start);
            if cut < end { cut } else { 0.5 * (start + end) }
        } else {
            self.at
        }
    }
}

impl Line {
    pub(super) fn new(resolution: Resolution) -> Self {
        let Resolution { panels, first_order, last_order, tolerance } = resolution;
        let fine_order = libm::log(1.0 / tolerance) / (2.0 * libm::log(GRADED_PARAMETER));
        let mut line = Self {
            panels: Vec::new(),
            nodes: Vec::new(),
            weights: Vec::new(),
            fine: GaussRule::new(fine_order.ceil() as usize),
            tolerance,
        };
        let mut rest = 1.0;
        for k in 0..panels {
            let last = k + 1 == panels;
            let next = if last { 0.0 } else { rest * RATIO };
            let fall = (first_order - last_order) * k / (panels - 1).max(1);
            line.push(1.0 - rest, 1.0 - next, first_order - fall);
            rest = next;
        }
        line
    }

    fn push(&mut self, start: f64, end: f64, order: usize) {
        let rule = GaussRule::new(order);
        let first = self.nodes.len();
        for (x, w) in rule.over(start, end) {
            self.nodes.push(x);
            self.weights.push(w);
        }
        self.panels.push(Panel { start, end, first, rule });
    }

    /// The nodes themselves, on both halves.
    pub(super) fn own_samples(&self) -> Samples {
        let mut samples = Samples::default();
        for panel in &self.panels {
            samples.push_nodes(self, panel, 1.0);
            samples.push_nodes(self, panel, -1.0);
        }
        samples
    }

    /// Points that integrate, over [-1, 1], a function on the panels times a kernel with a pole.
    pub(super) fn samples_near(&self, pole: Pole) -> Samples {
        let mut samples = Samples::default();
        for panel in &self.panels {
            for sign in [1.0, -1.0] {
                // On the left half the panel is mirrored; so is the pole, instead.
                let pole = Pole { at: sign * pole.at, ..pole };
                let exponent = 0.5 / panel.rule.nodes.len() as f64;
                let enough = libm::pow(self.tolerance, -exponent);
                if pole.parameter(panel.start, panel.end) >= enough {
                    samples.push_nodes(self, panel, sign);
                } else {
                    self.push_pieces(&mut samples, panel, sign, pole);
                }
            }
        }
        samples
    }

    fn push_pieces(&self, samples: &mut Samples, panel: &Panel, sign: f64, pole: Pole) {
        let mut pieces = vec![(panel.start, panel.end)];
        while let Some((start, end)) = pieces.pop() {
            if end - start < SMALLEST_PIECE || pole.parameter(start, end) >= GRADED_PARAMETER {
                for (x, weight) in self.fine.over(start, end) {
                    samples.push(sign * x, weight, panel, &panel.coefficients(x));
                }
            } else {
                let cut = pole.cut(start, end);
                pieces.push((start, cut));
                pieces.push((cut, end));
            }
        }
    }
}

impl Panel {
    /// Lagrange coefficients at `x`, by the barycentric formula with the weights of Gauss nodes
    /// (Wang and Xiang 2012): signs alternate, squares are `(1 - t^2) w`.
    fn coefficients(&self, x: f64) -> Vec<f64> {
        let t = (2.0 * x - self.start - self.end) / (self.end - self.start);
        if let Some(hit) = self.rule.nodes.iter().position(|&node| node == t) {
            return (0..self.rule.nodes.len()).map(|k| f64::from(k == hit)).collect();
        }
        let mut sign = -1.0;
        let mut found: Vec<f64> = (self.rule.nodes.iter().zip(&self.rule.weights))
            .map(|(&node, &weight)| {
                sign = -sign;
                sign * ((1.0 - node * node) * weight).sqrt() / (t - node)
            })
            .collect();
        let sum: f64 = found.iter().sum();
        found.iter_mut().for_each(|c| *c /= sum);
        found
    }
}

impl Samples {
    fn push(&mut self, position: f64, weight: f64, panel: &Panel, coefficients: &[f64]) {
        self.positions.push(position);
        self.weights.push(weight);
        let (first_coefficient, count) = (self.coefficients.len(), coefficients.len());
        self.recipes.push(Recipe { first_node: panel.first, first_coefficient, count });
        self.coefficients.extend_from_slice(coefficients);
    }

    fn push_nodes(&mut self, line: &Line, panel: &Panel, sign: f64) {
        for node in panel.first..panel.first + panel.rule.nodes.len() {
            self.positions.push(sign * line.nodes[node]);
            self.weights.push(line.weights[node]);
            let first_coefficient = self.coefficients.len();
            self.recipes.push(Recipe { first_node: node, first_coefficient, count: 1 });
            self.coefficients.push(1.0);
        }
    }

    /// Number of points.
    pub(super) fn len(&self) -> usize {
        self.positions.len()
    }

    /// The value at point `k` of the function with these values at the nodes, `stride` apart.
    pub(super) fn value(&self, k: usize, values: &[f64], stride: usize) -> f64 {
        let Recipe { first_node, first_coefficient, count } = self.recipes[k];
        let coefficients = &self.coefficients[first_coefficient..first_coefficient + count];
        coefficients.iter().enumerate().map(|(j, c)| c * values[(first_node + j) * stride]).sum()
    }
}
