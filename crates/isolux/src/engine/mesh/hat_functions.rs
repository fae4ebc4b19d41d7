//! Hat functions of the elements: conversion of flux on vertices to values, and its blur.

use crate::elements::Subdivision;
use crate::map::Standing;
use crate::units::Rgb;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// The integrals of the hat functions of elements, over those vertices of each element that are read.
pub(crate) struct HatFunctions {
    areas_m2: Vec<f64>,
    /// Elements with their areas, m2, whose vertices are all known and of one standing.
    known: Vec<([u32; 3], f64)>,
}

/// The number of terms of the series in half of the blur; integer sums do not hold what is left after them.
const SERIES_TERMS: u32 = 32;

/// A quantity on vertices.
pub(crate) trait Quantity:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + AddAssign
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
}

impl Quantity for f64 {}

impl Quantity for Rgb {}

impl HatFunctions {
    /// The hat functions of the leaves, for these standings of vertices.
    pub(crate) fn new(subdivision: &Subdivision, standings: &[Option<Standing>]) -> Self {
        let mut hats = Self { areas_m2: vec![0.0; subdivision.vertex_count()], known: Vec::new() };
        for leaf in subdivision.leaves() {
            let corners = subdivision.node(leaf).0.vertices;
            let of = corners.map(|v| standings[v as usize]);
            let standing = Standing::highest(of);
            let read = |k: &usize| standing.is_some() && of[*k] == standing;
            let area_m2 = subdivision.triangle(leaf).area();
            let share = area_m2 / (0..3).filter(read).count().max(1) as f64;
            for k in (0..3).filter(read) {
                hats.areas_m2[corners[k] as usize] += share;
            }
            if of[0].is_some() && of == [of[0]; 3] {
                hats.known.push((corners, area_m2));
            }
        }
        hats
    }

    /// The integral of the hat function of each vertex, m2.
    pub(crate) fn areas_m2(&self) -> &[f64] {
        &self.areas_m2
    }

    /// The mean of a quantity about each vertex, weighted by its hat function, from the integrals.
    pub(crate) fn means<T: Quantity>(&self, integrals: impl Iterator<Item = T>) -> Vec<T> {
        let mean = |(sum, &area): (T, &f64)| if area > 0.0 { sum / area } else { T::default() };
        integrals.zip(&self.areas_m2).map(mean).collect()
    }

    /// The means about each vertex of a quantity that is interpolated between these values.
    pub(crate) fn blur<T: Quantity>(&self, values: &[T]) -> Vec<T> {
        let mut sums = vec![T::default(); values.len()];
        for (corners, area_m2) in &self.known {
            // The exact integrals of products: a sixth of the area for a hat squared, a twelfth for two different
            // hats.
            let [a, b, c] = corners.map(|v| values[v as usize]);
            let all = a + b + c;
            for &v in corners {
                sums[v as usize] += (values[v as usize] + all) * (area_m2 / 12.0);
            }
        }
        self.means(sums.into_iter())
    }

    /// The values at the vertices from the means: one step of Van Cittert's deconvolution.
    pub(crate) fn corrected<T: Quantity>(&self, means: &[T]) -> Vec<T> {
        let blurred = self.blur(means);
        means.iter().zip(&blurred).map(|(&mean, &again)| mean * 2.0 - again).collect()
    }

    /// The means from corrected values: the solution of `(2 - B) means = values`, with the blur `B`. Since `B / 2` is
    /// at most one half, its powers sum up.
    fn uncorrected(&self, values: &[Rgb]) -> Vec<Rgb> {
        let half = |values: &[Rgb]| -> Vec<Rgb> { values.iter().map(|&v| v * 0.5).collect() };
        let mut term = half(values);
        let mut means = term.clone();
        for _ in 0..SERIES_TERMS {
            term = half(&self.blur(&term));
            means.iter_mut().zip(&term).for_each(|(mean, &more)| *mean += more);
        }
        means
    }

    /// The corrected values with none less than half of its mean. Along every edge the correction adds to one end as
    /// much as it takes from the other, limited so that neither loses more (flux-corrected transport: Boris, Book
    /// 1973; Zalesak 1979). Light is so conserved; a cut at zero would add light.
    pub(crate) fn held(&self, values: &[Rgb]) -> Vec<Rgb> {
        // Rounding of the sums of increments may make means negative, which they are not otherwise.
        let means = self.uncorrected(values);
        let means: Vec<Rgb> = means.into_iter().map(|mean| mean.greater(Rgb::BLACK)).collect();
        let edges = |corners: &[u32; 3]| {
            [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|k: usize| corners[k] as usize))
        };
        // The light brought to the first vertex from the second.
        let brought = |[a, b]: [usize; 2], area_m2: f64| (means[a] - means[b]) * (area_m2 / 12.0);
        let mut taken = vec![Rgb::BLACK; means.len()];
        for (corners, area_m2) in &self.known {
            for [a, b] in edges(corners) {
                let lm = brought([a, b], *area_m2);
                taken[a] += (lm * -1.0).greater(Rgb::BLACK);
                taken[b] += lm.greater(Rgb::BLACK);
            }
        }
        let share = |(k, &taken): (usize, &Rgb)| {
            let most = means[k] * (0.5 * self.areas_m2[k]);
            let share =
                |c: usize| if taken.0[c] > most.0[c] { most.0[c] / taken.0[c] } else { 1.0 };
            Rgb([0, 1, 2].map(share))
        };
        let shares: Vec<Rgb> = taken.iter().enumerate().map(share).collect();
        // The blur of elements of several standings is not known, and the means stay there.
        let mut known_m2 = vec![0.0; means.len()];
        let mut sums: Vec<Rgb> = vec![Rgb::BLACK; means.len()];
        for (corners, area_m2) in &self.known {
            for [a, b] in edges(corners) {
                let lm = brought([a, b], *area_m2) * {
                    let of = |c: usize| {
                        let loses = if means[a].0[c] < means[b].0[c] { a } else { b };
                        shares[loses].0[c]
                    };
                    Rgb([0, 1, 2].map(of))
                };
                sums[a] += lm;
                sums[b] += lm * -1.0;
                known_m2[a] += area_m2 / 3.0;
            }
        }
        let value = |k: usize| {
            let unknown_m2 = (self.areas_m2[k] - known_m2[k]).max(0.0);
            let more = sums[k] + means[k] * unknown_m2;
            let area_m2 = self.areas_m2[k];
            if area_m2 > 0.0 { means[k] + more / area_m2 } else { Rgb::BLACK }
        };
        (0..means.len()).map(value).collect()
    }
}
