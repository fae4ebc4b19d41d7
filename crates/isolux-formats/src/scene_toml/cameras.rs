//! Cameras.

use super::context::Context;
use super::quantity::plain;
use super::record::CameraRecord;
use super::spans::At;
use isolux::geometry::{Direction, Point, Vector};
use isolux::scene::{Camera, SceneParts, UpAxis};

const USUAL_FOV_DEG: f64 = 60.0;
/// Two directions whose cosine differs from one by less than this are parallel to rounding.
const PARALLEL: f64 = 1e-9;

/// Adds all cameras of the file to the scene.
pub(super) fn add(entries: &[At<CameraRecord>], scene: &mut SceneParts, context: &mut Context) {
    for (number, entry) in (1..).zip(entries) {
        let name = entry.get_ref().name.clone().unwrap_or_else(|| format!("camera {number}"));
        scene.cameras.extend(camera(entry, name, context));
    }
}

fn camera(entry: &At<CameraRecord>, name: String, context: &mut Context) -> Option<Camera> {
    let record = entry.get_ref();
    let metres = |at: &At<_>, unit_m: f64| Point::from(plain(*at.get_ref()).map(|c| c * unit_m));
    let position = metres(&record.position, context.unit_m);
    let given = [("target", record.target.is_some()), ("direction", record.direction.is_some())];
    context.one_of(&entry.span(), &format!("camera `{name}`"), &given)?;
    let (towards, at) = match (&record.target, &record.direction) {
        (Some(target), _) => (metres(target, context.unit_m) - position, target.span()),
        (None, Some(direction)) => (Vector::from(plain(*direction.get_ref())), direction.span()),
        (None, None) => return None,
    };
    let Some(direction) = towards.direction() else {
        context.problem(&at, format!("camera `{name}` looks nowhere"), "move its target");
        return None;
    };
    let up = up(record, direction, context)?;
    let fov_deg = record.vertical_fov_deg.as_ref().map_or(USUAL_FOV_DEG, |fov| fov.get_ref().0);
    if fov_deg >= 180.0 {
        let what = format!("camera `{name}` opens by {fov_deg} degrees");
        context.problem(&entry.span(), what, "give an angle below 180");
        return None;
    }
    Some(Camera { name, position, direction, up, vertical_fov_rad: fov_deg.to_radians() })
}

/// The given up direction, else the scene's, else, looking straight up or down, its horizontal axis
/// that is up on a plan: +y where z is up, -z where y is up.
fn up(record: &CameraRecord, direction: Direction, context: &mut Context) -> Option<Direction> {
    let is_parallel = |up: Direction| up.dot(direction).abs() > 1.0 - PARALLEL;
    let Some(given) = &record.up else {
        let usual = context.up.direction();
        return Some(match context.up {
            _ if !is_parallel(usual) => usual,
            UpAxis::Z => Direction::Y,
            UpAxis::Y => -Direction::Z,
        });
    };
    let up = Vector::from(plain(*given.get_ref())).direction().filter(|&up| !is_parallel(up));
    if up.is_none() {
        let what = "`up` is zero or along the line of sight";
        context.problem(&given.span(), what, "leave it out, or choose another direction");
    }
    up
}
