//! A sky as a `[[luminaire]]`: its luminances as numbers or as a picture, with nothing to be computed. It is what files that are
//! written hold.

use crate::scene_toml::context::Context;
use crate::scene_toml::quantity::plain;
use crate::scene_toml::sky_record::LuminancesRecord;
use crate::scene_toml::spans::At;
use crate::sky_picture;
use isolux::geometry::{Direction, Transform, Vector};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{LuminaireKind, world_from_sky};
use std::sync::Arc;

/// How far axes may be off right angles and a length of one: the rounding of numbers that were written.
const ROUNDING: f64 = 1e-9;

/// The sky that an entry means, so many times as bright; `None` after a problem.
pub(in crate::scene_toml) fn kind(
    entry: &At<LuminancesRecord>,
    factor: f64,
    context: &mut Context,
) -> Option<LuminaireKind> {
    let sky = luminances(entry, context)?;
    let sky = if factor == 1.0 { sky } else { sky.scaled(factor) };
    Some(LuminaireKind::Sky { world_from_sky: stand(entry, context)?, sky })
}

fn stand(entry: &At<LuminancesRecord>, context: &mut Context) -> Option<Transform> {
    let record = entry.get_ref();
    let Some(axes) = &record.axes else {
        return Some(world_from_sky(context.up, record.north_deg.map_or(0.0, |n| n.0)));
    };
    let columns = axes.get_ref().map(|axis| Vector::from(plain(axis)));
    let [east, north, zenith] = columns;
    let is_square = [east.dot(north), north.dot(zenith), zenith.dot(east)]
        .iter()
        .all(|cos| cos.abs() <= ROUNDING);
    let is_unit = columns.iter().all(|axis| (axis.length() - 1.0).abs() <= ROUNDING);
    if is_square && is_unit && record.north_deg.is_none() {
        return Some(Transform { columns, translation: Vector::ZERO });
    }
    let what = "`axes` that are no turn, or that stand beside `north_deg`";
    let remedy = "give three directions of length one at right angles, or `north_deg` alone";
    context.problem(&axes.span(), what, remedy);
    None
}

fn luminances(entry: &At<LuminancesRecord>, context: &mut Context) -> Option<Sky> {
    let record = entry.get_ref();
    let numbers = (&record.gradation, &record.indicatrix, &record.scale_cd_m2);
    match (numbers, &record.picture) {
        ((Some(gradation), Some(indicatrix), Some(scale)), None) => {
            let sun = match record.sun {
                None => Some(Direction::Z),
                Some(sun) => Vector::from(plain(sun)).direction(),
            };
            let Some(sun) = sun else {
                let what = "a sun in a direction of length zero";
                context.problem(&entry.span(), what, "say where it is: east, north, up");
                return None;
            };
            let sky = GeneralSky {
                gradation: gradation.map(|n| n.0),
                indicatrix: indicatrix.map(|n| n.0),
                sun,
                scale_cd_m2: scale.0,
            };
            let ground_cd_m2 = record.ground_cd_m2.map_or(0.0, |ground| ground.0);
            Some(Sky::General { sky, ground_cd_m2 })
        }
        ((None, None, None), Some(file)) => {
            let path = context.path_of(&file.span(), file.get_ref())?;
            let read = context.absorb(&file.span(), file.get_ref(), sky_picture::read(&path))?;
            if read.unit_cd_m2 == Some(1.0) {
                return Some(Sky::Picture(Arc::new(read.picture)));
            }
            let what = "a picture that does not say that its values are cd/m2";
            let remedy = "name it in `[sky]` with its `luminance_factor`";
            context.problem(&file.span(), what, remedy);
            None
        }
        _ => {
            let what = "a `sky` of a luminaire that is neither a formula nor a picture";
            let remedy = "give `gradation`, `indicatrix` and `scale_cd_m2`, or `picture`; `[sky]` has skies by name";
            context.problem(&entry.span(), what, remedy);
            None
        }
    }
}
