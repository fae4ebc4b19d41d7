//! The maximum principle: a value made from others lies between the least and the greatest of them.
//!
//! Fits and extrapolation have negative weights. They may return more light than there is anywhere, or less than
//! none, and light that is reflected again and again then has no bound. A value bounded by those that it is made from
//! is a mean of two of them, with weights that are not negative and sum to one. So is every mean of such means. Over
//! surfaces that reflect less than one, a sweep of the fixed point then returns less than it receives (Harten 1983,
//! "High resolution schemes for hyperbolic conservation laws"; Kuzmin, Turek 2002, on limiters with weights of one
//! sign).
//!
//! The two values depend on the light, so that sweeps may go on and on from one pair to another. [`Bounded`] keeps
//! the pairs reached: over these exactly one fixed point exists, and every sweep comes nearer to it.

use super::MIN_TASK_LENGTH;
use crate::units::Rgb;
use rayon::prelude::*;

/// The least and the greatest of some values, channel by channel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    low: Rgb,
    high: Rgb,
}

impl Range {
    /// The range of one value.
    #[inline]
    pub(crate) const fn of(value: Rgb) -> Self {
        Self { low: value, high: value }
    }

    /// Extends the range to one more value.
    #[inline]
    pub(crate) fn include(&mut self, value: Rgb) {
        (self.low, self.high) = (self.low.lesser(value), self.high.greater(value));
    }

    /// The difference of the greatest and the least.
    #[inline]
    pub(crate) fn width(&self) -> Rgb {
        self.high - self.low
    }

    /// The value within the range that is nearest to `value`.
    #[inline]
    pub(crate) fn hold(&self, value: Rgb) -> Rgb {
        value.greater(self.low).lesser(self.high)
    }
}

/// The least share of light that a correction leaves before it is bounded.
const LEAST_LEFT_SHARE: f64 = 1.0 / 16.0;

/// Light with a correction that removes no more than there is: the control variate of walls, or the slope about a
/// mean. Where less than [`LEAST_LEFT_SHARE`] would be left, the result falls like one over the removed light, without
/// a kink, and stays positive. It grows no faster than the light. The bound never leaves less than the plain sum, so
/// it adds light in the mean: the less, the less often it acts.
pub(crate) fn corrected(light: Rgb, by: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| {
        let (light, by) = (light.0[c], by.0[c]);
        let is_plain = light < 0.0 || by >= -(1.0 - LEAST_LEFT_SHARE) * light;
        let left = || {
            LEAST_LEFT_SHARE * LEAST_LEFT_SHARE * light * light
                / (-by - (1.0 - 2.0 * LEAST_LEFT_SHARE) * light)
        };
        if is_plain { light + by } else { left() }
    }))
}

/// The values that a value is made from, each with its number.
pub(crate) type Stencil = Vec<(u32, Rgb)>;

/// Values as means of two others each, with fixed weights.
pub(crate) struct Bounded {
    /// The means of each value, by channel.
    means: Vec<[Mean; 3]>,
}

/// The mean of two values.
#[derive(Clone, Copy, Debug)]
struct Mean {
    vertices: [u32; 2],
    /// The weight of the second; the first has the rest.
    share: f64,
}

impl Bounded {
    /// The means for values that lie within the range of others, see [`Range`]; `from` appends the values that bound
    /// a value.
    pub(crate) fn of(values: &[Rgb], from: impl Fn(usize, &mut Stencil) + Sync) -> Self {
        let one = |some: &mut Stencil, k: usize| {
            some.clear();
            from(k, some);
            [0, 1, 2].map(|channel| Mean::of(values[k].0[channel], some, channel))
        };
        Self { means: (0..values.len()).into_par_iter().map_init(Stencil::new, one).collect() }
    }

    /// The means with other values in place of those.
    pub(crate) fn apply(&self, values: &[Rgb]) -> Vec<Rgb> {
        self.some(0..self.means.len(), values)
    }

    /// The means in a range of indices.
    pub(crate) fn some(&self, some: std::ops::Range<usize>, values: &[Rgb]) -> Vec<Rgb> {
        let one = |means: &[Mean; 3]| {
            Rgb([0, 1, 2].map(|channel| {
                let Mean { vertices, share } = means[channel];
                let [a, b] = vertices.map(|v| values[v as usize].0[channel]);
                (1.0 - share) * a + share * b
            }))
        };
        self.means[some].par_iter().with_min_len(MIN_TASK_LENGTH).map(one).collect()
    }
}

impl Mean {
    /// The mean of the least and the greatest of some values that equals `value` within their range.
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
