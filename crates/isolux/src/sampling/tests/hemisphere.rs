//! Cosine-distributed directions, and bins of equal solid angle for all who live on a hemisphere.

use super::chi_square::misfit;
use super::squares;
use crate::sampling::CosineHemisphere;
use isolux_geometry::Vector;
use std::f64::consts::{PI, TAU};

const RINGS: usize = 12;
const SECTORS: usize = 16;
/// Midpoints across a bin each way: the rule's error falls with their square, to 1e-4 of a bin's
/// share for densities that change by a factor of a few across a bin; counts of some thousand
/// scatter by 1e-2.
const FINE: usize = 16;

/// Bins about +z: rings even in `1 - z` up to `widest` and one ring for the rest, times sectors.
pub(super) struct Bins {
    pub(super) widest: f64,
}

impl Bins {
    fn index(&self, v: Vector) -> usize {
        let ring = ((1.0 - v.z) / self.widest * RINGS as f64) as usize;
        let turn = libm::atan2(v.y, v.x) / TAU;
        let sector = ((turn - turn.floor()) * SECTORS as f64) as usize;
        ring.min(RINGS) * SECTORS + sector.min(SECTORS - 1)
    }

    /// How many of the directions fall into each bin; all must lie on the hemisphere.
    pub(super) fn count(&self, directions: impl Iterator<Item = Vector>) -> Vec<usize> {
        let mut counts = vec![0; (RINGS + 1) * SECTORS];
        for v in directions {
            assert!((v.length() - 1.0).abs() < 1e-12 && v.z >= 0.0, "{v:?}");
            counts[self.index(v)] += 1;
        }
        counts
    }

    /// Integral of a density per steradian over each bin, by the midpoint rule inside it.
    pub(super) fn shares(&self, density: impl Fn(Vector) -> f64) -> Vec<f64> {
        let mut shares = vec![0.0; (RINGS + 1) * SECTORS];
        let step = self.widest / (RINGS * FINE) as f64;
        let mut ring = |low: f64, step: f64| {
            let z: f64 = 1.0 - low - 0.5 * step;
            let sine = (1.0 - z * z).sqrt();
            for j in 0..SECTORS * FINE {
                let turn = TAU / (SECTORS * FINE) as f64;
                let (s, c) = libm::sincos(turn * (j as f64 + 0.5));
                let v = Vector::new(sine * c, sine * s, z);
                shares[self.index(v)] += density(v) * step * turn;
            }
        };
        (0..RINGS * FINE).for_each(|i| ring(i as f64 * step, step));
        // The rest in rings that widen in proportion, as tails do.
        let edge = |i: usize| libm::pow(self.widest, 1.0 - i as f64 / (4 * FINE) as f64);
        if self.widest < 1.0 {
            (0..4 * FINE).for_each(|i| ring(edge(i), edge(i + 1) - edge(i)));
        }
        shares
    }
}

#[test]
fn samples_follow_the_cosine() {
    let bins = Bins { widest: 1.0 };
    let counts = bins.count(squares(1, 200_000).map(CosineHemisphere::sample));
    let shares = bins.shares(CosineHemisphere::density);
    // The midpoint rule is exact for a density linear in z.
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert!(misfit(&shares, &counts) < 1.0);
}

#[test]
fn the_test_sees_a_wrong_density() {
    let bins = Bins { widest: 1.0 };
    let counts = bins.count(squares(1, 200_000).map(CosineHemisphere::sample));
    let even = bins.shares(|_| 1.0 / TAU);
    assert!(misfit(&even, &counts) > 1.0);
    // Three per cent more on one side than on the other.
    let tilted = bins.shares(|v| CosineHemisphere::density(v) * (1.0 + 0.03 * v.x.signum()));
    assert!(misfit(&tilted, &counts) > 1.0);
}

#[test]
fn inverse_undoes_sample() {
    let edges = [0.0, 0.25, 0.5, 0.75, 1.0 - f64::EPSILON].into_iter();
    let grid = edges.clone().flat_map(|a| edges.clone().map(move |b| [a, b]));
    for [a, b] in grid.chain(squares(2, 1000)) {
        let v = CosineHemisphere::sample([a, b]);
        assert!((v.length() - 1.0).abs() < 1e-15 * 4.0, "{a} {b}");
        let [c, d] = CosineHemisphere::inverse(v);
        // Ten roundings of angles up to 2 pi.
        assert!((a - c).abs().max((b - d).abs()) < 20.0 * f64::EPSILON, "{a} {b}: {c} {d}");
    }
}

#[test]
fn density_is_that_of_the_map() {
    // The area of the image of a small square, over the square: one over the density.
    let h = 1e-5;
    for [a, b] in squares(3, 200).map(|[a, b]| [0.02 + 0.95 * a, 0.02 + 0.95 * b]) {
        let (x, y) = (2.0 * a - 1.0, 2.0 * b - 1.0);
        let near_seam = (x.abs() - y.abs()).abs() < 1e-3;
        let v = CosineHemisphere::sample([a, b]);
        if near_seam || v.z < 0.2 {
            continue;
        }
        let across = CosineHemisphere::sample([a + h, b]) - CosineHemisphere::sample([a - h, b]);
        let up = CosineHemisphere::sample([a, b + h]) - CosineHemisphere::sample([a, b - h]);
        let steradians = across.cross(up).length() / (4.0 * h * h);
        // Central differences: the square of the step, times curvatures below 1e3 here, and
        // roundings of 1e-16 / h.
        assert!((steradians * CosineHemisphere::density(v) - 1.0).abs() < 1e-6, "{a} {b}");
    }
    assert_eq!(CosineHemisphere::density(Vector::new(0.0, 0.0, -1.0)), 0.0);
    assert_eq!(CosineHemisphere::density(Vector::new(0.0, 0.0, 1.0)), 1.0 / PI);
}
