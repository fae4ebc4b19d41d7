//! Warps: sample, inverse and density tell the same story.

mod chi_square;
mod ggx;
mod hemisphere;
mod spherical_triangle;

use super::Key;

/// Independent uniform points of the unit square.
fn squares(seed: u64, count: usize) -> impl Iterator<Item = [f64; 2]> {
    let key = Key::new(seed);
    (0..count as u64).map(move |k| [key.with(2 * k).uniform(), key.with(2 * k + 1).uniform()])
}
