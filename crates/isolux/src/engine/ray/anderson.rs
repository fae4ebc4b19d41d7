//! Anderson acceleration of fixed points (Anderson 1965, "Iterative procedures for nonlinear integral
//! equations").
//!
//! The error that decays most slowly from sweep to sweep is the overall level of interreflected light. The
//! last few sweeps tell how the residual answers to changes of the light. The next light is the one with the
//! smallest residual, if the residual answers in the same way again. On linear problems this is GMRES over as
//! many directions (Walker and Ni 2011).

use crate::ablation::without;
use crate::units::Rgb;
use rayon::prelude::*;
use std::collections::VecDeque;

/// Number of earlier sweeps that are remembered. With three, fixed points take 6 to 9 sweeps, where one
/// extrapolation every three sweeps took 12 to 16 (decision 22).
const DEPTH: usize = 3;

/// The share of the square of a direction that must be independent of those before. A direction with less
/// adds nothing.
const LEAST_PIVOT_SHARE: f64 = 1e-10;

/// Values in one partial sum. It is fixed, so that the order of summation is always the same.
const SUMMED_VALUES: usize = 4096;

/// The state of the acceleration: the last sweeps.
pub(crate) struct Anderson {
    /// The last image of the light and its residual (image minus light).
    before: Option<(Vec<Rgb>, Vec<Rgb>)>,
    /// Differences of the image and of the residual between consecutive sweeps.
    steps: VecDeque<(Vec<Rgb>, Vec<Rgb>)>,
}

impl Anderson {
    /// The state before the first sweep.
    pub(crate) const fn new() -> Self {
        Self { before: None, steps: VecDeque::new() }
    }

    /// The light for the next sweep, from the last light and its image. `weights` scale the residual: the
    /// inverse of the light makes dim rooms converge as bright ones do.
    pub(crate) fn next(&mut self, light: &[Rgb], image: Vec<Rgb>, weights: &[f64]) -> Vec<Rgb> {
        let change = minus(&image, light);
        if let Some((image_before, change_before)) = &self.before {
            let now = dot(&change, &change, weights);
            let then = dot(change_before, change_before, weights);
            if now.luminance() > then.luminance() || without("anderson") {
                // The residual grew: the earlier steps no longer predict its answer.
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
            // Negative light is impossible: such a channel takes the plain image.
            let held = |c: usize| if mixed.0[c] < 0.0 { image[k].0[c] } else { mixed.0[c] };
            Rgb([0, 1, 2].map(held))
        };
        let next = (0..image.len()).into_par_iter().with_min_len(SUMMED_VALUES).map(one).collect();
        self.before = Some((image, change));
        next
    }

    /// The share of each step to take back, by channel, for the smallest residual: least squares by the
    /// normal equations.
    fn shares(&self, change: &[Rgb], weights: &[f64]) -> Vec<Rgb> {
        let count = self.steps.len();
        let product = |row: usize, column: usize| -> Rgb {
            let of = |k: usize| self.steps.get(k).map_or(change, |step| &step.1);
            if row < count { dot(of(row), of(column), weights) } else { Rgb::BLACK }
        };
        // A square matrix of `count` rows, with the right side in the next column.
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

/// The weighted inner product. Its partial sums are added in a fixed order, for any number of threads.
fn dot(a: &[Rgb], b: &[Rgb], weights: &[f64]) -> Rgb {
    let part = |((a, b), weights): ((&[Rgb], &[Rgb]), &[f64])| -> Rgb {
        let products = a.iter().zip(b).zip(weights);
        products.map(|((&a, &b), &weight)| a * b * (weight * weight)).sum()
    };
    let all = a
        .par_chunks(SUMMED_VALUES)
        .zip(b.par_chunks(SUMMED_VALUES))
        .zip(weights.par_chunks(SUMMED_VALUES));
    let parts: Vec<Rgb> = all.map(part).collect();
    parts.into_iter().sum()
}

/// The solution of `count` equations whose right sides are the last column; zero for unknowns that are
/// undetermined.
fn solved(mut rows: [[f64; DEPTH + 1]; DEPTH], count: usize) -> [f64; DEPTH] {
    let mut found = [false; DEPTH];
    let diagonal: [f64; DEPTH] = std::array::from_fn(|k| rows[k][k]);
    // The latest step comes first as pivot: it tells the most.
    for k in (0..count).rev() {
        if rows[k][k] <= LEAST_PIVOT_SHARE * diagonal[k] || rows[k][k] <= 0.0 {
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
    a.par_iter().zip(b).with_min_len(SUMMED_VALUES).map(|(&a, &b)| a - b).collect()
}
