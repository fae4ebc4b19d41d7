//! The year of daylight of a report.

use super::areas::plan;
use crate::annual::{self, Found};
use crate::failure::Failure;
use crate::flags::YearFlags;
use crate::shown::name;
use isolux::scene::{CalculationGrid, Scene};
use isolux::units::to_error;
use isolux_report::{Daylight, DaylightArea, Language};
use isolux_view::{PlanPoint, PlanWords};
use std::path::Path;

/// Nobody reads daylight factors finer than this, per cent.
const LEAST_PERCENT: f64 = 0.05;

/// `None` where no year is asked for.
pub(super) fn of(
    (weather, flags): (Option<&Path>, &YearFlags),
    scene: &Scene,
    grids: &[CalculationGrid],
    language: Language,
) -> Result<Option<Daylight>, Failure> {
    let Some(weather) = weather else { return Ok(None) };
    if grids.is_empty() {
        let what = "--weather: there is no calculation grid to compute daylight on";
        return Err(Failure::bad_input(format!("{what}; give a --height, or a [[grid]]")));
    }
    let (place, found) = annual::of_scene((weather, flags), scene, grids.to_vec())?;
    let words = language.daylight_plan();
    let areas = found.iter().map(|found| area(scene, found, &words));
    Ok(Some(Daylight {
        place: name(&place),
        hours: flags.hours.into(),
        ground_reflectance: flags.ground_reflectance,
        paths: flags.paths,
        areas: areas.collect::<Result<_, _>>()?,
    }))
}

fn area(scene: &Scene, found: &Found, words: &PlanWords) -> Result<DaylightArea, Failure> {
    let of = &found.figures;
    let points: Vec<PlanPoint> = found
        .factors()
        .map(|(share, error)| {
            let [percent, error] = [share, error].map(|share| 100.0 * share);
            PlanPoint {
                illuminance_lx: Some(percent),
                standard_error_lx: error,
                label: words.local(&to_error(percent, error.max(LEAST_PERCENT))),
            }
        })
        .collect();
    Ok(DaylightArea {
        name: name(&found.grid.name),
        plan: Some(plan((scene, &found.grid), &points, words)?),
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
