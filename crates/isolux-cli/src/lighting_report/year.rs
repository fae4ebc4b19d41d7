//! The year of daylight of a report.

use super::areas::{local, plan, words};
use crate::annual::{self, Found, YearAsked};
use crate::failure::Failure;
use crate::flags::YearFlags;
use crate::shown::name;
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::to_error;
use isolux_report::{Daylight, DaylightArea, Language};
use isolux_view::{PlanPoint, PlanWords};

/// Nobody reads daylight factors finer than this, per cent.
const LEAST_PERCENT: f64 = 0.05;

/// `None` where no year is asked for.
pub(super) fn of(
    flags: &YearFlags,
    scene: &Scene,
    grids: &[CalculationGrid],
    language: Language,
) -> Result<Option<Daylight>, Failure> {
    let Some(weather) = &flags.weather else { return Ok(None) };
    if grids.is_empty() {
        let what = "--weather: there is no calculation grid to compute daylight on";
        return Err(Failure::bad_input(format!("{what}; give a --height, or a [[grid]]")));
    }
    let asked = YearAsked {
        weather,
        hours: flags.hours,
        ground_reflectance: flags.ground_reflectance,
        paths: flags.paths,
        seed: flags.seed,
    };
    let (place, found) = annual::of_scene(&asked, scene, grids.to_vec())?;
    let areas = found.iter().map(|found| area(scene, found, language));
    Ok(Some(Daylight {
        place: name(&place),
        hours: flags.hours.into(),
        ground_reflectance: flags.ground_reflectance,
        paths: flags.paths,
        areas: areas.collect::<Result<_, _>>()?,
    }))
}

fn area(scene: &Scene, found: &Found, language: Language) -> Result<DaylightArea, Failure> {
    let of = &found.figures;
    let points: Vec<PlanPoint> = found
        .factors()
        .map(|(share, error)| {
            let [percent, error] = [share, error].map(|share| 100.0 * share);
            PlanPoint {
                illuminance_lx: Some(percent),
                standard_error_lx: error,
                label: local(&to_error(percent, error.max(LEAST_PERCENT)), language),
            }
        })
        .collect();
    let words = PlanWords { values: language.plan().daylight_factor, ..words(language) };
    Ok(DaylightArea {
        name: name(&found.grid.name),
        plan: Some(plan((scene, &found.grid), &points, &words)?),
        factor_mean: of.daylight_factor_mean,
        sky_component: of.sky_component_mean,
        factor_median: of.daylight_factor_median,
        factor_95: of.daylight_factor_95,
        target_lx: [of.target_lx, of.minimum_target_lx],
        en_17037: of.en_17037,
        autonomy: of.daylight_autonomy,
        spatial_autonomy: of.spatial_daylight_autonomy,
        spatial_autonomy_reaches: [of.sda_accepted, of.sda_preferred],
        sunlight_exposure: of.annual_sunlight_exposure,
        sunlight_acceptable: of.ase_acceptable,
        useful: of.useful_daylight,
    })
}
