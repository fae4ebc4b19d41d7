//! The skies of a year, as luminances of patches.

use isolux::geometry::Direction;
use isolux::photometry::{GeneralSky, SkyPatches};
use isolux_formats::epw::{DaylightHour, DaylightYear, Hour};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Reinhart's subdivision of the sky, as the five-phase method takes it.
const MULTIPLIER: u32 = 4;
/// Reflected sunlight comes from all patches so near to the sun, rad: half the width of a patch of Tregenza. It varies little with the
/// place of the sun, and the paths of a single patch of Reinhart are few.
const ABOUT_SUN_RAD: f64 = 6.0 * PI / 180.0;

/// A year, prepared for sums over patches.
pub(super) struct Year {
    pub(super) patches: SkyPatches,
    pub(super) hours: Vec<SkyHour>,
    /// Of the patches, and of the ground at the end, below the CIE overcast sky that gives open ground one lux, cd/m2.
    pub(super) overcast: Vec<f64>,
    /// Hours of use, dark ones as well.
    pub(super) used_h: f64,
}

/// An hour with the sun above the horizon.
pub(super) struct SkyHour {
    /// Of the patches, and of the ground at the end, cd/m2.
    pub(super) luminances_cd_m2: Vec<f32>,
    pub(super) sun: Direction,
    /// Of a surface that faces the sun, by the sun alone, lx.
    pub(super) sun_normal_lx: f64,
    /// The patches about the sun, and the luminance there that gives as much light as the sun, cd/m2.
    pub(super) about_sun: Vec<u32>,
    pub(super) about_sun_cd_m2: f64,
    /// Of open ground, by the sky alone, lx.
    pub(super) diffuse_horizontal_lx: f64,
    /// Whether it is one of the hours of use.
    pub(super) is_used: bool,
}

impl Year {
    pub(super) fn of(
        year: &DaylightYear,
        all: &[Hour],
        used: (u32, u32),
        ground_reflectance: f64,
    ) -> Self {
        let patches = SkyPatches::reinhart(MULTIPLIER).expect("a subdivision of Reinhart's");
        let middles: Vec<Direction> = (0..patches.count()).map(|k| patches.middle(k)).collect();
        let one =
            |hour: &DaylightHour| SkyHour::of(hour, (&patches, &middles), used, ground_reflectance);
        let hours = year.hours.par_iter().map(one).collect();
        let used_h = all.iter().filter(|hour| is_used(hour.hour, used)).count() as f64;
        let overcast = GeneralSky::cie(1, Direction::Z).and_then(|sky| sky.with_horizontal_lx(1.0));
        let overcast = overcast.expect("type 1 is one of the fifteen, and has light");
        let overcast = luminances_cd_m2(&overcast, &patches).into_iter().map(f64::from);
        let overcast = overcast.chain([ground_reflectance / PI]).collect();
        Self { patches, hours, overcast, used_h }
    }
}

impl SkyHour {
    fn of(
        hour: &DaylightHour,
        (patches, middles): (&SkyPatches, &[Direction]),
        used: (u32, u32),
        ground_reflectance: f64,
    ) -> Self {
        let sky = &hour.light.sky;
        let sun_normal_lx = hour.light.sun_normal_lx;
        let diffuse_horizontal_lx = sky.horizontal_lx();
        let global_lx = diffuse_horizontal_lx + sun_normal_lx * hour.sun.to_vector().z;
        let mut luminances_cd_m2 = luminances_cd_m2(sky, patches);
        luminances_cd_m2.push((ground_reflectance * global_lx / PI) as f32);
        let about_sun = about(hour.sun, patches, middles);
        let steradians: f64 = about_sun.iter().map(|&k| patches.steradians(k as usize)).sum();
        Self {
            luminances_cd_m2,
            sun: hour.sun,
            sun_normal_lx,
            about_sun,
            about_sun_cd_m2: sun_normal_lx / steradians,
            diffuse_horizontal_lx,
            is_used: is_used(hour.hour, used),
        }
    }
}

/// The patch of the sun, and those whose middles are near.
fn about(sun: Direction, patches: &SkyPatches, middles: &[Direction]) -> Vec<u32> {
    let own = patches.of(sun).unwrap_or(0);
    let least = libm::cos(ABOUT_SUN_RAD);
    let is_near = |k: &u32| *k as usize == own || middles[*k as usize].dot(sun) >= least;
    (0..middles.len() as u32).filter(is_near).collect()
}

/// Whether an hour, by its end, is one of use.
const fn is_used(hour: u32, (from, to): (u32, u32)) -> bool {
    from < hour && hour <= to
}

/// The luminance in the middle of each patch.
fn luminances_cd_m2(sky: &GeneralSky, patches: &SkyPatches) -> Vec<f32> {
    let of = |patch: usize| sky.luminance_cd_m2(patches.middle(patch)) as f32;
    (0..patches.count()).map(of).collect()
}
