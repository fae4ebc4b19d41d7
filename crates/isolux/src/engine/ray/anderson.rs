//! Fixed points in few sweeps (Anderson 1965, "Iterative procedures for nonlinear integral equations").
//!
//! The light between walls fades as a whole from sweep to sweep, and slower than anything else that is wrong with it. The last
//! few sweeps tell how what is changed answers to changes of light; the next light is the one that would be changed
//! least if it answered so again. On linear problems that is GMRES over as many directions (Walker and Ni 2011).

use crate::ablation::without;
use crate::units::Rgb;
use rayon::prelude::*;
use std::collections::VecDeque;

/// Sweeps that are remembered.
const DEPTH: usize = 3;

/// A direction of which less than this is left by those before, in the square, says nothing new.
const LEAST_PIVOT: f64 = 1e-10;

/// Values of one part of the sums: always the same, so that they are.
const CHUNK: usize = 4096;

/// What the last sweeps have told.
pub(crate) struct Anderson {
    /// The last image of the light, and what was changed.
    before: Option<(Vec<Rgb>, Vec<Rgb>)>,
    /// From sweep to sweep, the change of the image, and that of what was changed.
    steps: VecDeque<(Vec<Rgb>, Vec<Rgb>)>,
}

impl Anderson {
    /// Nothing told yet.
    pub(crate) const fn new() -> Self {
        Self { before: None, steps: VecDeque::new() }
    }

    /// The light to go on with, after some light and its image. Changes count by the weights: one over the light has dim rooms settle as
    /// bright ones do.
    pub(crate) fn next(&mut self, light: &[Rgb], image: Vec<Rgb>, weights: &[f64]) -> Vec<Rgb> {
        let change = minus(&image, light);
        if let Some((image_before, change_before)) = &self.before {
            let now = dot(&change, &change, weights);
            let then = dot(change_before, change_before, weights);
            if now.luminance() > then.luminance() || without("anderson") {
                // It did not answer as before.
                self.steps.clear();
            } else {
                let step = (minus(&image, image_before), minus(&change, change_before));
                self.steps.push_back(step);
                if self.steps.len() > DEPTH {
                    self.steps.pop_front();
                }
            }
        }
        let shares = self.shares(&change, weights);
        let one = |k: usize| {
            let undone = |((image, _), &share): (&(Vec<Rgb>, _), &Rgb)| image[k] * share;
            let mixed = image[k] - self.steps.iter().zip(&shares).map(undone).sum::<Rgb>();
            // There is no light below none: a sweep alone goes on there.
            let held = |c: usize| if mixed.0[c] < 0.0 { image[k].0[c] } else { mixed.0[c] };
            Rgb([0, 1, 2].map(held))
        };
        let next = (0..image.len()).into_par_iter().with_min_len(CHUNK).map(one).collect();
        self.before = Some((image, change));
        next
    }

    /// How much of each step to take back, channel by channel, so that the least is changed: least squares by
    /// the normal equations.
    fn shares(&self, change: &[Rgb], weights: &[f64]) -> Vec<Rgb> {
        let count = self.steps.len();
        let product = |row: usize, column: usize| -> Rgb {
            let of = |k: usize| self.steps.get(k).map_or(change, |step| &step.1);
            if row < count { dot(of(row), of(column), weights) } else { Rgb::BLACK }
        };
        // Of the rows that there are, as many columns, and the right side next to them.
        let products: [[Rgb; DEPTH + 1]; DEPTH] = std::array::from_fn(|row| {
            std::array::from_fn(
                |column| {
                    if column <= count { product(row, column) } else { Rgb::BLACK }
                },
            )
        });
        let mut shares = vec![Rgb::BLACK; count];
        for channel in 0..3 {
            let rows = products.map(|row| row.map(|p| p.0[channel]));
            let solved = solved(rows, count);
            shares.iter_mut().zip(solved).for_each(|(share, value)| share.0[channel] = value);
        }
        shares
    }
}

/// The weighted sum of products, part by part in their order, whoever adds them up.
fn dot(a: &[Rgb], b: &[Rgb], weights: &[f64]) -> Rgb {
    let part = |((a, b), weights): ((&[Rgb], &[Rgb]), &[f64])| -> Rgb {
        let products = a.iter().zip(b).zip(weights);
        products.map(|((&a, &b), &weight)| a * b * (weight * weight)).sum()
    };
    let all = a.par_chunks(CHUNK).zip(b.par_chunks(CHUNK)).zip(weights.par_chunks(CHUNK));
    let parts: Vec<Rgb> = all.map(part).collect();
    parts.into_iter().sum()
}

/// The solution of `count` equations, whose right sides come last; zero for unknowns that the others leave open.
fn solved(mut rows: [[f64; DEPTH + 1]; DEPTH], count: usize) -> [f64; DEPTH] {
    let mut found = [false; DEPTH];
    let diagonal: [f64; DEPTH] = std::array::from_fn(|k| rows[k][k]);
    // The latest first: it says most.
    for k in (0..count).rev() {
        if rows[k][k] <= LEAST_PIVOT * diagonal[k] || rows[k][k] <= 0.0 {
            continue;
        }
        found[k] = true;
        let pivot = rows[k];
        for (_, row) in rows.iter_mut().enumerate().filter(|&(other, _)| other != k) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(pivot).for_each(|(value, of_pivot)| *value -= factor * of_pivot);
        }
    }
    std::array::from_fn(|k| if found[k] { rows[k][count] / rows[k][k] } else { 0.0 })
}

fn minus(a: &[Rgb], b: &[Rgb]) -> Vec<Rgb> {
    a.par_iter().zip(b).with_min_len(CHUNK).map(|(&a, &b)| a - b).collect()
}
