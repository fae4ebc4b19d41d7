//! What the year of a grid comes to.

use super::place::{Jackknifed, PlaceYear, over_points, quantile};
use super::year::Year;
use isolux::map::{Figure, Verdict};
use serde::Serialize;

/// Quantile of Student's distribution with fifteen degrees of freedom, for 95 %: of sixteen replicates.
const STUDENT: f64 = 2.131;

/// Half of the hours of use, from which a point counts for sDA (IES LM-83-12).
const HALF: f64 = 0.5;
/// Hours of direct sun beyond which a point counts for ASE (IES LM-83-12).
const MOST_SUNNY_H: f64 = 250.0;
/// Shares of points above which sDA is nominally accepted, and preferred; and up to which ASE is acceptable (IES LM-83-12).
const ACCEPTED_SDA: f64 = 0.55;
const PREFERRED_SDA: f64 = 0.75;
const MOST_ASE: f64 = 0.1;
/// Shares of points that a target and a minimum target of EN 17037:2018 hold for.
const TARGET_POINTS: f64 = 0.5;
const MINIMUM_POINTS: f64 = 0.95;
/// Levels of EN 17037:2018, table A.1: target and minimum target illuminance, lx.
const LEVELS_LX: [(&str, [f64; 2]); 3] =
    [("minimum", [300.0, 100.0]), ("medium", [500.0, 300.0]), ("high", [750.0, 500.0])];

/// The figures of a grid, shares as fractions, each with an interval of 95 % for the noise of paths.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct GridYear {
    /// Daylight factor: mean over points, median, and what 95 % of the points exceed.
    pub(crate) daylight_factor_mean: Figure,
    pub(crate) daylight_factor_median: Figure,
    pub(crate) daylight_factor_95: Figure,
    /// The part of its mean that comes straight from the sky.
    pub(crate) sky_component_mean: Figure,
    /// Daylight factors with which this place has 300 lx (and 100 lx) of diffuse light for half of the hours of daylight.
    pub(crate) target_daylight_factor: Option<[f64; 2]>,
    /// Illuminance of half of the hours of daylight: what half of the points exceed, and what 95 % exceed, lx.
    pub(crate) target_lx: Figure,
    pub(crate) minimum_target_lx: Figure,
    /// Mean share of the hours of use with 300 lx.
    pub(crate) daylight_autonomy: Figure,
    /// Share of points with 300 lx in half of the hours of use.
    pub(crate) spatial_daylight_autonomy: Figure,
    /// Share of points with more than 1000 lx of direct sun in more than 250 hours of use.
    pub(crate) annual_sunlight_exposure: f64,
    /// Mean shares of the hours of use below 100 lx, to 300, to 3000, and above.
    pub(crate) useful_daylight: [Figure; 4],
    /// Whether levels of EN 17037 are met: minimum, medium, high.
    pub(crate) en_17037: [Verdict; 3],
    pub(crate) sda_accepted: Verdict,
    pub(crate) sda_preferred: Verdict,
    pub(crate) ase_acceptable: Verdict,
}

/// A figure with its interval.
pub(super) fn interval(figure: &Jackknifed) -> Figure {
    let half = STUDENT * figure.standard_error();
    // Without its bias a small figure may be below nothing.
    let value = figure.value.max(0.0);
    Figure { value, low: (value - half).max(0.0), high: value + half }
}

/// The same, of a share: at most one.
fn share(figure: &Jackknifed) -> Figure {
    let of = interval(figure);
    Figure { value: of.value.min(1.0), high: of.high.min(1.0), ..of }
}

impl GridYear {
    /// `None` of a grid without points.
    pub(super) fn of(points: &[PlaceYear], year: &Year) -> Option<Self> {
        let over = |of: fn(&PlaceYear) -> &Jackknifed, figure: &dyn Fn(&[f64]) -> f64| {
            over_points(points.iter().map(of), figure)
        };
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let exceeded = |share: f64| move |values: &[f64]| quantile(values, share);
        let factor: fn(&PlaceYear) -> &Jackknifed = |p| &p.daylight_factor;
        let median: fn(&PlaceYear) -> &Jackknifed = |p| &p.median_lx;
        let target_lx = interval(&over(median, &exceeded(TARGET_POINTS))?);
        let minimum_target_lx = interval(&over(median, &exceeded(MINIMUM_POINTS))?);
        let useful: [fn(&PlaceYear) -> &Jackknifed; 4] =
            [|p| &p.useful[0], |p| &p.useful[1], |p| &p.useful[2], |p| &p.useful[3]];
        let useful = useful.map(|of| over(of, &mean).as_ref().map(share));
        let [Some(dark), Some(some), Some(good), Some(much)] = useful else { return None };
        let sda = sda(points);
        let sunny = points.iter().filter(|p| p.sunny_h > MOST_SUNNY_H).count();
        let ase = sunny as f64 / points.len() as f64;
        let level = |[target, minimum]: [f64; 2]| {
            target_lx.reaches(target).and(minimum_target_lx.reaches(minimum))
        };
        Some(Self {
            daylight_factor_mean: interval(&over(factor, &mean)?),
            daylight_factor_median: interval(&over(factor, &exceeded(TARGET_POINTS))?),
            daylight_factor_95: interval(&over(factor, &exceeded(MINIMUM_POINTS))?),
            sky_component_mean: interval(&over(|p| &p.sky_component, &mean)?),
            target_daylight_factor: target_daylight_factors(year),
            target_lx,
            minimum_target_lx,
            daylight_autonomy: share(&over(|p| &p.autonomy, &mean)?),
            spatial_daylight_autonomy: sda,
            annual_sunlight_exposure: ase,
            useful_daylight: [dark, some, good, much],
            en_17037: LEVELS_LX.map(|(_, levels)| level(levels)),
            sda_accepted: sda.reaches(ACCEPTED_SDA),
            sda_preferred: sda.reaches(PREFERRED_SDA),
            ase_acceptable: if ase <= MOST_ASE { Verdict::Met } else { Verdict::NotMet },
        })
    }

    /// The levels of EN 17037 by name.
    pub(super) fn levels(&self) -> impl Iterator<Item = (&'static str, Verdict)> {
        LEVELS_LX.into_iter().map(|(name, _)| name).zip(self.en_17037)
    }
}

/// The share of points that reach half of the hours, from those that surely do to those that may.
fn sda(points: &[PlaceYear]) -> Figure {
    let share = |deviations: f64| {
        let reaches = |p: &&PlaceYear| {
            let half = STUDENT * p.autonomy.standard_error();
            p.autonomy.value + deviations * half >= HALF
        };
        points.iter().filter(reaches).count() as f64 / points.len() as f64
    };
    Figure { value: share(0.0), low: share(-1.0), high: share(1.0) }
}

/// EN 17037:2018, annex A: target illuminances over the median diffuse illuminance of open ground; `None` where that is nothing.
fn target_daylight_factors(year: &Year) -> Option<[f64; 2]> {
    let diffuse: Vec<f64> = year.hours.iter().map(|hour| hour.diffuse_horizontal_lx).collect();
    let median_lx = quantile(&diffuse, 0.5);
    let [target, minimum] = LEVELS_LX[0].1;
    (median_lx > 0.0).then(|| [target / median_lx, minimum / median_lx])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_need_the_whole_interval() {
        let of = |low: f64, high: f64| Figure { value: 0.5 * (low + high), low, high };
        assert_eq!(of(300.0, 310.0).reaches(300.0), Verdict::Met);
        assert_eq!(of(290.0, 310.0).reaches(300.0), Verdict::Undecided);
        assert_eq!(of(280.0, 299.0).reaches(300.0), Verdict::NotMet);
        assert_eq!(Verdict::Met.and(Verdict::Undecided), Verdict::Undecided);
        assert_eq!(Verdict::Undecided.and(Verdict::NotMet), Verdict::NotMet);
    }
}
