//! A year at one point.

use super::year::{SkyHour, Year};
use isolux::engine::{Coefficients, Daylight, ExactSettings, ProbePoint};

/// Illuminance that daylight should give, and bounds of what is useful (Mardaljevic and others 2012), lx.
pub(super) const ENOUGH_LX: f64 = 300.0;
pub(super) const USEFUL_LX: [f64; 2] = [100.0, 3000.0];
/// Direct sun that ASE counts, lx (IES LM-83-12).
pub(super) const SUNNY_LX: f64 = 1000.0;

/// A figure from all replicates, without the bias that their noise brings to thresholds and ranks, and from all but each of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Jackknifed {
    pub(super) value: f64,
    pub(super) without: Vec<f64>,
}

/// What a year brings to a point.
#[derive(Clone, Debug)]
pub(super) struct PlaceYear {
    /// Shares of the hours of use with at least [`ENOUGH_LX`].
    pub(super) autonomy: Jackknifed,
    /// Shares of the hours of use below, within (two parts, divided at [`ENOUGH_LX`]) and above [`USEFUL_LX`].
    pub(super) useful: [Jackknifed; 4],
    /// Hours of use with more than [`SUNNY_LX`] of direct sun.
    pub(super) sunny_h: f64,
    /// Illuminance that half of the hours of daylight exceed, lx.
    pub(super) median_lx: Jackknifed,
    /// Daylight factor below the CIE overcast sky: of light that comes straight from the sky, and of all.
    pub(super) sky_component: Jackknifed,
    pub(super) daylight_factor: Jackknifed,
}

impl PlaceYear {
    /// Traces a point and sums its year.
    pub(super) fn of(
        daylight: &Daylight<'_>,
        at: ProbePoint,
        year: &Year,
        settings: &ExactSettings,
    ) -> Self {
        let found = daylight.coefficients(at, &year.patches, settings);
        let sunny: Vec<f64> = year
            .hours
            .iter()
            .map(|hour| match hour.sun_normal_lx {
                0.0 => 0.0,
                normal_lx => normal_lx * daylight.share_of_sun(at, hour.sun),
            })
            .collect();
        let of_replicates: Vec<Vec<f64>> =
            found.iter().map(|of| hours_lx(of, year, &sunny)).collect();
        let told = |figure: &dyn Fn(&[f64]) -> f64| jackknifed(&of_replicates, figure);
        let share = |least: f64, most: f64| {
            told(&|lx: &[f64]| {
                let within =
                    |(lx, hour): (&f64, &SkyHour)| hour.is_used && (least..most).contains(lx);
                let lit = lx.iter().zip(&year.hours).filter(|&both| within(both)).count() as f64;
                let used = year.hours.iter().filter(|hour| hour.is_used).count() as f64;
                // The sun is below the horizon in the other hours of use.
                let dark = if least == 0.0 { year.used_h - used } else { 0.0 };
                (lit + dark) / year.used_h
            })
        };
        let [low, high] = USEFUL_LX;
        let is_sunny = |(lx, hour): &(&f64, &SkyHour)| hour.is_used && **lx > SUNNY_LX;
        Self {
            autonomy: share(ENOUGH_LX, f64::INFINITY),
            useful: [
                share(0.0, low),
                share(low, ENOUGH_LX),
                share(ENOUGH_LX, high),
                share(high, f64::INFINITY),
            ],
            sunny_h: sunny.iter().zip(&year.hours).filter(is_sunny).count() as f64,
            median_lx: told(&median),
            // Without the ground, which is the last.
            sky_component: factors(&found, &year.overcast[..year.patches.count()], |of| {
                vec![&of.direct]
            }),
            daylight_factor: factors(&found, &year.overcast, |of| vec![&of.direct, &of.indirect]),
        }
    }
}

/// The illuminance of every hour by one replicate, lx.
fn hours_lx(of: &Coefficients, year: &Year, sunny_lx: &[f64]) -> Vec<f64> {
    let all: Vec<f32> = of.direct.iter().zip(&of.indirect).map(|(a, b)| (a + b) as f32).collect();
    let one = |(hour, sun_lx): (&SkyHour, &f64)| {
        let of_sky = f64::from(dot(&all, &hour.luminances_cd_m2));
        let about_sun: f64 = hour.about_sun.iter().map(|&patch| of.indirect[patch as usize]).sum();
        of_sky + about_sun * hour.about_sun_cd_m2 + sun_lx
    };
    year.hours.iter().zip(sunny_lx).map(one).collect()
}

/// The sum of products, in eight sums that are added at the end, always in the same order.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; 8];
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f32 = a8.remainder().iter().zip(b8.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a8.zip(b8) {
        for k in 0..8 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f32>() + rest
}

/// Daylight factors by each part of the light, below these luminances of patches and of the ground.
fn factors(
    found: &[Coefficients],
    overcast: &[f64],
    parts: impl Fn(&Coefficients) -> Vec<&Vec<f64>>,
) -> Jackknifed {
    let of = |c: &Coefficients| {
        let sum = |of: &Vec<f64>| of.iter().zip(overcast).map(|(c, l)| c * l).sum::<f64>();
        vec![parts(c).into_iter().map(sum).sum::<f64>()]
    };
    let of_replicates: Vec<Vec<f64>> = found.iter().map(of).collect();
    jackknifed(&of_replicates, &|factor: &[f64]| factor[0])
}

/// A figure of the means over replicates, with and without each of them. What the noise of a mean adds to a figure falls with the number of
/// replicates: how the figure changes without one of them tells how much there is left (Quenouille 1956).
fn jackknifed(of_replicates: &[Vec<f64>], figure: &dyn Fn(&[f64]) -> f64) -> Jackknifed {
    let count = of_replicates.len() as f64;
    let length = of_replicates[0].len();
    let sum: Vec<f64> = (0..length).map(|k| of_replicates.iter().map(|of| of[k]).sum()).collect();
    let mean = |without: Option<&Vec<f64>>| -> Vec<f64> {
        match without {
            None => sum.iter().map(|lx| lx / count).collect(),
            Some(of) => sum.iter().zip(of).map(|(all, own)| (all - own) / (count - 1.0)).collect(),
        }
    };
    let without: Vec<f64> = of_replicates.iter().map(|of| figure(&mean(Some(of)))).collect();
    let of_less = without.iter().sum::<f64>() / count;
    Jackknifed { value: count * figure(&mean(None)) - (count - 1.0) * of_less, without }
}

/// The value that half of all exceed; zero of none.
pub(super) fn median(values: &[f64]) -> f64 {
    quantile(values, 0.5)
}

/// The value that this share of all exceed, linear between ranks; zero of none.
pub(super) fn quantile(values: &[f64], exceeding: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(|a, b| f64::total_cmp(b, a));
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let rank = exceeding * last as f64;
    let low = rank.floor() as usize;
    let share = rank - low as f64;
    sorted[low] * (1.0 - share) + sorted[(low + 1).min(last)] * share
}

impl Jackknifed {
    /// Standard error (Quenouille 1956, Tukey 1958).
    pub(super) fn standard_error(&self) -> f64 {
        let count = self.without.len() as f64;
        let mean = self.without.iter().sum::<f64>() / count;
        let squares = self.without.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        ((count - 1.0) / count * squares).sqrt()
    }
}

/// The same figure of many points: with all replicates, and without each.
pub(super) fn over_points<'a>(
    points: impl Iterator<Item = &'a Jackknifed> + Clone,
    figure: impl Fn(&[f64]) -> f64,
) -> Option<Jackknifed> {
    let count = points.clone().next()?.without.len();
    let value = figure(&points.clone().map(|p| p.value).collect::<Vec<_>>());
    let without = |k: usize| figure(&points.clone().map(|p| p.without[k]).collect::<Vec<_>>());
    Some(Jackknifed { value, without: (0..count).map(without).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_exceeded_by_their_share() {
        let values = [4.0, 1.0, 3.0, 2.0, 5.0];
        assert_eq!(median(&values), 3.0);
        assert_eq!(quantile(&values, 0.0), 5.0);
        assert_eq!(quantile(&values, 1.0), 1.0);
        assert!((quantile(&values, 0.95) - 1.2).abs() < 1e-12);
        assert_eq!(median(&[]), 0.0);
    }

    /// The jackknife of a mean is its standard error.
    #[test]
    fn the_jackknife_of_a_mean_is_its_standard_error() {
        let of_replicates: Vec<Vec<f64>> = [1.0, 3.0, 4.0, 8.0].map(|x| vec![x]).to_vec();
        let mean = jackknifed(&of_replicates, &|x: &[f64]| x[0]);
        // Sixteen roundings or so.
        assert!((mean.value - 4.0).abs() < 1e-14, "{}", mean.value);
        let variance = (9.0 + 1.0 + 0.0 + 16.0) / 3.0;
        assert!((mean.standard_error() - (variance / 4.0_f64).sqrt()).abs() < 1e-12);
    }

    /// The square of a mean is too large by the variance of the mean, which the jackknife takes away.
    #[test]
    fn the_bias_of_noise_is_taken_away() {
        let values = [1.0, 3.0, 4.0, 8.0];
        let of_replicates: Vec<Vec<f64>> = values.map(|x| vec![x]).to_vec();
        let squared = jackknifed(&of_replicates, &|x: &[f64]| x[0] * x[0]);
        let variance = 26.0 / 3.0;
        assert!((squared.value - (16.0 - variance / 4.0)).abs() < 1e-12, "{}", squared.value);
    }

    #[test]
    fn sums_of_products() {
        let a: Vec<f32> = (0..19).map(|k| k as f32).collect();
        assert_eq!(dot(&a, &a), (0..19).map(|k| (k * k) as f32).sum::<f32>());
    }
}
