//! Sums that do not depend on their order.
//!
//! A contribution is scaled to fixed point and added to integers, so that addition is associative:
//! any order, any number of threads, any machine gives the same bits, and sums of disjoint
//! increments merge by addition.
//!
//! One unit is 2^-24 of the scene's reference illuminance (rounded up to a power of two). A value of
//! one increment is held to 2^47 units (eight million times the reference; brighter values saturate),
//! its square to 2^94. So 2^15 increments fit the 63 bits of a sum, and 2^15 times their sum of
//! squares fits 127. Rounding adds at most half a unit an increment: 3e-8 of the reference. Where much less light is expected than that, as in
//! a dim room beside a bright one, the unit is as much smaller, by 2^14 at most, and values are held to five hundred times the
//! reference still.

use crate::units::Rgb;

const UNITS_OF_REFERENCE: f64 = (1u64 << 24) as f64;
const LARGEST: f64 = (1u64 << 47) as f64;
/// Halvings of the unit at most where there is little light.
const MOST_HALVINGS: u8 = 14;

/// Increments that one accumulator can hold.
pub(crate) const MAX_INCREMENTS: u64 = 1 << 15;

/// The light at one receiver in one increment, lx.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sample {
    /// From luminaires, without caustics.
    pub(crate) direct: Rgb,
    /// From luminaires, by particles.
    pub(crate) caustic: Rgb,
    /// After diffuse reflections.
    pub(crate) indirect: Rgb,
    /// What others read of it, photometric: as far as they have what it errs by in common.
    pub(crate) passed_on: f64,
}

/// What an increment took, and what it left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Effort {
    /// Rays traced.
    pub(crate) rays: u64,
    /// Mean illuminance that paths given up would have brought to the surfaces, before it is
    /// reflected there, lx.
    pub(crate) given_up_lx: f64,
}

/// Sums of one receiver, in units of its run's fixed point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sums {
    /// Direct, caustic, indirect; three channels each.
    pub values: [i64; 9],
    /// Photometric total, photometric indirect and caustic part, and what others read of it: rounded by themselves, so not
    /// quite what the channels make.
    pub totals: [i64; 3],
    /// Squares of those.
    pub squares: [i128; 3],
}

/// Sums of many receivers over increments.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Accumulator {
    lux_per_unit: f64,
    /// How often that is halved at every receiver; nowhere if empty.
    halvings: Vec<u8>,
    pub(crate) increments: u64,
    pub(crate) sums: Vec<Sums>,
    /// Whether something was added that is no number, which sums do not show.
    has_nan: bool,
}

/// Mean and variance of the mean at one receiver.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Estimate {
    pub(crate) mean: Sample,
    /// Variance of the mean of the photometric total, lx2.
    pub(crate) variance: f64,
    /// The same of the indirect part and the caustics.
    pub(crate) indirect_variance: f64,
    /// What of that comes from the surfaces that light comes from, which is common to all that see them.
    pub(crate) common_variance: f64,
}

impl Estimate {
    /// With a further independent standard error of indirect light.
    pub(crate) fn in_doubt_by(mut self, lx: f64) -> Self {
        self.variance += lx * lx;
        self.indirect_variance += lx * lx;
        self
    }
}

impl Accumulator {
    /// No increments yet; `reference_lx` sets the unit.
    pub(crate) fn new(receivers: usize, reference_lx: f64) -> Self {
        let exponent = libm::ceil(libm::log2(reference_lx.max(1e-30)));
        let reference = libm::exp2(exponent);
        Self {
            lux_per_unit: reference / UNITS_OF_REFERENCE,
            halvings: Vec::new(),
            increments: 0,
            sums: vec![Sums::default(); receivers],
            has_nan: false,
        }
    }

    /// The same with units for so much light as is expected at every receiver; where none is, nothing is known.
    pub(crate) fn expecting(self, about_lx: impl Iterator<Item = f64>) -> Self {
        let reference_lx = self.lux_per_unit * UNITS_OF_REFERENCE;
        let halvings = |lx: f64| {
            if lx > 0.0 {
                libm::log2(reference_lx / lx).floor().clamp(0.0, MOST_HALVINGS.into())
            } else {
                0.0
            }
        };
        Self { halvings: about_lx.map(|lx| halvings(lx) as u8).collect(), ..self }
    }

    fn halvings_at(&self, receiver: usize) -> u8 {
        self.halvings.get(receiver).copied().unwrap_or(0)
    }

    fn lux_per_unit_at(&self, receiver: usize) -> f64 {
        self.lux_per_unit * libm::exp2(-f64::from(self.halvings_at(receiver)))
    }

    /// Adds one increment: one sample a receiver.
    pub(crate) fn add(&mut self, samples: impl IntoIterator<Item = Sample>) {
        let of_all = 1.0 / self.lux_per_unit;
        for (receiver, (sums, sample)) in self.sums.iter_mut().zip(samples).enumerate() {
            let halvings = self.halvings.get(receiver).copied().unwrap_or(0);
            let scale = of_all * f64::from(1_u32 << halvings);
            let parts = [sample.direct, sample.caustic, sample.indirect];
            let channels = parts.iter().flat_map(|part| part.0);
            for (sum, value) in sums.values.iter_mut().zip(channels) {
                *sum += fixed(value * scale);
            }
            let indirect = (sample.indirect + sample.caustic).luminance();
            let total = indirect + sample.direct.luminance();
            self.has_nan |= total.is_nan();
            for (k, value) in [total, indirect, sample.passed_on].into_iter().enumerate() {
                let units = fixed(value * scale);
                sums.totals[k] += units;
                sums.squares[k] += i128::from(units) * i128::from(units);
            }
        }
        self.increments += 1;
    }

    /// Three channels of the sums of a receiver, from place `first` on, lx.
    pub(crate) fn part(&self, receiver: usize, first: usize) -> Rgb {
        let values = &self.sums[receiver].values;
        Rgb([0, 1, 2].map(|c| values[first + c] as f64 * self.lux_per_unit_at(receiver)))
    }

    /// Adds to them alone.
    pub(crate) fn add_part(&mut self, receiver: usize, first: usize, lx: Rgb) {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        for (channel, value) in lx.0.into_iter().enumerate() {
            let sum = &mut self.sums[receiver].values[first + channel];
            // Sums from a file may be anything.
            *sum = sum.saturating_add(fixed(value / lux_per_unit));
        }
    }

    /// Adds to a variance that is kept instead of squares, lx2.
    pub(crate) fn add_variance(&mut self, receiver: usize, lx2: f64) {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        let units = lx2 / (lux_per_unit * lux_per_unit);
        let sum = &mut self.sums[receiver].squares[0];
        *sum = sum.saturating_add(fixed(units).into());
    }

    /// That variance, lx2.
    pub(crate) fn variance_at(&self, receiver: usize) -> f64 {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        self.sums[receiver].squares[0].max(0) as f64 * lux_per_unit * lux_per_unit
    }

    /// Counts one more.
    pub(crate) fn count(&mut self, receiver: usize) {
        let sum = &mut self.sums[receiver].totals[0];
        *sum = sum.saturating_add(1);
    }

    /// How often that was.
    pub(crate) fn count_at(&self, receiver: usize) -> i64 {
        self.sums[receiver].totals[0]
    }

    /// The mean of indirect light at a receiver, photometric; NaN as soon as any light added was.
    pub(crate) fn indirect_lx(&self, receiver: usize) -> f64 {
        if self.has_nan {
            f64::NAN
        } else {
            self.part(receiver, 6).luminance() / self.increments as f64
        }
    }

    /// Mean and its variance at a receiver, from the spread of the increments.
    pub(crate) fn estimate(&self, receiver: usize) -> Estimate {
        let Sums { values, totals, squares } = self.sums[receiver];
        let n = self.increments as f64;
        let lux_per_unit = self.lux_per_unit_at(receiver);
        let mean = |k: usize| Rgb([0, 1, 2].map(|c| values[3 * k + c] as f64 * lux_per_unit / n));
        let passed_on = totals[2] as f64 * lux_per_unit / n;
        let mean = Sample { direct: mean(0), caustic: mean(1), indirect: mean(2), passed_on };
        // Where less light is expected than units are made for, rounding may be alike in all increments.
        let is_rounded = self.halvings_at(receiver) == MOST_HALVINGS;
        let rounding = if is_rounded { 0.25 * lux_per_unit * lux_per_unit } else { 0.0 };
        let variance = |k: usize| {
            if self.increments < 2 {
                return f64::INFINITY;
            }
            // n^2 times the mean square deviation, exactly: no digits are lost to the difference,
            // and what never changes has none.
            let total = i128::from(totals[k]);
            // Sums from a file may be anything; those of a run do not saturate.
            let squares = i128::from(self.increments).saturating_mul(squares[k]);
            let spread = squares.saturating_sub(total * total).max(0);
            spread as f64 / (n * n * (n - 1.0)) * lux_per_unit * lux_per_unit + rounding
        };
        let [variance, indirect_variance, common_variance] = [0, 1, 2].map(variance);
        Estimate { mean, variance, indirect_variance, common_variance }
    }
}

/// Mean of independent values and variance of their photometric mean.
pub(crate) fn mean_and_variance(values: &[Rgb]) -> (Rgb, f64) {
    let n = values.len() as f64;
    let mean = values.iter().copied().sum::<Rgb>() / n;
    let squares: f64 = values.iter().map(|v| (*v - mean).luminance()).map(|d| d * d).sum();
    (mean, squares / (n * (n - 1.0)))
}

fn fixed(units: f64) -> i64 {
    // NaN becomes zero and infinities saturate.
    units.clamp(-LARGEST, LARGEST).round_ties_even() as i64
}
