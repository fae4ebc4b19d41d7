//! Sums that do not depend on the order of their terms.
//!
//! A contribution is scaled to fixed point and added to integers, so that addition is associative. Any order,
//! any number of threads and any machine give the same bits. Sums of disjoint increments merge by addition.
//!
//! One unit is 2^-24 of the scene's reference illuminance (rounded up to a power of two). The value of one
//! increment is at most 2^47 units (eight million times the reference; brighter values saturate), its square
//! at most 2^94. So 2^15 increments fit the 63 bits of a sum, and 2^15 times their sum of squares fits 127
//! bits. Rounding adds at most half a unit an increment: 3e-8 of the reference. Where much less light is
//! expected, as in a dim room beside a bright one, the unit is smaller by as much, at most by 2^14. Values
//! there still reach five hundred times the reference.

use crate::units::Rgb;
use std::mem;

/// Units of the scene's reference illuminance.
pub(crate) const UNITS_OF_REFERENCE: f64 = (1u64 << 24) as f64;
/// The largest value of one increment, in units.
const LARGEST_UNITS: f64 = (1u64 << 47) as f64;
/// The most halvings of the unit, for receivers with little light.
const MOST_HALVINGS: u8 = 14;

/// The most increments that one accumulator can hold.
pub(crate) const MAX_INCREMENTS: u64 = 1 << 15;

/// The light at one receiver in one increment, lx.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sample {
    /// Light from luminaires, without caustics.
    pub(crate) direct: Rgb,
    /// Light of caustics: from luminaires, by particles.
    pub(crate) caustic: Rgb,
    /// Light after diffuse reflections.
    pub(crate) indirect: Rgb,
    /// Photometric illuminance that rays which are always the same read from the light of this increment. Its
    /// spread is the error that receivers near each other have in common.
    pub(crate) passed_on: f64,
}

/// The rays that an increment took and the light that it left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Effort {
    /// Rays traced.
    pub(crate) rays: u64,
    /// Mean illuminance that the paths given up would have brought to the surfaces, before reflection there,
    /// lx.
    pub(crate) given_up_lx: f64,
}

/// Sums of one receiver, in fixed-point units of its run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sums {
    /// Direct, caustic and indirect light, three channels each.
    pub values: [i64; 9],
    /// Three photometric sums: the total, the indirect and caustic part, and `passed_on` of the samples. Each
    /// is rounded by itself, so it differs slightly from the sum of the channels.
    pub totals: [i64; 3],
    /// Sums of the squares of these three.
    pub squares: [i128; 3],
}

impl Sums {
    /// The sums over the increments of both. Sums from a file may hold any value; those of a run do not saturate.
    pub fn plus(mut self, other: &Self) -> Self {
        let add = |into: &mut [i64], from: &[i64]| {
            into.iter_mut().zip(from).for_each(|(a, b)| *a = a.saturating_add(*b));
        };
        add(&mut self.values, &other.values);
        add(&mut self.totals, &other.totals);
        self.squares.iter_mut().zip(other.squares).for_each(|(a, b)| *a = a.saturating_add(b));
        self
    }
}

/// The sums to merge belong to another number of receivers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OtherLength;

/// Sums of many receivers over increments.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Accumulator {
    lux_per_unit: f64,
    /// Number of halvings of the unit at every receiver; empty if there are none.
    halvings: Vec<u8>,
    pub(crate) increments: u64,
    pub(crate) sums: Vec<Sums>,
    /// Whether a NaN was added, which integer sums do not show.
    has_nan: bool,
}

/// Mean at one receiver and variances of that mean.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Estimate {
    pub(crate) mean: Sample,
    /// Variance of the mean of the photometric total, lx2.
    pub(crate) variance: f64,
    /// Variance of the mean of the indirect and caustic part, lx2.
    pub(crate) indirect_variance: f64,
    /// The part of that variance that comes from the light of the elements that are read, lx2. All receivers
    /// that see them have it in common.
    pub(crate) common_variance: f64,
}

impl Estimate {
    /// The estimate with a further independent standard error of indirect light, lx.
    pub(crate) fn in_doubt_by(mut self, lx: f64) -> Self {
        self.variance += lx * lx;
        self.indirect_variance += lx * lx;
        self
    }
}

impl Accumulator {
    /// An accumulator without increments; `reference_lx` sets the unit.
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

    /// The accumulator with a unit at every receiver that suits the expected illuminance, lx. Zero means
    /// unknown.
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

    /// Adds the sums of other increments.
    pub(crate) fn merge(&mut self, sums: &[Sums], increments: u64) -> Result<(), OtherLength> {
        if self.sums.len() != sums.len() {
            return Err(OtherLength);
        }
        self.sums.iter_mut().zip(sums).for_each(|(into, from)| *into = into.plus(from));
        self.increments += increments;
        Ok(())
    }

    /// Returns the sums and goes on without increments.
    pub(crate) fn clear(&mut self) -> Vec<Sums> {
        self.increments = 0;
        let none = vec![Sums::default(); self.sums.len()];
        mem::replace(&mut self.sums, none)
    }

    /// Sum of the three channels from index `first` on in [`Sums::values`] of a receiver, lx.
    pub(crate) fn part(&self, receiver: usize, first: usize) -> Rgb {
        let values = &self.sums[receiver].values;
        Rgb([0, 1, 2].map(|c| values[first + c] as f64 * self.lux_per_unit_at(receiver)))
    }

    /// Adds to these three channels.
    pub(crate) fn add_part(&mut self, receiver: usize, first: usize, lx: Rgb) {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        for (channel, value) in lx.0.into_iter().enumerate() {
            let sum = &mut self.sums[receiver].values[first + channel];
            // Sums from a file may hold any value.
            *sum = sum.saturating_add(fixed(value / lux_per_unit));
        }
    }

    /// Adds to a variance of a receiver, lx2. It is kept in the place of the sums of squares.
    pub(crate) fn add_variance(&mut self, receiver: usize, lx2: f64) {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        let units = lx2 / (lux_per_unit * lux_per_unit);
        let sum = &mut self.sums[receiver].squares[0];
        *sum = sum.saturating_add(fixed(units).into());
    }

    /// The variance kept by [`Accumulator::add_variance`], lx2.
    pub(crate) fn variance_at(&self, receiver: usize) -> f64 {
        let lux_per_unit = self.lux_per_unit_at(receiver);
        self.sums[receiver].squares[0].max(0) as f64 * lux_per_unit * lux_per_unit
    }

    /// Adds one to a count of a receiver, kept in the place of its photometric total.
    pub(crate) fn count(&mut self, receiver: usize) {
        let sum = &mut self.sums[receiver].totals[0];
        *sum = sum.saturating_add(1);
    }

    /// The count kept by [`Accumulator::count`].
    pub(crate) fn count_at(&self, receiver: usize) -> i64 {
        self.sums[receiver].totals[0]
    }

    /// Photometric mean of indirect light at a receiver, lx; NaN once a NaN was added.
    pub(crate) fn indirect_lx(&self, receiver: usize) -> f64 {
        if self.has_nan {
            f64::NAN
        } else {
            self.part(receiver, 6).luminance() / self.increments as f64
        }
    }

    /// Mean at a receiver and variances of that mean, from the spread of the increments.
    pub(crate) fn estimate(&self, receiver: usize) -> Estimate {
        let Sums { values, totals, squares } = self.sums[receiver];
        let n = self.increments as f64;
        let lux_per_unit = self.lux_per_unit_at(receiver);
        let mean = |k: usize| Rgb([0, 1, 2].map(|c| values[3 * k + c] as f64 * lux_per_unit / n));
        let passed_on = totals[2] as f64 * lux_per_unit / n;
        let mean = Sample { direct: mean(0), caustic: mean(1), indirect: mean(2), passed_on };
        // The unit is as small as it gets: less light than it suits may round alike in all increments.
        let is_rounded = self.halvings_at(receiver) == MOST_HALVINGS;
        let rounding = if is_rounded { 0.25 * lux_per_unit * lux_per_unit } else { 0.0 };
        let variance = |k: usize| {
            if self.increments < 2 {
                return f64::INFINITY;
            }
            // n^2 times the mean square deviation, in exact integers: the difference loses no digits, and a
            // value that never changes has variance zero.
            let total = i128::from(totals[k]);
            // Sums from a file may hold any value; those of a run do not saturate.
            let squares = i128::from(self.increments).saturating_mul(squares[k]);
            let spread = squares.saturating_sub(total * total).max(0);
            spread as f64 / (n * n * (n - 1.0)) * lux_per_unit * lux_per_unit + rounding
        };
        let [variance, indirect_variance, common_variance] = [0, 1, 2].map(variance);
        Estimate { mean, variance, indirect_variance, common_variance }
    }
}

/// Mean of independent values, and the variance of its photometric value.
pub(crate) fn mean_and_variance(values: &[Rgb]) -> (Rgb, f64) {
    let n = values.len() as f64;
    let mean = values.iter().copied().sum::<Rgb>() / n;
    let squares: f64 = values.iter().map(|v| (*v - mean).luminance()).map(|d| d * d).sum();
    (mean, squares / (n * (n - 1.0)))
}

fn fixed(units: f64) -> i64 {
    // NaN becomes zero; infinities saturate.
    units.clamp(-LARGEST_UNITS, LARGEST_UNITS).round_ties_even() as i64
}
