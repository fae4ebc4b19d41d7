//! Sparse least squares with every unknown held to zero.

/// Steps that suffice: the conjugate gradients end when nothing is left, after some tens.
const MOST_STEPS: usize = 400;
/// They end when the residual has fallen by this factor.
const REDUCTION: f64 = 1e-8;

/// One equation: a weighted sum of unknowns that should reach a goal, for three right-hand sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    /// Unknowns and their weights; an unknown may appear twice.
    pub(super) parts: [(u32, f64); 8],
    /// What the sum should be, channel by channel.
    pub(super) goal: [f64; 3],
}

impl Row {
    /// Puts known values in the place of unknowns.
    pub(super) fn fix(&mut self, known: &[Option<[f64; 3]>]) {
        for (unknown, weight) in &mut self.parts {
            let Some(value) = known[*unknown as usize] else { continue };
            for (goal, value) in self.goal.iter_mut().zip(value) {
                *goal -= *weight * value;
            }
            *weight = 0.0;
        }
    }

    /// Multiplies the whole equation.
    pub(super) fn scale(&mut self, by: f64) {
        self.parts.iter_mut().for_each(|(_, weight)| *weight *= by);
        self.goal.iter_mut().for_each(|goal| *goal *= by);
    }
}

/// The unknowns x that minimize the sum over rows of (row x - goal)^2 plus the sum of (x / held)^2: conjugate gradients
/// on the normal equations, scaled by their diagonal (Hestenes and Stiefel 1952). Sums in a fixed order.
pub(super) fn solve(rows: &[Row], held: &[f64]) -> Vec<[f64; 3]> {
    let channels: Vec<Vec<f64>> = (0..3).map(|channel| one(rows, held, channel)).collect();
    (0..held.len()).map(|k| [channels[0][k], channels[1][k], channels[2][k]]).collect()
}

fn one(rows: &[Row], held: &[f64], channel: usize) -> Vec<f64> {
    let count = held.len();
    let diagonal = diagonal(rows, held);
    let mut residual = vec![0.0; count];
    for row in rows {
        for (unknown, weight) in row.parts {
            residual[unknown as usize] += weight * row.goal[channel];
        }
    }
    let mut x = vec![0.0; count];
    let scaled = |residual: &[f64]| -> Vec<f64> {
        residual.iter().zip(&diagonal).map(|(r, d)| r / d).collect()
    };
    let mut z = scaled(&residual);
    let mut direction = z.clone();
    let mut power = dot(&residual, &z);
    let enough = power * REDUCTION * REDUCTION;
    for _ in 0..MOST_STEPS {
        if power <= enough {
            break;
        }
        let image = normal(rows, held, &direction);
        let step = power / dot(&direction, &image);
        for k in 0..count {
            x[k] += step * direction[k];
            residual[k] -= step * image[k];
        }
        z = scaled(&residual);
        let next = dot(&residual, &z);
        let keep = next / power;
        power = next;
        for k in 0..count {
            direction[k] = z[k] + keep * direction[k];
        }
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The normal equations applied to a vector.
fn normal(rows: &[Row], held: &[f64], x: &[f64]) -> Vec<f64> {
    let mut image: Vec<f64> = x.iter().zip(held).map(|(x, held)| x / (held * held)).collect();
    for row in rows {
        let sum: f64 = row.parts.iter().map(|(unknown, w)| w * x[*unknown as usize]).sum();
        for (unknown, weight) in row.parts {
            image[unknown as usize] += weight * sum;
        }
    }
    image
}

/// Their diagonal. An unknown that stands in a row twice counts with the sum of its weights; the squares of the parts
/// are near enough for scaling.
fn diagonal(rows: &[Row], held: &[f64]) -> Vec<f64> {
    let mut diagonal: Vec<f64> = held.iter().map(|held| 1.0 / (held * held)).collect();
    for row in rows {
        for (unknown, weight) in row.parts {
            diagonal[unknown as usize] += weight * weight;
        }
    }
    diagonal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_values_meet_where_their_errors_say() {
        // x0 = 10 with error 1 and x1 = 16 with error 2 must agree: in the mean weighted by 1 / error^2, 11.2.
        let mut row = Row { parts: [(0, 0.0); 8], goal: [6.0, 0.0, -6.0] };
        row.parts[0] = (0, 1.0);
        row.parts[1] = (1, -1.0);
        row.scale(100.0);
        let found = solve(&[row], &[1.0, 2.0]);
        // Held at a hundredth of an error: the answer is off by a ten-thousandth of the 6 between them, at most.
        assert!((found[0][0] - 1.2).abs() < 6e-4 && (found[1][0] + 4.8).abs() < 6e-4, "{found:?}");
        assert_eq!(found[0][1], 0.0);
        // The second stopped at 1: the first makes up for all of the rest.
        row.fix(&[None, Some([-1.0, 0.0, 0.0])]);
        assert!((solve(&[row], &[1.0, 2.0])[0][0] - 5.0).abs() < 6e-4);
        assert!((found[0][2] + 1.2).abs() < 6e-4);
    }
}
