//! The transport operator of the empty cube: the illuminance that a radiosity distribution, the
//! same on all six faces, throws on one of them.
//!
//! Lengths are half edges: a face is [-1, 1]^2, even in both coordinates and symmetric in them.
//! With `x`, `y` on the face, `a = 1 - x` the distance from the wall at `x = 1`, `v` along that wall and
//! `w` up it, the kernel is `a w / (pi (a^2 + w^2 + (y - v)^2)^2)`: singular at the shared edge, so
//! pieces of panels are graded towards its poles. That of the opposite face,
//! `4 / (pi (4 + dx^2 + dy^2)^2)`, is smooth.

use super::line::{Line, Pole, Resolution, Samples};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Distances from an edge below which a point is on it: the rounding of `1 - x` would show.
const EDGE: f64 = 1e-12;

/// The operator at one resolution.
#[derive(Clone, Debug)]
pub(super) struct Transport {
    line: Line,
    /// Nodes on both halves.
    own: Samples,
    /// Up a wall, graded towards the shared edge.
    up: Samples,
    /// Along a wall, as seen from the nodes.
    views: Vec<View>,
}

/// Quadratures along a wall for a point at `y`, one for every height of the pole: level `k` is for
/// heights of at least `4^-k`.
#[derive(Clone, Debug)]
struct View {
    y: f64,
    levels: Vec<Samples>,
}

/// A place on a face, and what reaches it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Received {
    /// Illuminance from all that is not in contact.
    pub(super) distant: f64,
    /// Share of the illuminance that comes from the place itself: on an edge the neighbouring face
    /// fills a finite part of the hemisphere at zero distance.
    pub(super) contact: f64,
}

impl Transport {
    pub(super) fn new(resolution: Resolution) -> Self {
        let line = Line::new(resolution);
        let nearest = line.nodes.last().map_or(1.0, |x| 1.0 - x);
        let views = line.nodes.par_iter().map(|&y| View::new(&line, y, nearest)).collect();
        let up = line.samples_near(Pole { at: 1.0, height: nearest });
        Self { own: line.own_samples(), up, views, line }
    }

    /// Nodes on half an edge.
    pub(super) fn nodes(&self) -> &[f64] {
        &self.line.nodes
    }

    /// The mean over a face of the product of two functions given at the nodes.
    pub(super) fn mean_product(&self, f: &[f64], g: &[f64]) -> f64 {
        let n = self.line.nodes.len();
        let weight = |k: usize| self.line.weights[k / n] * self.line.weights[k % n];
        f.iter().zip(g).enumerate().map(|(k, (f, g))| weight(k) * f * g).sum()
    }

    /// The illuminance at the nodes (`[y n + x]`) from radiosity given at the nodes.
    pub(super) fn apply(&self, radiosity: &[f64]) -> Vec<f64> {
        let n = self.line.nodes.len();
        let near = strips(&self.up, radiosity, n);
        let own = strips(&self.own, radiosity, n);
        let rows: Vec<(Vec<f64>, Vec<f64>)> = self
            .views
            .par_iter()
            .map(|view| {
                let xs = &self.line.nodes;
                (self.walls(&near, &own, view, xs), self.opposite(&own, view.y, xs))
            })
            .collect();
        let at = |y: usize, x: usize| rows[y].1[x] + rows[y].0[x] + rows[x].0[y];
        (0..n * n).map(|k| at(k / n, k % n)).collect()
    }

    /// What a place of a face receives from radiosity given at the nodes.
    pub(super) fn receive(&self, x: f64, y: f64, radiosity: &[f64]) -> Received {
        let (x, y) = (x.abs(), y.abs());
        let on_edges = [x, y].iter().filter(|&&t| is_on_edge(t)).count();
        let n = self.line.nodes.len();
        let own = strips(&self.own, radiosity, n);
        let from_walls = |x: f64, y: f64| {
            let lowest = (1.0 - x).max(EDGE);
            let up = self.line.samples_near(Pole { at: 1.0, height: lowest });
            let view = View::new(&self.line, y, lowest);
            self.walls(&strips(&up, radiosity, n), &own, &view, &[x])[0]
        };
        Received {
            distant: self.opposite(&own, y, &[x])[0] + from_walls(x, y) + from_walls(y, x),
            contact: [0.0, 0.5, 0.75][on_edges],
        }
    }

    /// From the walls at `x = 1` (strips graded towards the edge) and `x = -1`, to places `xs` at the
    /// `y` of a view.
    fn walls(&self, near: &[Strip], own: &[Strip], view: &View, xs: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; xs.len()];
        let distances: Vec<f64> =
            xs.iter().map(|&x| if is_on_edge(x) { 0.0 } else { 1.0 - x }).collect();
        for strip in near {
            strip.light_floor(view.level(strip.height), view.y, &distances, &mut sum);
        }
        let distances: Vec<f64> = xs.iter().map(|x| 1.0 + x).collect();
        for strip in own {
            strip.light_floor(&self.own, view.y, &distances, &mut sum);
        }
        sum
    }

    fn opposite(&self, own: &[Strip], y: f64, xs: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; xs.len()];
        for strip in own {
            let dy = 1.0 - strip.height - y;
            for j in 0..self.own.len() {
                let weight = strip.weight * self.own.weights[j];
                let b = weight * self.own.value(j, &strip.values, 1) * 4.0 / PI;
                for (sum, x) in sum.iter_mut().zip(xs) {
                    let dx = self.own.positions[j] - x;
                    let r2 = 4.0 + dx * dx + dy * dy;
                    *sum += b / (r2 * r2);
                }
            }
        }
        sum
    }
}

fn is_on_edge(x: f64) -> bool {
    1.0 - x < EDGE
}

/// A line of a face parallel to one of its edges.
struct Strip {
    /// Distance from that edge.
    height: f64,
    /// Quadrature weight across.
    weight: f64,
    /// Radiosity at the nodes along it.
    values: Vec<f64>,
}

/// A face cut into lines at the samples across it.
fn strips(across: &Samples, values: &[f64], n: usize) -> Vec<Strip> {
    (0..across.len())
        .map(|k| Strip {
            height: 1.0 - across.positions[k],
            weight: across.weights[k],
            values: (0..n).map(|along| across.value(k, &values[along..], n)).collect(),
        })
        .collect()
}

impl Strip {
    /// As part of a wall over its edge with the floor: adds what it throws on places of the floor
    /// at `y` along that edge and at the given distances from it.
    fn light_floor(&self, samples: &Samples, y: f64, distances: &[f64], sum: &mut [f64]) {
        let w = self.height;
        let mut inner = vec![0.0; distances.len()];
        for j in 0..samples.len() {
            let b = samples.weights[j] * samples.value(j, &self.values, 1);
            let dv = samples.positions[j] - y;
            let c = w * w + dv * dv;
            for (inner, a) in inner.iter_mut().zip(distances) {
                let r2 = a * a + c;
                *inner += b / (r2 * r2);
            }
        }
        for ((sum, a), inner) in sum.iter_mut().zip(distances).zip(inner) {
            *sum += a * w * self.weight * inner / PI;
        }
    }
}

impl View {
    fn new(line: &Line, y: f64, lowest: f64) -> Self {
        let mut levels = Vec::new();
        let mut height = 1.0;
        while levels.is_empty() || 4.0 * height > lowest {
            levels.push(line.samples_near(Pole { at: y, height }));
            height *= 0.25;
        }
        Self { y, levels }
    }

    fn level(&self, w: f64) -> &Samples {
        let mut height = 1.0;
        let mut k = 0;
        while height > w && k + 1 < self.levels.len() {
            height *= 0.25;
            k += 1;
        }
        &self.levels[k]
    }
}
