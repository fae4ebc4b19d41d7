//! Three channels of linear Rec. 709.

use serde::{Deserialize, Serialize};
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// A quantity in three channels of linear Rec. 709: a reflectance, an illuminance, an intensity.
///
/// Of a photometric quantity, [`Rgb::luminance`] is the photometric value (lux, candela, ...).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Rgb(pub [f64; 3]);

impl Rgb {
    /// Nothing.
    pub const BLACK: Self = Self::grey(0.0);
    /// One in every channel.
    pub const WHITE: Self = Self::grey(1.0);
    /// Luminance weights of the Rec. 709 primaries (ITU-R BT.709-6, item 3.2).
    pub const LUMINANCE_WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];

    /// The same value in every channel.
    pub const fn grey(value: f64) -> Self {
        Self([value; 3])
    }

    /// The three channels.
    pub const fn new(red: f64, green: f64, blue: f64) -> Self {
        Self([red, green, blue])
    }

    /// The luminance-weighted sum: the photometric value.
    pub const fn luminance(self) -> f64 {
        let [r, g, b] = self.0;
        let [wr, wg, wb] = Self::LUMINANCE_WEIGHTS;
        wr * r + wg * g + wb * b
    }

    /// The largest channel.
    pub const fn max_channel(self) -> f64 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }

    /// The smallest channel.
    pub const fn min_channel(self) -> f64 {
        self.0[0].min(self.0[1]).min(self.0[2])
    }

    /// Whether every channel is zero.
    pub const fn is_black(self) -> bool {
        self.0[0] == 0.0 && self.0[1] == 0.0 && self.0[2] == 0.0
    }

    /// Whether no channel is infinite or NaN.
    pub const fn is_finite(self) -> bool {
        self.0[0].is_finite() && self.0[1].is_finite() && self.0[2].is_finite()
    }

    /// Each channel through a function.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    /// The smaller of two, channel by channel.
    pub fn min(self, other: Self) -> Self {
        Self([0, 1, 2].map(|k| self.0[k].min(other.0[k])))
    }

    /// The lesser of two, channel by channel, neither of which is NaN.
    #[inline]
    pub(crate) fn lesser(self, other: Self) -> Self {
        // One instruction, where `f64::min` has to look for NaN.
        Self([0, 1, 2].map(|k| if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] }))
    }

    /// The greater.
    #[inline]
    pub(crate) fn greater(self, other: Self) -> Self {
        Self([0, 1, 2].map(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }

    /// The colour scaled to luminance one; white where it has none.
    pub fn chromaticity(self) -> Self {
        let luminance = self.luminance();
        if luminance > 0.0 { self * (1.0 / luminance) } else { Self::WHITE }
    }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self([self.0[0] + o.0[0], self.0[1] + o.0[1], self.0[2] + o.0[2]])
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl Sub for Rgb {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }
}

impl Mul for Rgb {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self([self.0[0] * o.0[0], self.0[1] * o.0[1], self.0[2] * o.0[2]])
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        self.map(|c| c * s)
    }
}

impl Div<f64> for Rgb {
    type Output = Self;
    fn div(self, s: f64) -> Self {
        self.map(|c| c / s)
    }
}

impl Sum for Rgb {
    fn sum<I: Iterator<Item = Self>>(items: I) -> Self {
        items.fold(Self::BLACK, Add::add)
    }
}
