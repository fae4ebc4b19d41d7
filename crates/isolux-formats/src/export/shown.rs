//! What a walk-through shows: surfaces with colours, viewpoints, and what the colours mean.

use crate::map_glb::{Displayed, Preview, displayed};
use isolux::geometry::{Direction, Point, Vector};
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene, UpAxis};
use std::f64::consts::{FRAC_PI_2, PI};

/// A scene as a browser of virtual worlds wants it.
pub(super) struct Shown {
    pub(super) title: String,
    /// What the colours mean, a sentence each.
    pub(super) info: Vec<String>,
    pub(super) exposure_m2_cd: f64,
    pub(super) white_cd_m2: f64,
    pub(super) accuracy: Option<f64>,
    /// Rotation to +y up: axis and angle, rad.
    pub(super) turn: ([f64; 3], f64),
    pub(super) viewpoints: Vec<Viewpoint>,
    pub(super) surfaces: Vec<Displayed>,
    /// How tall and fast a visitor is: 1.6 m and a walking pace, or less in a small scene.
    pub(super) avatar_m: f64,
}

/// A camera as VRML97 has them: it looks along -z with +y up, turned about an axis.
pub(super) struct Viewpoint {
    pub(super) name: String,
    pub(super) position: [f64; 3],
    pub(super) axis: [f64; 3],
    pub(super) angle_rad: f64,
    pub(super) field_of_view_rad: f64,
}

impl Shown {
    pub(super) fn of(scene: &Scene, map: &IlluminationMap, preview: &Preview) -> Self {
        let accuracy = map.provenance.accuracy.map(|a| a.reached);
        let reached = accuracy.map_or("error not known".to_owned(), |a| {
            format!("error of the scene {:.2} %", 100.0 * a)
        });
        let info = vec![
            format!("Illumination map of isolux {}; {reached}.", map.provenance.version),
            "Colours are luminance rho E / pi of every vertex in cd/m2, exposed, tone mapped (Reinhard et \
             al. 2002, equation 4) and encoded as sRGB; textures by their mean colour."
                .to_owned(),
            format!(
                "Exposure {} m2/cd, white {} cd/m2.",
                preview.exposure_m2_cd, preview.white_cd_m2
            ),
        ];
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        Self {
            title: scene.name().to_owned(),
            info,
            exposure_m2_cd: preview.exposure_m2_cd,
            white_cd_m2: preview.white_cd_m2,
            accuracy,
            turn: match scene.up() {
                UpAxis::Y => ([1.0, 0.0, 0.0], 0.0),
                UpAxis::Z => ([1.0, 0.0, 0.0], -FRAC_PI_2),
            },
            viewpoints: scene.cameras().iter().map(Viewpoint::of).collect(),
            surfaces: displayed(scene, map, preview),
            avatar_m: (0.25 * extent_m).min(1.6),
        }
    }
}

impl Viewpoint {
    fn of(camera: &Camera) -> Self {
        let back = -camera.direction;
        let right = camera.up.to_vector().cross(back.to_vector()).direction();
        let right = right.unwrap_or_else(|| back.frame().0);
        let up = back.to_vector().cross(right.to_vector());
        let (axis, angle_rad) = axis_and_angle([right.to_vector(), up, back.to_vector()]);
        let Point { x, y, z } = camera.position;
        Self {
            name: camera.name.clone(),
            position: [x, y, z],
            axis: [axis.x, axis.y, axis.z],
            angle_rad,
            field_of_view_rad: camera.vertical_fov_rad.clamp(1e-3, PI - 1e-3),
        }
    }
}

/// Of the rotation with such columns.
fn axis_and_angle([x, y, z]: [Vector; 3]) -> (Vector, f64) {
    let twice_sine = Vector::new(y.z - z.y, z.x - x.z, x.y - y.x);
    let cosine = 0.5 * (x.x + y.y + z.z - 1.0);
    let angle_rad = libm::atan2(0.5 * twice_sine.length(), cosine);
    if let Some(axis) = twice_sine.direction().filter(|_| angle_rad < PI - 1e-6) {
        return (axis.to_vector(), angle_rad);
    }
    if angle_rad < FRAC_PI_2 {
        return (Direction::Y.to_vector(), 0.0);
    }
    // Half a turn: a vector plus its image lies along the axis; one of the three is long enough.
    let ends = [
        x + Vector::new(1.0, 0.0, 0.0),
        y + Vector::new(0.0, 1.0, 0.0),
        z + Vector::new(0.0, 0.0, 1.0),
    ];
    let longest = ends.into_iter().max_by(|a, b| a.length().total_cmp(&b.length()));
    let axis = longest.and_then(Vector::direction).unwrap_or(Direction::Y);
    (axis.to_vector(), angle_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(direction: [f64; 3], up: [f64; 3]) -> Camera {
        let along = |v: [f64; 3]| Vector::from(v).direction().unwrap();
        Camera {
            name: "door".into(),
            position: Point::new(1.0, 2.0, 3.0),
            direction: along(direction),
            up: along(up),
            vertical_fov_rad: 1.0,
        }
    }

    /// Rodrigues' rotation of a vector.
    fn rotated(v: Vector, view: &Viewpoint) -> Vector {
        let axis = Vector::from(view.axis);
        let (sine, cosine) = (view.angle_rad.sin(), view.angle_rad.cos());
        v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine))
    }

    #[test]
    fn viewpoints_look_where_cameras_do() {
        for (direction, up) in [
            ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
            ([0.0, 0.0, -1.0], [0.0, -1.0, 0.0]),
            ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
            ([-0.3, 0.8, -0.2], [0.0, 0.0, 1.0]),
            ([0.0, 0.0, 1.0], [1.0, 1.0, 0.0]),
        ] {
            let camera = camera(direction, up);
            let view = Viewpoint::of(&camera);
            let looks = rotated(Vector::new(0.0, 0.0, -1.0), &view);
            let off = (looks - camera.direction.to_vector()).length();
            assert!(off < 1e-9, "{direction:?}: {looks:?}");
            let upwards = rotated(Vector::new(0.0, 1.0, 0.0), &view);
            assert!(upwards.dot(camera.up.to_vector()) > 0.0, "{direction:?}: {upwards:?}");
            assert!(upwards.dot(camera.direction.to_vector()).abs() < 1e-9);
        }
    }
}
