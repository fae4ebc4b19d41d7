//! Distributions behind verdicts.

mod binomial;
mod chi_square;
mod normal;
mod special;
mod student;

pub use binomial::{accepted_outliers, binomial_interval, binomial_tail};
pub use chi_square::chi_square_cdf;
pub use normal::{normal_cdf, normal_quantile};
pub use student::{student_cdf, student_quantile, student_two_sided};

/// The argument at which an increasing function reaches a value: bisection to the last bit.
fn invert(value: f64, low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, high);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if f(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
}
