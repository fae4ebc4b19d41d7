//! The camera of a view: one of the scene's, or one that shows the most of it.

mod inside;
mod overview;
mod radiance;

use crate::flags::EyeFlags;
use crate::shown::names;
pub(crate) use inside::IsLit;
use isolux::geometry::{Point, Vector};
use isolux::scene::{Camera, Scene};
use overview::{VERTICAL_FOV_RAD, looking, overview, up_of};

/// The camera that flags ask for: by name, by an eye, or by a view file; else the first of the scene, or else one of our
/// own inside it.
pub(crate) fn chosen(
    scene: &Scene,
    name: Option<&str>,
    eye: &EyeFlags,
    is_lit: &IsLit<'_>,
) -> Result<Camera, String> {
    if let Some(path) = &eye.radiance_view {
        return radiance::read(path);
    }
    if let Some(position) = eye.eye {
        return eye_of(scene, position, eye);
    }
    match (name, scene.cameras()) {
        (None, []) => Ok(inside::inside(scene, is_lit)),
        _ => camera(scene, name),
    }
}

/// The camera at an eye, which looks at its target, or at the middle of the scene.
fn eye_of(scene: &Scene, position: [f64; 3], flags: &EyeFlags) -> Result<Camera, String> {
    let point = |[x, y, z]: [f64; 3]| Point::new(x, y, z);
    let middle = || scene.bvh().mesh().bounds().map_or(Point::ORIGIN, |(a, b)| a.lerp(b, 0.5));
    let position = point(position);
    let towards = flags.target.map_or_else(middle, point) - position;
    let up = flags.up.map_or_else(|| up_of(scene).to_vector(), |[x, y, z]| Vector::new(x, y, z));
    let fov_deg = flags.fov.unwrap_or(VERTICAL_FOV_RAD.to_degrees());
    looking(position, towards, up, fov_deg)
        .map_err(|problem| format!("--eye: {problem}; give another --target, or --up X,Y,Z"))
}

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
