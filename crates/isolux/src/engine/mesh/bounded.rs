//! The maximum principle: what is made of some values lies between the least and the greatest of them.
//!
//! What fits or extrapolates has weights below zero: it may make of some light more than there is of it anywhere, or less than none,
//! and what is reflected of that again and again then has no bound. A value that is held between those that it is made from is a
//! mean of two of them, with weights that are not negative and sum to one. So is every mean of such means, and no sweep of a
//! fixed point over surfaces that reflect less than one returns as much as it receives (Harten 1983, "High resolution schemes
//! for hyperbolic conservation laws"; Kuzmin, Turek 2002, on limiters with weights of one sign).
//!
//! Which two they are depends on the light, so that sweeps may go on and on from one pair to another. [`Bounded`] keeps the
//! pairs that they have come to: over these a fixed point exists, is one, and every sweep comes nearer to it.

use crate::units::Rgb;
use rayon::prelude::*;

/// The least and the greatest of some values, channel by channel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    low: Rgb,
    high: Rgb,
}

impl Range {
    /// Of one value.
    #[inline]
    pub(crate) const fn of(value: Rgb) -> Self {
        Self { low: value, high: value }
    }

    /// Of one more.
    #[inline]
    pub(crate) fn include(&mut self, value: Rgb) {
        (self.low, self.high) = (self.low.lesser(value), self.high.greater(value));
    }

    /// From the least to the greatest.
    #[inline]
    pub(crate) fn width(&self) -> Rgb {
        self.high - self.low
    }

    /// The value within that is nearest to another.
    #[inline]
    pub(crate) fn hold(&self, value: Rgb) -> Rgb {
        value.greater(self.low).lesser(self.high)
    }
}

/// The share of light that corrections leave at least before they are bounded.
const LEFT: f64 = 1.0 / 16.0;

/// Light with a correction that takes no more off than there is: that of rays by walls, that of a mean by the slope about it. Where less
/// than [`LEFT`] would be left, that falls like one over what is taken off, without a kink, and is never nothing. What comes out grows no
/// faster than the light, of which there is some. As more is left than without the bound, and never less, it makes light in the mean: the
/// less, the seldomer it acts.
pub(crate) fn corrected(light: Rgb, by: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| {
        let (light, by) = (light.0[c], by.0[c]);
        let is_plain = light < 0.0 || by >= -(1.0 - LEFT) * light;
        let left = || LEFT * LEFT * light * light / (-by - (1.0 - 2.0 * LEFT) * light);
        if is_plain { light + by } else { left() }
    }))
}

/// What a value is made from: numbers of others, and those.
pub(crate) type Stencil = Vec<(u32, Rgb)>;

/// Values as means of two others each, with weights that stay.
pub(crate) struct Bounded {
    /// Of every value and channel.
    means: Vec<[Mean; 3]>,
}

/// The mean of two values.
#[derive(Clone, Copy, Debug)]
struct Mean {
    vertices: [u32; 2],
    /// What the second has of it.
    share: f64,
}

impl Bounded {
    /// Of values that are held between others, as [`Range`] holds them; `from` appends what one is made from.
    pub(crate) fn of(values: &[Rgb], from: impl Fn(usize, &mut Stencil) + Sync) -> Self {
        let one = |some: &mut Stencil, k: usize| {
            some.clear();
            from(k, some);
            [0, 1, 2].map(|channel| Mean::of(values[k].0[channel], some, channel))
        };
        Self { means: (0..values.len()).into_par_iter().map_init(Stencil::new, one).collect() }
    }

    /// The means of other values.
    pub(crate) fn apply(&self, values: &[Rgb]) -> Vec<Rgb> {
        self.some(0..self.means.len(), values)
    }

    /// Some of them.
    pub(crate) fn some(&self, some: std::ops::Range<usize>, values: &[Rgb]) -> Vec<Rgb> {
        let one = |means: &[Mean; 3]| {
            Rgb([0, 1, 2].map(|channel| {
                let Mean { vertices, share } = means[channel];
                let [a, b] = vertices.map(|v| values[v as usize].0[channel]);
                (1.0 - share) * a + share * b
            }))
        };
        self.means[some].par_iter().with_min_len(1024).map(one).collect()
    }
}

impl Mean {
    /// The least and the greatest of some, so that their mean is a value between.
    fn of(value: f64, some: &Stencil, channel: usize) -> Self {
        let of = |k: usize| some[k].1.0[channel];
        let (mut low, mut high) = (0, 0);
        for k in 1..some.len() {
            low = if of(k) < of(low) { k } else { low };
            high = if of(k) > of(high) { k } else { high };
        }
        let width = of(high) - of(low);
        let share = if width > 0.0 { ((value - of(low)) / width).clamp(0.0, 1.0) } else { 0.0 };
        Self { vertices: [some[low].0, some[high].0], share }
    }
}
