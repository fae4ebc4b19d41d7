//! Light that comes from everywhere, infinitely far away: `constant` and `envmap`.

use super::emitter;
use super::property::{float, transform};
use super::record::{Element, Wrong};
use super::scope::Scope;
use crate::sky_picture;
use isolux::geometry::{Transform, Vector};
use isolux::photometry::{GeneralSky, Sky};
use isolux::scene::{Luminaire, LuminaireKind};
use isolux::units::Rgb;
use std::sync::Arc;

/// How far axes may be off right angles and one length, in shares: numbers of six digits.
const ROUNDED: f64 = 1e-5;

/// The same luminance on all sides.
pub(super) fn constant(element: &Element, efficacy_lm_w: f64) -> Result<Luminaire, Wrong> {
    let luminance_cd_m2 = emitter::light(element, "radiance", efficacy_lm_w)?;
    let level = luminance_cd_m2.luminance();
    let sky = Sky::General { sky: GeneralSky::uniform(level), ground_cd_m2: level };
    Ok(surrounding(element, luminance_cd_m2.chromaticity(), Transform::IDENTITY, sky))
}

/// A picture all around; `None` after a problem.
pub(super) fn picture(
    element: &Element,
    efficacy_lm_w: f64,
    scope: &mut Scope,
) -> Option<Luminaire> {
    let scale = scope.take(&element.at, float(element, "scale"))?.unwrap_or(1.0);
    if scale < 0.0 {
        scope.refuse(element, "has a scale below 0", "give 0 or more");
        return None;
    }
    let map = scope.take(&element.at, transform(element, "to_world"))?;
    let Some(turn) = turn(&map) else {
        let what = "is distorted by its `to_world`";
        scope.refuse(element, what, "turn it, and scale all axes alike");
        return None;
    };
    let path = scope.file(element)?;
    let read = sky_picture::read(&path);
    if read.is_err() {
        let what = "names a picture that cannot be used, for the reason that follows";
        scope.refuse(element, what, "mend it, or name another file");
    }
    let picture = scope.notes.findings().absorb(read)?.picture;
    let sky = Sky::Picture(Arc::new(picture)).scaled(scale * efficacy_lm_w);
    let world_from_sky = turn.then_from(&own_from_sky());
    Some(surrounding(element, Rgb::WHITE, world_from_sky, sky))
}

fn surrounding(element: &Element, colour: Rgb, world_from_sky: Transform, sky: Sky) -> Luminaire {
    let kind = LuminaireKind::Sky { world_from_sky, sky };
    Luminaire { name: emitter::name(element), group: 0, colour, kind }
}

/// Mitsuba's pictures have +y above and -z at the left border; from there they go by +x.
fn own_from_sky() -> Transform {
    let axes = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    Transform { columns: axes.map(Vector::from), translation: Vector::ZERO }
}

/// The turn (or mirror image) in a map without distortion.
fn turn(map: &Transform) -> Option<Transform> {
    let scale = libm::cbrt(map.determinant().abs());
    let columns = map.columns.map(|column| column / scale);
    let [a, b, c] = columns;
    let is_square = [a.dot(b), b.dot(c), c.dot(a)].iter().all(|cos| cos.abs() <= ROUNDED);
    let is_even = columns.iter().all(|axis| (axis.length() - 1.0).abs() <= ROUNDED);
    (is_square && is_even).then_some(Transform { columns, translation: Vector::ZERO })
}
