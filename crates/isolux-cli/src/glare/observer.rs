//! One observer: who looks, and the rating of what is seen.

use super::sources::{Shining, shining};
use crate::failure::Failure;
use crate::flags::GlareFlags;
use crate::notes::{Note, note};
use crate::quantity::significant;
use crate::shown::name;
use crate::viewpoint;
use isolux::engine::{MapReader, ProbePoint};
use isolux::geometry::{Point, Vector};
use isolux::map::{Figure, NORMAL_95};
use isolux::scene::{Camera, Scene};
use isolux::units::to_error;
use serde::Serialize;
use std::f64::consts::{LN_10, PI};

/// Below this the unified glare rating is that of no glare (CIE 117:1995).
pub(super) const NO_GLARE: f64 = 10.0;

/// What an observer sees.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Observed {
    pub(super) observer: String,
    pub(super) position: [f64; 3],
    pub(super) direction: [f64; 3],
    /// `None` without a source in view, or where nothing is known of the background.
    pub(super) ugr: Option<Figure>,
    pub(super) background_cd_m2: f64,
    indirect_at_eye_lx: f64,
    pub(super) sources_in_view: usize,
    #[serde(skip)]
    pub(super) points: usize,
}

/// Who looks: the cameras asked for, an eye, or all cameras.
pub(super) fn eyes(flags: &GlareFlags, scene: &Scene) -> Result<Vec<Camera>, Failure> {
    if let Some(eye) = flags.eye {
        return looking(scene, eye, flags.target).map(|eye| vec![eye]);
    }
    if flags.camera.is_empty() && scene.cameras().is_empty() {
        return Err(Failure::bad_input(format!(
            "{}: has no cameras; say who looks by --eye and --target",
            flags.map.display()
        )));
    }
    if flags.camera.is_empty() {
        return Ok(scene.cameras().to_vec());
    }
    let of = |name: &String| viewpoint::camera(scene, Some(name)).map_err(Failure::bad_input);
    flags.camera.iter().map(of).collect()
}

/// An eye that looks at a place, level unless that is given.
fn looking(scene: &Scene, eye: [f64; 3], target: Option<[f64; 3]>) -> Result<Camera, Failure> {
    let up = scene.up().direction();
    let position = Point::from(eye);
    let way = target.map(|target| Point::from(target) - position);
    let direction = way.and_then(Vector::direction);
    let direction = direction.ok_or_else(|| {
        Failure::bad_input("--eye needs a --target that is somewhere else; give what is looked at")
    })?;
    if direction.dot(up).abs() > 1.0 - 1e-9 {
        return Err(Failure::bad_input(
            "--target lies straight above or below the eye; look ahead",
        ));
    }
    Ok(Camera { name: "eye".into(), position, direction, up, vertical_fov_rad: 1.0 })
}

/// What an eye sees; `None` inside of something.
pub(super) fn observed(scene: &Scene, reader: &MapReader, eye: &Camera) -> Option<Observed> {
    let normal = eye.direction.to_normal();
    let read = reader.measure(ProbePoint { position: eye.position, normal })?;
    let shining = shining(scene, eye);
    let indirect_lx = read.indirect_lx.luminance();
    Some(Observed {
        observer: eye.name.clone(),
        position: eye.position.into(),
        direction: eye.direction.to_vector().into(),
        ugr: rating(&shining, indirect_lx, read.indirect_standard_error_lx),
        background_cd_m2: indirect_lx / PI,
        indirect_at_eye_lx: indirect_lx,
        sources_in_view: shining.seen,
        points: shining.points,
    })
}

/// What the rating of an observer does not say.
pub(super) fn warn(of: &Observed) {
    let eye = name(&of.observer);
    if of.points > 0 {
        let count = of.points;
        let what = "luminaires have no luminous area and so no luminance; they are left out";
        note(Note::Warning, format!("observer `{eye}`: {count} {what}"));
    }
    if of.sources_in_view == 0 {
        let what = "nothing that shines is in view";
        let rest = "skies and the sun are not counted";
        note(Note::Warning, format!("observer `{eye}`: {what}; {rest}"));
    }
}

/// CIE 117:1995: `8 lg (0.25 / Lb sum L^2 omega / p^2)`, Lb the indirect illuminance at the eye over pi.
fn rating(shining: &Shining, indirect_lx: f64, error_lx: f64) -> Option<Figure> {
    if shining.sum <= 0.0 || indirect_lx <= 0.0 || !error_lx.is_finite() {
        return None;
    }
    let value = 8.0 * libm::log10(0.25 * PI / indirect_lx * shining.sum);
    let relative = libm::hypot(error_lx / indirect_lx, shining.error / shining.sum);
    let half = NORMAL_95 * 8.0 / LN_10 * relative;
    Some(Figure { value, low: value - half, high: value + half })
}

/// A rating as it is printed.
pub(super) fn written(ugr: Option<Figure>) -> String {
    match ugr {
        None => "-".to_owned(),
        Some(ugr) if ugr.high < NO_GLARE => "below 10".to_owned(),
        Some(Figure { value, low, high }) => {
            let written = |ugr: f64| to_error(ugr, (0.5 * (high - low)).max(0.05));
            format!("{} ({} to {})", written(value), written(low), written(high))
        }
    }
}

pub(super) fn text(observed: &[Observed]) -> String {
    let row = |of: &Observed| {
        vec![
            name(&of.observer),
            written(of.ugr),
            significant(of.background_cd_m2, 3),
            of.sources_in_view.to_string(),
        ]
    };
    let header = ["observer", "UGR", "background, cd/m2", "sources in view"];
    crate::console::table(&header, &observed.iter().map(row).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.25 / 20 cd/m2 of 1e4 cd/m2 over 0.01 sr at p = 2: 8 lg 3125 = 27.96.
    #[test]
    fn a_rating_by_hand() {
        let sum = 1e8 * 0.01 / 4.0;
        let shining = Shining { sum, error: 0.0, seen: 1, points: 0 };
        let ugr = rating(&shining, 20.0 * PI, 0.0).unwrap();
        assert!((ugr.value - 8.0 * libm::log10(3125.0)).abs() < 1e-12, "{ugr:?}");
        assert_eq!(ugr.low, ugr.high);
        let noisy = rating(&shining, 20.0 * PI, 0.02 * 20.0 * PI).unwrap();
        // A hundredth of the background is 0.035.
        assert!((noisy.high - noisy.value - 1.96 * 2.0 * 0.034_74).abs() < 1e-3, "{noisy:?}");
        assert_eq!(rating(&Shining::default(), 100.0, 1.0), None);
        assert_eq!(rating(&shining, 0.0, 0.0), None);
    }
}
