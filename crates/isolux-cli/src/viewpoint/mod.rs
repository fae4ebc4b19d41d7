//! The views of a scene: by its cameras, from an eye, as Radiance says, or one that shows the most of it.

mod inside;
mod overview;
mod radiance;

use crate::failure::Failure;
use crate::flags::EyeFlags;
use crate::shown::names;
pub(crate) use inside::{IsLit, OWN};
use isolux::geometry::{Point, Vector};
use isolux::scene::{Camera, Scene, UpAxis};
use isolux_view::{Projection, View};
use overview::{Gaze, VERTICAL_FOV_RAD, gaze, overview, up_of};
use std::path::Path;

/// The sine of the steepest way from an eye to the middle of the scene that it looks along if it has no target.
const STEEPEST: f64 = 0.95;

/// A view and the name of its camera.
#[derive(Clone, Debug)]
pub(crate) struct NamedView {
    pub(crate) name: String,
    pub(crate) view: View,
}

impl From<&Camera> for NamedView {
    fn from(camera: &Camera) -> Self {
        Self { name: camera.name.clone(), view: camera.into() }
    }
}

/// The views that flags ask for: of cameras by name, of all of them, from an eye, or as Radiance says; else of the first camera of
/// the scene. There is always one at least. `None` where nothing is asked of a scene without cameras: its view is [`own`].
pub(crate) fn asked(
    scene: &Scene,
    flags: &EyeFlags,
    file: &Path,
) -> Result<Option<Vec<NamedView>>, Failure> {
    let views = perspectives(scene, flags, file)?;
    let shaped = |view| shaped(scene, flags, view);
    Ok(views.map(|views| views.into_iter().map(shaped).collect()))
}

/// The view of our own inside a scene, by what is lit there.
pub(crate) fn own(scene: &Scene, flags: &EyeFlags, is_lit: &IsLit<'_>) -> NamedView {
    let view = View::from(&inside::inside(scene, is_lit));
    shaped(scene, flags, NamedView { name: OWN.to_owned(), view })
}

/// The view, or all around from its eye if flags ask for that.
fn shaped(scene: &Scene, flags: &EyeFlags, NamedView { name, mut view }: NamedView) -> NamedView {
    if flags.panorama {
        let up = up_of(scene);
        // Eyes that look straight up or down have ahead of them what is up in their picture.
        if gaze(view.direction.to_vector(), up.to_vector()).is_err() {
            view.direction = view.up;
        }
        view = View { up, projection: Projection::Panorama, ..view };
    }
    NamedView { name, view }
}

fn perspectives(
    scene: &Scene,
    flags: &EyeFlags,
    file: &Path,
) -> Result<Option<Vec<NamedView>>, Failure> {
    let eye = |view| Some(vec![NamedView { name: "eye".to_owned(), view }]);
    if let Some(view) = radiance::asked(&flags.radiance)? {
        return Ok(eye(view));
    }
    if let Some(position) = flags.eye {
        return eye_of(scene, position, flags).map(eye).map_err(Failure::bad_input);
    }
    let of_scene = |what: String| Failure::of_file(file, what);
    match (flags.camera.as_slice(), flags.all_cameras, scene.cameras()) {
        (_, true, []) => Err(of_scene("there is no camera; leave --all-cameras out".to_owned())),
        (_, true, all) => Ok(Some(all.iter().map(NamedView::from).collect())),
        ([], _, []) => Ok(None),
        ([], _, [first, ..]) => Ok(Some(vec![first.into()])),
        (wanted, ..) => {
            let named = |name: &String| camera(scene, Some(name)).map(|c| (&c).into());
            wanted.iter().map(named).collect::<Result<_, _>>().map(Some).map_err(of_scene)
        }
    }
}

/// The view from an eye, which looks at its target, or at the middle of the scene, or ahead where that is almost straight above
/// or below.
fn eye_of(scene: &Scene, position: [f64; 3], flags: &EyeFlags) -> Result<View, String> {
    let point = |[x, y, z]: [f64; 3]| Point::new(x, y, z);
    let middle = || scene.bvh().mesh().bounds().map_or(Point::ORIGIN, |(a, b)| a.lerp(b, 0.5));
    let position = point(position);
    let towards = flags.target.map_or_else(middle, point) - position;
    let up = flags.up.map_or_else(|| up_of(scene).to_vector(), |[x, y, z]| Vector::new(x, y, z));
    let vertical_rad = flags.fov.map_or(VERTICAL_FOV_RAD, f64::to_radians);
    // Who stands above or below the middle looks ahead.
    let rise = towards.dot(up).abs() / (towards.length() * up.length()).max(f64::MIN_POSITIVE);
    let is_steep = towards.length() == 0.0 || rise > STEEPEST;
    let found = match flags.target.is_none() && is_steep {
        true => gaze(ahead(scene), up),
        false => gaze(towards, up),
    };
    let Gaze { direction, up } = found
        .map_err(|problem| format!("--eye: {problem}; give another --target, or --up X,Y,Z"))?;
    Ok(View { position, direction, up, projection: Projection::Perspective { vertical_rad } })
}

/// A level way: north in plans, and ahead in glTF.
fn ahead(scene: &Scene) -> Vector {
    match scene.up() {
        UpAxis::Y => Vector::new(0.0, 0.0, -1.0),
        UpAxis::Z => Vector::new(0.0, 1.0, 0.0),
    }
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
