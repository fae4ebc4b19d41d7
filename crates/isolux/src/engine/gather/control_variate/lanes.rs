//! Numbers computed side by side without branches, so that vector instructions can be used.
//!
//! Functions are polynomials on reduced ranges, interpolated at Chebyshev nodes to less than the rounding of `f64`.
//! They give the same bits on every platform.

use std::ops::{Add, Div, Mul, Sub};

/// The number of numbers side by side.
pub(super) const LANES: usize = 8;

#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes(pub(super) [f64; LANES]);

/// The coefficients of `atan(z) / z` in powers of `z^2`, for `z` up to the tangent of pi / 8.
const ATAN_COEFFICIENTS: [f64; 11] = [
    1.0,
    -0.3333333333332844,
    0.1999999999885511,
    -0.14285714180976467,
    0.11111106180455946,
    -0.09090773074808414,
    0.07689953496306857,
    -0.06640233930429408,
    0.056883492268090106,
    -0.04348052215716462,
    0.021135373157693246,
];
/// The tangent of pi / 8.
const TAN_PI_8: f64 = std::f64::consts::SQRT_2 - 1.0;

/// The coefficients of `ln((1 + s) / (1 - s)) / s` in powers of `s^2`, for ratios between the root of 1/2 and the
/// root of 2.
const LN_COEFFICIENTS: [f64; 7] = [
    2.0000000000000004,
    0.6666666666655292,
    0.40000000061741614,
    0.2857141602110767,
    0.22223434547517906,
    0.18121934431215214,
    0.16837659970680488,
];

/// The coefficients of `exp` in powers, for arguments up to half of `ln 2`.
const EXP_COEFFICIENTS: [f64; 12] = [
    1.0,
    1.0,
    0.5000000000000019,
    0.1666666666666668,
    0.04166666666648666,
    0.00833333333331949,
    0.0013888888952696516,
    0.00019841269890340666,
    2.4801485074105115e-05,
    2.7557240604663896e-06,
    2.763279054211718e-07,
    2.511015364692893e-08,
];

/// A number so large that it has no digits after the point: a number added to it is rounded to an integer.
const ROUNDING_OFFSET: f64 = (3_u64 << 51) as f64;
/// The number of bits that an `f64` stores of its mantissa.
const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;
/// The bits of the number one.
const ONE_BITS: u64 = 1.0_f64.to_bits();
/// The bits of the root of 1/2.
const ROOT_OF_HALF_BITS: u64 = std::f64::consts::FRAC_1_SQRT_2.to_bits();

impl Lanes {
    #[inline(always)]
    pub(super) const fn of(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut all = self.0;
        for own in &mut all {
            *own = f(*own);
        }
        Self(all)
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut all = self.0;
        for (own, other) in all.iter_mut().zip(&other.0) {
            *own = f(*own, *other);
        }
        Self(all)
    }

    #[inline(always)]
    pub(super) fn sum(self) -> f64 {
        self.0.iter().sum()
    }

    /// The polynomial with these coefficients, by Horner's rule.
    #[inline(always)]
    fn polynomial<const N: usize>(self, coefficients: &[f64; N]) -> Self {
        let mut value = Self::of(coefficients[N - 1]);
        for k in (0..N - 1).rev() {
            value = value * self + Self::of(coefficients[k]);
        }
        value
    }

    /// The arc tangent of numbers that are not negative.
    #[inline(always)]
    pub(super) fn atan(self) -> Self {
        let turned = self.map(|x| if x > 1.0 { 1.0 / x } else { x });
        // The angle whose tangent is `z` lies between -pi / 8 and pi / 8.
        let from_eighth = |z: f64| (z - TAN_PI_8) / (1.0 + TAN_PI_8 * z);
        let z = turned.map(from_eighth);
        let angle =
            Self::of(std::f64::consts::FRAC_PI_8) + z * (z * z).polynomial(&ATAN_COEFFICIENTS);
        self.with(
            angle,
            |x, angle| if x > 1.0 { std::f64::consts::FRAC_PI_2 - angle } else { angle },
        )
    }

    /// The natural logarithm of positive, finite, normal numbers.
    #[inline(always)]
    pub(super) fn ln(self) -> Self {
        // The powers of two in them; the remaining factor is near one.
        let twos = self.map(|x| {
            let above =
                x.to_bits().wrapping_sub(ROOT_OF_HALF_BITS).wrapping_add(ONE_BITS) >> MANTISSA_BITS;
            f64::from_bits(ROUNDING_OFFSET.to_bits() | above)
                - ROUNDING_OFFSET
                - (ONE_BITS >> MANTISSA_BITS) as f64
        });
        let left = self.map(|x| {
            let above = x.to_bits().wrapping_sub(ROOT_OF_HALF_BITS) & !((1 << MANTISSA_BITS) - 1);
            f64::from_bits(x.to_bits().wrapping_sub(above))
        });
        let s = left.map(|m| (m - 1.0) / (m + 1.0));
        twos * Self::of(std::f64::consts::LN_2) + s * (s * s).polynomial(&LN_COEFFICIENTS)
    }

    /// The exponential function of numbers up to a few hundred in magnitude.
    #[inline(always)]
    pub(super) fn exp(self) -> Self {
        let rounded = self.map(|x| x * std::f64::consts::LOG2_E + ROUNDING_OFFSET);
        let twos = rounded.map(|r| r - ROUNDING_OFFSET);
        let left = self - twos * Self::of(std::f64::consts::LN_2);
        let power =
            rounded.map(|r| f64::from_bits((r.to_bits() << MANTISSA_BITS).wrapping_add(ONE_BITS)));
        left.polynomial(&EXP_COEFFICIENTS) * power
    }

    /// The inverse hyperbolic sine.
    #[inline(always)]
    pub(super) fn asinh(self) -> Self {
        let size = self.map(f64::abs);
        let root = (size * size + Self::of(1.0)).map(f64::sqrt);
        (size + root).ln().with(self, f64::copysign)
    }
}

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for Lanes {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl Div for Lanes {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(other, |a, b| a / b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tolerance of the tests: a few roundings of `f64`.
    const TOLERANCE: f64 = 1e-15;

    /// Compares a function with `known`, with errors relative to the larger of the result and `size`.
    fn check(
        own: impl Fn(Lanes) -> Lanes,
        known: fn(f64) -> f64,
        size: fn(f64) -> f64,
        numbers: impl Iterator<Item = f64>,
    ) {
        for x in numbers {
            let (found, expected) = (own(Lanes::of(x)).0[LANES - 1], known(x));
            let least = TOLERANCE * expected.abs().max(size(x));
            assert!((found - expected).abs() <= least, "{x}: {found} {expected}");
        }
    }

    /// A geometric sequence from 1e-9 to `most`.
    fn growing(most: f64) -> impl Iterator<Item = f64> {
        std::iter::successors(Some(1e-9), |x| Some(1.013 * x)).take_while(move |x| *x < most)
    }

    #[test]
    fn functions_are_those_of_the_library() {
        let one = |_: f64| 1.0;
        check(Lanes::atan, libm::atan, one, growing(1e12).chain([0.0, 1.0]));
        check(Lanes::ln, libm::log, one, growing(1e30).chain([1.0, 2.0, 0.5]));
        let signed = |most: f64| growing(most).flat_map(|x| [-x, x]).chain([0.0]);
        check(Lanes::asinh, libm::asinh, one, signed(1e9));
        // The argument itself is rounded, which this size includes.
        let rounded = |x: f64| libm::exp(x) * (1.0 + x.abs());
        check(Lanes::exp, libm::exp, rounded, signed(24.0));
    }
}
