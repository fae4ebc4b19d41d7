//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes and weights of a quadrature over [-1, 1], exact for polynomials below degree `2 n`.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussRule {
    /// Where, ascending.
    pub nodes: Vec<f64>,
    /// How much.
    pub weights: Vec<f64>,
}

impl GaussRule {
    /// The rule of `n` points: the roots of the Legendre polynomial by Newton's method.
    pub fn new(n: usize) -> Self {
        let (nodes, weights) = (0..n).rev().map(|k| node(n, k)).unzip();
        Self { nodes, weights }
    }

    /// Nodes and weights mapped to an interval.
    pub fn over(&self, start: f64, end: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
        self.nodes.iter().zip(&self.weights).map(move |(x, w)| (centre + half * x, half * w))
    }

    /// The integral of a function over an interval.
    pub fn integrate(&self, start: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
        self.over(start, end).map(|(x, w)| w * f(x)).sum()
    }
}

fn node(n: usize, k: usize) -> (f64, f64) {
    // Tricomi's first guess is good enough for quadratic convergence from the first step.
    let mut x = libm::cos(PI * (k as f64 + 0.75) / (n as f64 + 0.5));
    for _ in 0..6 {
        let (value, slope) = legendre(n, x);
        let next = x - value / slope;
        if next == x {
            break;
        }
        x = next;
    }
    let (_, slope) = legendre(n, x);
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// The Legendre polynomial of degree `n` and its derivative, by Bonnet's recursion.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (before - x * value) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative, of sums of a few dozen terms.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn integrates_every_polynomial_below_twice_its_order() {
        for n in 1..=40 {
            let rule = GaussRule::new(n);
            for degree in 0..2 * n {
                let found = rule.integrate(0.0, 1.0, |x| libm::pow(x, degree as f64));
                let expected = 1.0 / (degree as f64 + 1.0);
                assert!((found - expected).abs() < ROUNDING * n as f64, "n {n}, degree {degree}");
            }
        }
    }
}
