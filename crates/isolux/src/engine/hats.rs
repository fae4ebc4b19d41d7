//! Hat functions of the elements: what flux on vertices means, and how it blurs.

use crate::elements::Subdivision;
use crate::map::Standing;
use crate::units::Rgb;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// Integrals of the hat functions of elements, over those vertices of each that are read.
pub(super) struct Hats {
    areas_m2: Vec<f64>,
    /// Elements all of whose vertices are known and of one standing, and their areas.
    known: Vec<([u32; 3], f64)>,
}

/// A quantity on vertices.
pub(super) trait Quantity:
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

impl Hats {
    /// Of the leaves, with what vertices stand for.
    pub(super) fn new(subdivision: &Subdivision, standings: &[Option<Standing>]) -> Self {
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

    /// Of every vertex, m2.
    pub(super) fn areas_m2(&self) -> &[f64] {
        &self.areas_m2
    }

    /// The mean of a quantity about every vertex, weighted with its hat function, from the integral.
    pub(super) fn means<T: Quantity>(&self, integrals: impl Iterator<Item = T>) -> Vec<T> {
        let mean = |(sum, &area): (T, &f64)| if area > 0.0 { sum / area } else { T::default() };
        integrals.zip(&self.areas_m2).map(mean).collect()
    }

    /// What the means would be if the quantity were the given values, interpolated.
    pub(super) fn blur<T: Quantity>(&self, values: &[T]) -> Vec<T> {
        let mut sums = vec![T::default(); values.len()];
        for (corners, area_m2) in &self.known {
            // Exact integrals of products of hats: a sixth of the area, a twelfth for two of them.
            let [a, b, c] = corners.map(|v| values[v as usize]);
            let all = a + b + c;
            for &v in corners {
                sums[v as usize] += (values[v as usize] + all) * (area_m2 / 12.0);
            }
        }
        self.means(sums.into_iter())
    }

    /// The quantity at the vertices: the means, corrected (one step of Van Cittert's deconvolution).
    pub(super) fn corrected<T: Quantity>(&self, means: &[T]) -> Vec<T> {
        let blurred = self.blur(means);
        means.iter().zip(&blurred).map(|(&mean, &again)| mean * 2.0 - again).collect()
    }
}
