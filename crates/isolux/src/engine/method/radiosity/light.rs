//! The light that a source sends out.

use crate::units::Rgb;

/// The exitance of a node, lm/m2. It has a sign: excess light that was shot is taken back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Light {
    pub(super) mean: Rgb,
    /// The deviations from the mean at the corners of a triangle, of the linear function of least squares.
    pub(super) slopes: [Rgb; 3],
    /// The mean square of the photometric value.
    square: f64,
    /// The mean absolute photometric value.
    pub(super) size: f64,
}

impl Light {
    /// The light of an element, linear between its corners.
    pub(super) fn of_corners(corners: [Rgb; 3]) -> Self {
        let values = corners.map(Rgb::luminance);
        let mean = corners.iter().copied().sum::<Rgb>() / 3.0;
        let sum: f64 = values.iter().sum();
        Self {
            mean,
            slopes: corners.map(|value| value - mean),
            square: (sum * sum + values.iter().map(|v| v * v).sum::<f64>()) / 12.0,
            size: values.iter().map(|v| v.abs()).sum::<f64>() / 3.0,
        }
    }

    /// The light of two nodes together, each with its area.
    pub(super) fn of_both([(a_m2, a), (b_m2, b)]: [(f64, Self); 2]) -> Self {
        let share = b_m2 / (a_m2 + b_m2);
        Self {
            mean: a.mean * (1.0 - share) + b.mean * share,
            slopes: [Rgb::BLACK; 3],
            square: a.square * (1.0 - share) + b.square * share,
            size: a.size * (1.0 - share) + b.size * share,
        }
    }

    /// The light of a triangle from its halves, bisected at the edge that starts at corner `edge`.
    ///
    /// The means of the light times the barycentric coordinates determine the linear function of least
    /// squares. The coordinates are linear over the halves; two of them are one half at the middle of the
    /// edge.
    pub(super) fn of_halves(edge: usize, halves: [Self; 2]) -> Self {
        let next = (edge + 1) % 3;
        let mut products = [Rgb::BLACK; 3];
        for (half, middle) in halves.iter().zip([next, edge]) {
            for corner in 0..3 {
                let product = half.mean * (1.0 / 6.0) + half.slopes[corner] * (1.0 / 24.0);
                if corner == middle {
                    products[edge] += product * 0.5;
                    products[next] += product * 0.5;
                } else {
                    products[corner] += product;
                }
            }
        }
        let both = Self::of_both(halves.map(|half| (1.0, half)));
        Self { slopes: products.map(|p| p * 12.0 - both.mean * 4.0), ..both }
    }

    /// The mean light, weighted by a kernel that is linear between its values at the corners.
    pub(super) fn weighted(&self, kernel: [f64; 3]) -> Rgb {
        let sum: f64 = kernel.iter().sum();
        if sum <= 0.0 {
            return self.mean;
        }
        let slope: Rgb = (0..3).map(|k| self.slopes[k] * kernel[k]).sum();
        self.mean + slope * (0.25 / sum)
    }

    /// The root mean squares of the linear part of the light and of the rest beyond it.
    pub(super) fn spreads(&self) -> (f64, f64) {
        let mean = self.mean.luminance();
        // This is the mean square of a linear function whose values at the corners sum to zero.
        let slopes: f64 = self.slopes.map(Rgb::luminance).iter().map(|d| d * d / 12.0).sum();
        (slopes.sqrt(), (self.square - mean * mean - slopes).max(0.0).sqrt())
    }

    /// Whether there is no light.
    pub(super) fn is_none(&self) -> bool {
        self.size == 0.0 && self.mean.is_black()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: [f64; 3]) -> Light {
        Light::of_corners(values.map(Rgb::grey))
    }

    #[test]
    fn halves_of_a_linear_function_make_it_again() {
        let whole = grey([1.0, 4.0, 10.0]);
        for edge in 0..3 {
            let values = [1.0, 4.0, 10.0];
            let next = (edge + 1) % 3;
            let (mut first, mut second) = (values, values);
            first[next] = 0.5 * (values[edge] + values[next]);
            second[edge] = first[next];
            let found = Light::of_halves(edge, [grey(first), grey(second)]);
            assert!((found.mean.0[0] - 5.0).abs() < 1e-14, "{edge}: {found:?}");
            for corner in 0..3 {
                let off = found.slopes[corner].0[0] - whole.slopes[corner].0[0];
                assert!(off.abs() < 1e-13, "{edge} {corner}: {found:?}");
            }
            // The difference of squares keeps half of the digits.
            assert!(found.spreads().1 < 1e-6, "{edge}: {found:?}");
        }
    }

    #[test]
    fn a_linear_kernel_weighs_exactly() {
        // The mean product of two linear functions is (sum a_k b_k + sum a sum b) / 12.
        let (light, kernel) = ([1.0, 4.0, 10.0], [0.5, 2.0, 3.0]);
        let products: f64 = light.iter().zip(kernel).map(|(a, b)| a * b).sum();
        let sums = light.iter().sum::<f64>() * kernel.iter().sum::<f64>();
        let mean_of_kernel = kernel.iter().sum::<f64>() / 3.0;
        let expected = (products + sums) / 12.0 / mean_of_kernel;
        assert!((grey(light).weighted(kernel).0[0] - expected).abs() < 1e-14);
    }
}
