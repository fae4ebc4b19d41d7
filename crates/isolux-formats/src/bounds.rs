//! Numbers beyond all light there is: whatever format they come from, they are refused where they enter.

use crate::{Problem, Problems};
use isolux::scene::{Body, LuminaireKind, SceneParts};
use std::path::Path;

/// The brightest luminance that is read: the sun's disk has 1.6e9 cd/m2, arcs and lasers a few thousand times as much.
const MOST_LUMINANCE_CD_M2: f64 = 1e12;
/// The greatest intensity of a luminaire: the brightest lighthouses and searchlights have 1e9 cd.
const MOST_INTENSITY_CD: f64 = 1e12;
/// The greatest illuminance of parallel light: the sun gives 1.3e5 lx.
const MOST_ILLUMINANCE_LX: f64 = 1e9;
/// Refuses what no light is, naming the material or the luminaire.
pub(crate) fn check(path: &Path, parts: &SceneParts) -> Result<(), Problems> {
    let mut problems = Vec::new();
    for material in &parts.materials {
        let Body::Opaque { front, back } = &material.body else { continue };
        let most = front.luminance_cd_m2.max_channel().max(back.luminance_cd_m2.max_channel());
        if beyond(most, MOST_LUMINANCE_CD_M2) {
            let what = format!(
                "a luminance of {most:e} cd/m2; the sun has 1.6e9, and at most {MOST_LUMINANCE_CD_M2:e} are read"
            );
            problems.push(problem(path, format!("material `{}`", material.name), what));
        }
    }
    for luminaire in &parts.luminaires {
        let place = format!("luminaire `{}`", luminaire.name);
        problems.extend(of_luminaire(&luminaire.kind).map(|what| problem(path, place, what)));
    }
    if problems.is_empty() { Ok(()) } else { Err(Problems(problems)) }
}

fn problem(path: &Path, place: String, what: String) -> Problem {
    Problem::new(path, place, what, "correct the number, or its unit")
}

/// Whether a number is above a bound; infinity is, and what is no number is for the scene to refuse.
fn beyond(value: f64, most: f64) -> bool {
    value > most
}

fn of_luminaire(kind: &LuminaireKind) -> Option<String> {
    match kind {
        LuminaireKind::Point { intensity, .. } => {
            let most = intensity.max_intensity_cd();
            beyond(most, MOST_INTENSITY_CD).then(|| {
                format!("an intensity of {most:e} cd; the brightest lighthouses have 1e9, and at most {MOST_INTENSITY_CD:e} are read")
            })
        }
        LuminaireKind::Directional { illuminance_lx, .. } => {
            beyond(*illuminance_lx, MOST_ILLUMINANCE_LX).then(|| {
                format!("an illuminance of {illuminance_lx:e} lx; the sun gives 1.3e5, and at most {MOST_ILLUMINANCE_LX:e} are read")
            })
        }
        LuminaireKind::Sky { sky, .. } => {
            let most = sky.most_cd_m2();
            beyond(most, MOST_LUMINANCE_CD_M2).then(|| {
                format!("a sky of {most:e} cd/m2; the disc of the sun has 2e9, and at most {MOST_LUMINANCE_CD_M2:e} are read")
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Direction;
    use isolux::scene::{Finish, Luminaire, Material};
    use isolux::units::Rgb;

    fn refused(material: Option<f64>, sun_lx: Option<f64>) -> String {
        let finish = |level| Finish { luminance_cd_m2: Rgb::new(0.0, level, 0.0), ..Finish::BLACK };
        let kind = |illuminance_lx| LuminaireKind::Directional {
            direction: Direction::Z,
            illuminance_lx,
            half_angle_rad: 0.0,
        };
        let parts = SceneParts {
            materials: material
                .map(|m| Material::one_sided("lamp", finish(m)))
                .into_iter()
                .collect(),
            luminaires: sun_lx
                .map(|lx| Luminaire {
                    name: "sun".into(),
                    group: 0,
                    colour: Rgb::WHITE,
                    kind: kind(lx),
                })
                .into_iter()
                .collect(),
            ..SceneParts::default()
        };
        check(Path::new("a"), &parts).err().map_or_else(String::new, |p| p.to_string())
    }

    #[test]
    fn the_sun_is_read_and_nothing_far_brighter() {
        assert_eq!(refused(Some(1.6e9), Some(1.3e5)), "");
        let bright = refused(Some(1e308), None);
        assert!(bright.contains("material `lamp`") && bright.contains("1e308 cd/m2"), "{bright}");
        assert!(refused(None, Some(1e300)).contains("luminaire `sun`"));
        assert!(refused(Some(f64::INFINITY), None).contains("lamp"));
    }
}
