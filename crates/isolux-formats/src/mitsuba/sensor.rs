//! Cameras.

use super::property::{float, origin_and_axis, string, transform};
use super::record::{Element, Wrong};
use isolux::scene::Camera;

/// Width and height of a film of which nothing is said.
const USUAL_FILM: [f64; 2] = [768.0, 576.0];
/// Width and height of 35 mm film, by which focal lengths are meant, mm.
const SMALL_FILM_MM: [f64; 2] = [36.0, 24.0];

/// The camera that a `perspective` sensor is.
pub(super) fn camera(sensor: &Element, number: usize) -> Result<Camera, Wrong> {
    let map = transform(sensor, "to_world")?;
    let nowhere = || ("it looks nowhere".to_owned(), "correct its `to_world`");
    let (position, direction) = origin_and_axis(&map).ok_or_else(nowhere)?;
    let up = map.columns[1].direction().ok_or_else(nowhere)?;
    let usual = format!("camera {number}");
    let name = sensor.attribute("id").map_or(usual, str::to_owned);
    Ok(Camera { name, position, direction, up, vertical_fov_rad: vertical_fov_rad(sensor)? })
}

fn vertical_fov_rad(sensor: &Element) -> Result<f64, Wrong> {
    let film = sensor.children.iter().find(|child| child.tag == "film");
    let side = |name: &str, usual: f64| match film {
        None => Ok(usual),
        Some(film) => Ok(float(film, name)?.filter(|side| *side >= 1.0).unwrap_or(usual)),
    };
    let aspect = side("width", USUAL_FILM[0])? / side("height", USUAL_FILM[1])?;
    let (fov_rad, axis) = match float(sensor, "fov")? {
        Some(fov_deg) => (fov_deg.to_radians(), string(sensor, "fov_axis").unwrap_or("x")),
        None => {
            let focal = string(sensor, "focal_length").unwrap_or("50mm");
            let mm = focal.trim().trim_end_matches("mm").trim().parse().ok();
            let mm = mm.filter(|mm: &f64| *mm > 0.0);
            let bad =
                || (format!("a focal length of `{focal}`"), "write it as `50mm`, or give `fov`");
            let [width, height] = SMALL_FILM_MM;
            let diagonal = libm::hypot(width, height);
            (2.0 * libm::atan(0.5 * diagonal / mm.ok_or_else(bad)?), "diagonal")
        }
    };
    if !(fov_rad > 0.0 && fov_rad < std::f64::consts::PI) {
        return Err((
            format!("an opening of {} degrees", fov_rad.to_degrees()),
            "give `fov` below 180",
        ));
    }
    let half = libm::tan(0.5 * fov_rad);
    let half_height = match axis {
        "y" => half,
        "x" => half / aspect,
        "diagonal" => half / libm::hypot(1.0, aspect),
        "smaller" => half / aspect.min(1.0),
        "larger" => half / aspect.max(1.0),
        other => {
            return Err((format!("fov_axis `{other}`"), "use x, y, diagonal, smaller or larger"));
        }
    };
    Ok(2.0 * libm::atan(half_height))
}
