//! Skies as values of luminaires, and their pictures.

use super::numbers::shortest;
use super::text::{number, quoted, triple};
use crate::luminance::{LuminanceError, Luminances, encode_exr};
use isolux::geometry::Transform;
use isolux::photometry::{GeneralSky, Sky, SkyPicture};
use isolux::scene::{LuminaireKind, SceneParts, world_from_sky};
use std::sync::Arc;

/// A sky as the value of `sky`.
pub(super) fn value(parts: &SceneParts, turn: &Transform, sky: &Sky) -> String {
    let mut items = match sky {
        Sky::General { sky, ground_cd_m2 } => formula(sky, *ground_cd_m2),
        Sky::Picture(picture) => {
            let index = pictures(parts).iter().position(|known| Arc::ptr_eq(known, picture));
            vec![format!("picture = {}", quoted(&name(index.unwrap_or(0))))]
        }
    };
    items.extend(stand(parts, turn));
    format!("{{ {} }}", items.join(", "))
}

/// The files of all pictures.
pub(super) fn files(parts: &SceneParts) -> Result<Vec<(String, Vec<u8>)>, LuminanceError> {
    let encoded = |(index, picture): (usize, &Arc<SkyPicture>)| {
        let SkyPicture { width, height, rgb_cd_m2 } = &**picture;
        let bytes = encode_exr(&Luminances { width: *width, height: *height, rgb_cd_m2 })?;
        Ok((name(index), bytes))
    };
    pictures(parts).iter().enumerate().map(encoded).collect()
}

fn name(index: usize) -> String {
    format!("sky-{}.exr", index + 1)
}

/// Pictures of skies, each once.
fn pictures(parts: &SceneParts) -> Vec<Arc<SkyPicture>> {
    let mut found: Vec<Arc<SkyPicture>> = Vec::new();
    for luminaire in &parts.luminaires {
        let LuminaireKind::Sky { sky: Sky::Picture(picture), .. } = &luminaire.kind else {
            continue;
        };
        if !found.iter().any(|known| Arc::ptr_eq(known, picture)) {
            found.push(Arc::clone(picture));
        }
    }
    found
}

fn formula(sky: &GeneralSky, ground_cd_m2: f64) -> Vec<String> {
    let list = |values: &[f64]| {
        format!("[{}]", values.iter().map(|&v| number(v)).collect::<Vec<_>>().join(", "))
    };
    vec![
        format!("gradation = {}", list(&sky.gradation)),
        format!("indicatrix = {}", list(&sky.indicatrix)),
        format!("sun = {}", triple(sky.sun.to_vector().into())),
        format!("scale_cd_m2 = {}", number(sky.scale_cd_m2)),
        format!("ground_cd_m2 = {}", number(ground_cd_m2)),
    ]
}

/// Where north is; nothing where it is where it is unless said.
fn stand(parts: &SceneParts, turn: &Transform) -> Option<String> {
    let makes = |deg: f64| world_from_sky(parts.up, deg) == *turn;
    if makes(0.0) {
        return None;
    }
    // Of north as it lies where nothing is said, in the axes of the turned sky.
    let level = world_from_sky(parts.up, 0.0);
    let [east, north] = [level.columns[0], level.columns[1]];
    let turned = turn.columns[1];
    let north_deg = libm::atan2(turned.dot(east), turned.dot(north)).to_degrees();
    let found = [north_deg, north_deg + 360.0].map(|deg| shortest(deg, makes));
    Some(match found.into_iter().find(|&deg| makes(deg)) {
        Some(deg) => format!("north_deg = {}", number(deg)),
        None => {
            let axes = turn.columns.map(|axis| triple(axis.into()));
            format!("axes = [{}]", axes.join(", "))
        }
    })
}
