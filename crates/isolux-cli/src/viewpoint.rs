//! The camera of a view: one of the scene's, or one that shows the most of it.

use crate::shown::names;
use isolux::geometry::{Direction, Point, Vector};
use isolux::scene::{Camera, Scene, UpAxis};

/// Where the eye stands between the middle of the scene and a corner of the box around it: far back,
/// but inside of the walls.
const TOWARDS_CORNER: f64 = 0.86;
/// A wide angle, as of a 20 mm lens.
const VERTICAL_FOV_RAD: f64 = 1.15;

/// The camera of that name, or what is wrong with it; without a name, the first one of the scene,
/// or one of our own.
pub(crate) fn camera(scene: &Scene, name: Option<&str>) -> Result<Camera, String> {
    let Some(name) = name else {
        return Ok(scene.cameras().first().cloned().unwrap_or_else(|| overview(scene)));
    };
    scene.cameras().iter().find(|c| c.name == name).cloned().ok_or_else(|| match scene.cameras() {
        [] => format!(
            "there is no camera `{name}`, nor any other; leave --camera out for an overview"
        ),
        all => {
            let names = names(all.iter().map(|c| c.name.as_str()));
            format!("there is no camera `{name}`; choose one of {names}")
        }
    })
}

/// From a corner of the box around the scene towards its middle.
fn overview(scene: &Scene) -> Camera {
    let (low, high) = scene.bvh().mesh().bounds().unwrap_or((Point::ORIGIN, Point::ORIGIN));
    let middle = low.lerp(high, 0.5);
    let half = (high - low) * (0.5 * TOWARDS_CORNER);
    // Eye height in a room rather than the ceiling.
    let (step, up) = match scene.up() {
        UpAxis::Y => (Vector::new(half.x, 0.5 * half.y, half.z), Direction::Y),
        UpAxis::Z => (Vector::new(half.x, -half.y, 0.5 * half.z), Direction::Z),
    };
    Camera {
        name: "overview".to_owned(),
        position: middle + step,
        direction: (-step).direction().unwrap_or(Direction::X),
        up,
        vertical_fov_rad: VERTICAL_FOV_RAD,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux_compare::builtin;

    #[test]
    fn a_scene_without_cameras_is_seen_from_inside() {
        let scene = Scene::assemble(builtin("cube").unwrap()).unwrap();
        let camera = camera(&scene, None).unwrap();
        assert!(<[f64; 3]>::from(camera.position).iter().all(|c| c.abs() < 5.0));
        assert!(camera.up.dot(camera.direction).abs() < 0.9);
    }

    #[test]
    fn a_name_that_is_none_is_refused() {
        let scene = Scene::assemble(builtin("cube").unwrap()).unwrap();
        assert!(camera(&scene, Some("door")).is_err_and(|what| what.contains("`door`")));
    }
}
