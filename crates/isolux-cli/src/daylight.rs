//! Light that comes from infinitely far away, in words: skies and suns.

use crate::quantity::significant;
use crate::shown::name;
use isolux::geometry::{Direction, Vector};
use isolux::photometry::Sky;
use isolux::scene::{LuminaireKind, Scene, world_from_sky};
use serde::Serialize;

/// A sky.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct SkyFacts {
    name: String,
    /// `formula` or `picture`.
    kind: &'static str,
    /// On open ground, without the sun.
    horizontal_lx: f64,
    zenith_cd_m2: f64,
    nadir_cd_m2: f64,
}

/// A sun, or other parallel light.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct SunFacts {
    name: String,
    /// On a surface that faces it.
    normal_lx: f64,
    /// Below zero for light that shines upwards.
    elevation_deg: f64,
    /// From north by east; without a sky north is +y, or -z where y is up.
    azimuth_deg: f64,
    /// The full angle under which it is seen; 0 for parallel light.
    angle_deg: f64,
}

/// All of a scene.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct Daylight {
    skies: Vec<SkyFacts>,
    suns: Vec<SunFacts>,
}

impl Daylight {
    pub(crate) fn of(scene: &Scene) -> Self {
        let frame = frame(scene);
        let mut daylight = Self { skies: Vec::new(), suns: Vec::new() };
        for luminaire in scene.luminaires() {
            let name = luminaire.name.clone();
            match &luminaire.kind {
                LuminaireKind::Point { .. } => {}
                LuminaireKind::Sky { sky, .. } => daylight.skies.push(of_sky(name, sky)),
                LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
                    let [east, north, up] = frame.map(|axis| -direction.to_vector().dot(axis));
                    let turn_deg = libm::atan2(east, north).to_degrees();
                    daylight.suns.push(SunFacts {
                        name,
                        normal_lx: *illuminance_lx,
                        elevation_deg: libm::asin(up.clamp(-1.0, 1.0)).to_degrees(),
                        azimuth_deg: if turn_deg < 0.0 { turn_deg + 360.0 } else { turn_deg },
                        angle_deg: 2.0 * half_angle_rad.to_degrees(),
                    });
                }
            }
        }
        daylight
    }

    /// Rows of a table of facts.
    pub(crate) fn rows(&self) -> Vec<(&'static str, String)> {
        let skies = self.skies.iter().map(|sky| ("sky", sky.text()));
        skies.chain(self.suns.iter().map(|sun| ("sun", sun.text()))).collect()
    }

    /// Suns that shine from below the horizon, and how far below, degrees.
    pub(crate) fn below_horizon(&self) -> impl Iterator<Item = (&str, f64)> {
        let below = self.suns.iter().filter(|sun| sun.elevation_deg < 0.0);
        below.map(|sun| (sun.name.as_str(), -sun.elevation_deg))
    }
}

/// East, north and zenith in the scene: those of its first sky.
fn frame(scene: &Scene) -> [Vector; 3] {
    let of_sky = |kind: &LuminaireKind| match kind {
        LuminaireKind::Sky { world_from_sky, .. } => Some(world_from_sky.columns),
        _ => None,
    };
    let usual = world_from_sky(scene.up(), 0.0).columns;
    scene.luminaires().iter().find_map(|l| of_sky(&l.kind)).unwrap_or(usual)
}

fn of_sky(name: String, sky: &Sky) -> SkyFacts {
    let seen = |towards| sky.luminance_cd_m2(towards).luminance();
    SkyFacts {
        name,
        kind: match sky {
            Sky::General { .. } => "formula",
            Sky::Picture(_) => "picture",
        },
        horizontal_lx: sky.horizontal_lx(),
        zenith_cd_m2: seen(Direction::Z),
        nadir_cd_m2: seen(-Direction::Z),
    }
}

impl SkyFacts {
    fn text(&self) -> String {
        let [lx, zenith, nadir] =
            [self.horizontal_lx, self.zenith_cd_m2, self.nadir_cd_m2].map(|v| significant(v, 3));
        let by = match self.kind {
            "picture" => "by picture",
            _ => "by formula",
        };
        format!(
            "{} {by}: {lx} lx on open ground, {zenith} cd/m2 in the zenith, {nadir} cd/m2 below",
            name(&self.name)
        )
    }
}

impl SunFacts {
    fn text(&self) -> String {
        let disc = match self.angle_deg > 0.0 {
            true => format!("a disc of {} degrees", significant(self.angle_deg, 3)),
            false => "parallel".to_owned(),
        };
        format!(
            "{}: {} lx on what faces it, {:.1} degrees above the horizon, azimuth {:.1} from north by east, {disc}",
            name(&self.name),
            significant(self.normal_lx, 3),
            self.elevation_deg,
            self.azimuth_deg
        )
    }
}
