//! Nodes for cameras and lights, and the turn to +y up.

use super::document::{
    Camera, Light, LightReference, Node, NodeExtensions, Objects, Perspective, Spot,
};
use isolux::geometry::{Direction, Point, Vector};
use isolux::photometry::IntensityDistribution;
use isolux::scene::{self, Luminaire, LuminaireKind, Scene, UpAxis};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

/// Viewers pass every light to every material; with thousands they stop working, and unlit
/// surfaces show none. Scenes with more keep their luminaires in `extras` alone.
const MOST_LIGHTS: usize = 64;
/// Nearest visible distance, m.
const NEAR_M: f64 = 0.01;

/// The root: glTF is +y up.
pub(super) fn root(scene: &Scene, children: Vec<u32>) -> Node {
    let rotation = match scene.up() {
        UpAxis::Y => None,
        // A quarter turn about x, from +z to +y.
        UpAxis::Z => Some([-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2]),
    };
    Node { name: scene.name().to_owned(), children, rotation, ..Node::default() }
}

/// Adds the cameras of a scene.
pub(super) fn add_cameras(scene: &Scene, objects: &mut Objects) {
    for camera in scene.cameras() {
        objects.cameras.push(Camera {
            name: camera.name.clone(),
            kind: "perspective",
            perspective: Perspective { yfov: camera.vertical_fov_rad, znear: NEAR_M },
        });
        objects.nodes.push(Node {
            name: camera.name.clone(),
            camera: Some(objects.cameras.len() as u32 - 1),
            matrix: Some(camera_matrix(camera)),
            ..Node::default()
        });
    }
}

/// Adds nodes for the luminaires, where a viewer can bear them, and returns the lights.
pub(super) fn add_lights(scene: &Scene, objects: &mut Objects) -> Vec<Light> {
    if scene.luminaires().len() > MOST_LIGHTS {
        return Vec::new();
    }
    let mut lights = Vec::new();
    // glTF has no word for a sky.
    let is_sky = |luminaire: &&Luminaire| matches!(luminaire.kind, LuminaireKind::Sky { .. });
    for luminaire in scene.luminaires().iter().filter(|luminaire| !is_sky(luminaire)) {
        let (position, along) = place(luminaire);
        objects.nodes.push(Node {
            name: luminaire.name.clone(),
            matrix: Some(matrix(position, along)),
            extensions: Some(NodeExtensions {
                lights: LightReference { light: lights.len() as u32 },
            }),
            ..Node::default()
        });
        lights.push(light(luminaire));
    }
    lights
}

/// Lights and cameras look along their own -z.
fn camera_matrix(camera: &scene::Camera) -> [f64; 16] {
    let back = -camera.direction;
    let right = camera.up.to_vector().cross(back.to_vector()).direction();
    let right = right.unwrap_or_else(|| back.frame().0).to_vector();
    columns([right, back.to_vector().cross(right), back.to_vector()], camera.position)
}

fn matrix(position: Point, along: Direction) -> [f64; 16] {
    let back = -along;
    let (u, v) = back.frame();
    columns([u.to_vector(), v.to_vector(), back.to_vector()], position)
}

fn columns([x, y, z]: [Vector; 3], position: Point) -> [f64; 16] {
    let p = position;
    [x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, p.x, p.y, p.z, 1.0]
}

fn place(luminaire: &Luminaire) -> (Point, Direction) {
    match &luminaire.kind {
        LuminaireKind::Point { position, world_from_luminaire, .. } => {
            let nadir = world_from_luminaire.vector(-Direction::Z.to_vector()).direction();
            (*position, nadir.unwrap_or(-Direction::Z))
        }
        LuminaireKind::Directional { direction, .. } => (Point::ORIGIN, *direction),
        LuminaireKind::Sky { .. } => (Point::ORIGIN, -Direction::Z),
    }
}

/// What glTF can say of a luminaire: isotropic, spot and directional light exactly, other
/// distributions by their mean intensity.
fn light(luminaire: &Luminaire) -> Light {
    let (kind, intensity, spot) = match &luminaire.kind {
        LuminaireKind::Directional { illuminance_lx, .. } => ("directional", *illuminance_lx, None),
        LuminaireKind::Point { intensity, .. } => point_light(intensity),
        LuminaireKind::Sky { .. } => ("directional", 0.0, None),
    };
    // glTF wants channels of at most one; the rest goes into the intensity.
    let peak = luminaire.colour.max_channel();
    let colour = if peak > 0.0 { luminaire.colour / peak } else { luminaire.colour };
    Light {
        name: luminaire.name.clone(),
        kind,
        color: colour.map(|c| c.clamp(0.0, 1.0)).0,
        intensity: finite(intensity * peak),
        spot,
    }
}

fn point_light(intensity: &IntensityDistribution) -> (&'static str, f64, Option<Spot>) {
    match intensity {
        IntensityDistribution::Spot { peak_cd, inner_rad, outer_rad }
            if *outer_rad <= FRAC_PI_2 =>
        {
            let spot = Spot { inner_cone_angle: *inner_rad, outer_cone_angle: *outer_rad };
            ("spot", *peak_cd, Some(spot))
        }
        IntensityDistribution::Isotropic { intensity_cd } => ("point", *intensity_cd, None),
        other => ("point", other.luminous_flux_lm() / (4.0 * PI), None),
    }
}

/// JSON knows no infinity.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::MAX }
}
