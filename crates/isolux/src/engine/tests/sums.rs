//! Sums of increments against sums of real numbers.

use crate::engine::ray::{Accumulator, Estimate, MAX_INCREMENTS, Sample, Sums};
use crate::sampling::Key;
use crate::units::Rgb;

/// One unit of the fixed point of a reference that is a power of two.
const UNIT: f64 = 1.0 / (1u64 << 24) as f64;

fn rgb(key: Key, scale: f64) -> Rgb {
    Rgb([0, 1, 2].map(|k| scale * key.with(k).uniform()))
}

fn sample(key: Key, scale: f64) -> Sample {
    let [direct, caustic, indirect] = [0, 1, 2].map(|k| rgb(key.with(10 + k), scale));
    Sample { direct, caustic, indirect, passed_on: 0.5 * scale * key.with(13).uniform() }
}

fn total_lx(sample: &Sample) -> f64 {
    (sample.direct + sample.caustic + sample.indirect).luminance()
}

/// Sums of random increments, in the order given.
fn summed(order: impl Iterator<Item = u64>, receivers: usize) -> Accumulator {
    let mut sums = Accumulator::new(receivers, 1.0);
    for increment in order {
        let key = Key::new(7).with(increment);
        sums.add((0..receivers).map(|k| sample(key.with(k as u64), 3.0)));
    }
    sums
}

#[test]
fn sums_do_not_depend_on_the_order() {
    let forth = summed(0..100, 20);
    assert_eq!(forth, summed((0..100).rev(), 20));
    assert_eq!(forth, summed((0..100).map(|k| (k * 37) % 100), 20));
}

#[test]
fn sums_of_disjoint_increments_add() {
    let (whole, first, rest) = (summed(0..100, 20), summed(0..40, 20), summed(40..100, 20));
    let add = |(a, b): (&Sums, &Sums)| Sums {
        values: std::array::from_fn(|k| a.values[k] + b.values[k]),
        totals: std::array::from_fn(|k| a.totals[k] + b.totals[k]),
        squares: std::array::from_fn(|k| a.squares[k] + b.squares[k]),
    };
    let added: Vec<Sums> = first.sums.iter().zip(&rest.sums).map(add).collect();
    assert_eq!(added, whole.sums);
}

#[test]
fn means_and_variances_are_those_of_real_numbers() {
    let n = 64;
    let sums = summed(0..n, 50);
    for k in 0..50 {
        let samples: Vec<Sample> =
            (0..n).map(|i| sample(Key::new(7).with(i).with(k as u64), 3.0)).collect();
        let estimate = sums.estimate(k);
        for (found, part) in [
            (estimate.mean.direct, samples.iter().map(|s| s.direct).sum::<Rgb>()),
            (estimate.mean.caustic, samples.iter().map(|s| s.caustic).sum::<Rgb>()),
            (estimate.mean.indirect, samples.iter().map(|s| s.indirect).sum::<Rgb>()),
        ] {
            let expected = part / n as f64;
            for c in 0..3 {
                assert!((found.0[c] - expected.0[c]).abs() <= 0.5 * UNIT + 1e-15);
            }
        }
        let totals = samples.iter().map(total_lx);
        let (_, error) = super::mean_and_error(totals);
        // Roundings of the values by half a unit shift the mean square by a unit times their size,
        // up to 9, over n - 1.
        assert!((estimate.variance - error * error).abs() < 9.0 * UNIT / (n - 1) as f64);
        let indirect = samples.iter().map(|s| (s.indirect + s.caustic).luminance());
        let (_, error) = super::mean_and_error(indirect);
        assert!((estimate.indirect_variance - error * error).abs() < 6.0 * UNIT / (n - 1) as f64);
    }
}

#[test]
fn what_does_not_vary_has_no_error() {
    for value in [Rgb::new(0.3, 0.7, 0.11), Rgb::grey(1.0 / 3.0), Rgb::new(1e-2, 2e-2, 3e-3)] {
        let mut sums = Accumulator::new(1, 1.0);
        for _ in 0..16 {
            sums.add(std::iter::once(Sample { direct: value, ..Sample::default() }));
        }
        let error = sums.estimate(0).variance.sqrt();
        assert!(error <= UNIT, "{error} lx, {} units of rounding", error / UNIT);
    }
}

#[test]
fn rounding_is_half_a_unit_of_any_reference() {
    for reference_lx in [1e-30, 1e-6, 0.9, 1.0, 1000.0, 1e12, 1e30] {
        let mut sums = Accumulator::new(1, reference_lx);
        let value = rgb(Key::new(3), reference_lx);
        sums.add(std::iter::once(Sample { indirect: value, ..Sample::default() }));
        let found = sums.estimate(0).mean.indirect;
        for c in 0..3 {
            // The reference is rounded up to a power of two: half a unit is up to 2^-24 of it.
            let bound = 2.0 * 0.5 * UNIT * reference_lx * (1.0 + 1e-9);
            assert!((found.0[c] - value.0[c]).abs() <= bound, "{reference_lx}");
        }
    }
}

#[test]
fn what_is_too_bright_saturates_and_what_is_no_number_is_nothing() {
    let mut sums = Accumulator::new(5, 1.0);
    let values = [f64::INFINITY, f64::MAX, f64::NEG_INFINITY, f64::NAN, 8e6];
    for _ in 0..4 {
        let sample = |v: &f64| Sample { direct: Rgb::grey(*v), ..Sample::default() };
        sums.add(values.iter().map(sample));
    }
    let limit = (1u64 << 47) as f64 * UNIT;
    for (k, expected) in [limit, limit, -limit, 0.0, 8e6].into_iter().enumerate() {
        let estimate = sums.estimate(k);
        assert_eq!(estimate.mean.direct, Rgb::grey(expected));
        assert!(estimate.variance.is_finite() && estimate.variance >= 0.0);
    }
}

#[test]
fn as_many_increments_as_promised_do_not_overflow() {
    let mut sums = Accumulator::new(1, 1.0);
    let brightest = Rgb::grey(f64::MAX);
    for _ in 0..MAX_INCREMENTS {
        sums.add(std::iter::once(Sample {
            direct: brightest,
            caustic: brightest,
            indirect: brightest,
            passed_on: f64::MAX,
        }));
    }
    let Sums { values, totals, squares } = sums.sums[0];
    assert_eq!(values, [1 << (47 + 15); 9]);
    assert_eq!(totals, [1 << (47 + 15); 3]);
    assert_eq!(squares, [1 << (94 + 15); 3]);
    let Estimate { variance, indirect_variance, common_variance, .. } = sums.estimate(0);
    assert_eq!([variance, indirect_variance, common_variance], [0.0; 3]);
}

#[test]
fn one_increment_tells_no_error() {
    let mut sums = Accumulator::new(1, 1.0);
    sums.add(std::iter::once(sample(Key::new(1), 1.0)));
    assert_eq!(sums.estimate(0).variance, f64::INFINITY);
}

#[test]
fn units_are_those_of_the_light_that_is_expected() {
    let expected_lx = [0.0, 1e-9, 3e-7, 1e-3, 0.4, 1.0, 50.0];
    let mut sums = Accumulator::new(expected_lx.len(), 1.0).expecting(expected_lx.into_iter());
    let value = |lx: f64| Rgb::grey(if lx > 0.0 { lx / 3.0 } else { 300.0 });
    for _ in 0..4 {
        sums.add(expected_lx.map(|lx| Sample { indirect: value(lx), ..Sample::default() }));
    }
    for (k, lx) in expected_lx.into_iter().enumerate() {
        let Estimate { mean, variance, .. } = sums.estimate(k);
        // Half a unit, of 2^-24 of the light expected, rounded up to a power of two, or 2^-14 of that of the reference.
        let least = 1.0 / f64::from(1 << 14);
        let bound = UNIT * if lx > 0.0 { lx.clamp(least, 1.0) } else { 1.0 };
        let off = (mean.indirect - value(lx)).luminance().abs();
        assert!(off <= bound, "{lx} lx: off by {off}, {bound} allowed");
        // What is too dim for its unit tells so.
        assert!(lx == 0.0 || lx >= least || off <= variance.sqrt(), "{lx} lx: {off} off");
        assert!(lx < least || variance.sqrt() <= bound, "{lx} lx: {variance}");
    }
}

#[test]
fn light_that_is_no_number_stays_none() {
    let mut sums = Accumulator::new(2, 1.0);
    sums.add([1.0, 2.0].map(|lx| Sample { indirect: Rgb::grey(lx), ..Sample::default() }));
    assert_eq!([0, 1].map(|k| sums.indirect_lx(k)), [1.0, 2.0]);
    let direct = Rgb::new(0.0, f64::NAN, 0.0);
    sums.add([Sample { direct, ..Sample::default() }, Sample::default()]);
    assert!(sums.indirect_lx(0).is_nan());
}
