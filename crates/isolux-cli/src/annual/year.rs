//! The skies of a year, as luminances of patches.

use isolux::geometry::Direction;
use isolux::photometry::{GeneralSky, SkyPatches};
use isolux_formats::epw::{DaylightHour, DaylightYear, Hour};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Reinhart's subdivision of the sky, as the five-phase method takes it.
const MULTIPLIER: u32 = 4;

/// A year, prepared for sums over patches.
pub(super) struct Year {
    pub(super) patches: SkyPatches,
    pub(super) hours: Vec<SkyHour>,
    /// Of the patches, below the CIE overcast sky that gives open ground one lux, cd/m2.
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
    /// The patch about the sun, and the luminance of that patch that gives as much light as the sun, cd/m2.
    pub(super) sun_patch: (usize, f64),
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
        let one = |hour: &DaylightHour| SkyHour::of(hour, &patches, used, ground_reflectance);
        let hours = year.hours.par_iter().map(one).collect();
        let used_h = all.iter().filter(|hour| is_used(hour.hour, used)).count() as f64;
        let overcast = GeneralSky::cie(1, Direction::Z).and_then(|sky| sky.with_horizontal_lx(1.0));
        let overcast = overcast.expect("type 1 is one of the fifteen, and has light");
        let overcast = luminances_cd_m2(&overcast, &patches).into_iter().map(f64::from).collect();
        Self { patches, hours, overcast, used_h }
    }
}

impl SkyHour {
    fn of(
        hour: &DaylightHour,
        patches: &SkyPatches,
        used: (u32, u32),
        ground_reflectance: f64,
    ) -> Self {
        let sky = &hour.light.sky;
        let sun_normal_lx = hour.light.sun_normal_lx;
        let diffuse_horizontal_lx = sky.horizontal_lx();
        let global_lx = diffuse_horizontal_lx + sun_normal_lx * hour.sun.to_vector().z;
        let mut luminances_cd_m2 = luminances_cd_m2(sky, patches);
        luminances_cd_m2.push((ground_reflectance * global_lx / PI) as f32);
        let patch = patches.of(hour.sun).unwrap_or(0);
        Self {
            luminances_cd_m2,
            sun: hour.sun,
            sun_normal_lx,
            sun_patch: (patch, sun_normal_lx / patches.steradians(patch)),
            diffuse_horizontal_lx,
            is_used: is_used(hour.hour, used),
        }
    }
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
