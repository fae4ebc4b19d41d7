//! `E = D + rho K E` for any reflectance from one sequence of applications of K.
//!
//! The Krylov space of K and D is the same for every rho, so Arnoldi's basis is built once and the
//! small projected system solved per reflectance (full orthogonalization method; Saad 2003,
//! "Iterative Methods for Sparse Linear Systems", 6.4).

use super::transport::Transport;

/// An orthonormal basis of the space spanned by D, K D, K^2 D, ...
#[derive(Clone, Debug)]
pub(super) struct Krylov {
    basis: Vec<Vec<f64>>,
    /// `hessenberg[column][row]`: K in the basis.
    hessenberg: Vec<Vec<f64>>,
    norm: f64,
}

impl Krylov {
    pub(super) fn new(transport: &Transport, direct: &[f64], size: usize) -> Self {
        let norm = transport.mean_product(direct, direct).sqrt();
        let mut basis = vec![scaled(direct, 1.0 / norm)];
        let mut hessenberg = Vec::new();
        for k in 0..size {
            let mut next = transport.apply(&basis[k]);
            let mut column = vec![0.0; k + 2];
            // Twice is enough to be orthogonal to rounding.
            for _ in 0..2 {
                for (entry, vector) in column.iter_mut().zip(&basis) {
                    let overlap = transport.mean_product(&next, vector);
                    *entry += overlap;
                    next.iter_mut().zip(vector).for_each(|(n, v)| *n -= overlap * v);
                }
            }
            let length = transport.mean_product(&next, &next).sqrt();
            column[k + 1] = length;
            hessenberg.push(column);
            basis.push(scaled(&next, 1.0 / length));
        }
        Self { basis, hessenberg, norm }
    }

    /// The solution for a reflectance, and the mean square residual relative to it.
    pub(super) fn solve(&self, rho: f64) -> (Vec<f64>, f64) {
        let size = self.hessenberg.len();
        let entry = |row: usize, column: usize| {
            let h = self.hessenberg[column].get(row).copied().unwrap_or(0.0);
            f64::from(row == column) - rho * h
        };
        let mut rows: Vec<Vec<f64>> =
            (0..size).map(|r| (0..size).map(|c| entry(r, c)).collect()).collect();
        let mut right = vec![0.0; size];
        right[0] = self.norm;
        let y = solve_hessenberg(&mut rows, right);
        let mut solution = vec![0.0; self.basis[0].len()];
        for (weight, vector) in y.iter().zip(&self.basis) {
            solution.iter_mut().zip(vector).for_each(|(s, v)| *s += weight * v);
        }
        let last = self.hessenberg[size - 1][size];
        let length = y.iter().map(|c| c * c).sum::<f64>().sqrt();
        (solution, (rho * last * y[size - 1]).abs() / length)
    }
}

/// Gaussian elimination of a matrix with one subdiagonal. Its diagonal dominates (the norm of rho K
/// is below one), so no pivot is sought.
fn solve_hessenberg(rows: &mut [Vec<f64>], mut right: Vec<f64>) -> Vec<f64> {
    let size = right.len();
    for k in 0..size - 1 {
        let factor = rows[k + 1][k] / rows[k][k];
        let (upper, lower) = rows.split_at_mut(k + 1);
        lower[0].iter_mut().zip(&upper[k]).skip(k).for_each(|(l, u)| *l -= factor * u);
        right[k + 1] -= factor * right[k];
    }
    for k in (0..size).rev() {
        let known: f64 = (k + 1..size).map(|c| rows[k][c] * right[c]).sum();
        right[k] = (right[k] - known) / rows[k][k];
    }
    right
}

fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}
