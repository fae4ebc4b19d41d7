//! A camera of our own: at eye height inside the scene, where it sees the most lit space.

use super::overview::{VERTICAL_FOV_RAD, overview, up_of};
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::scene::{Camera, Scene, UpAxis};
use isolux_view::{Size, ViewRays};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// The height of the eyes of somebody who stands, m (EN 12464-1: 1.6 m).
const EYE_HEIGHT_M: f64 = 1.6;
/// The heights of rooms that people stand in, m. In others, as models in another unit, the eye is a little below the middle.
const ROOM_HEIGHTS_M: std::ops::Range<f64> = 1.8..20.0;
/// The height of the eye in other scenes, as a share of theirs.
const BELOW_MIDDLE: f64 = 0.45;
/// The places tried along each horizontal axis.
const PLACES_ALONG: usize = 7;
/// The directions tried at each place.
const DIRECTIONS: usize = 16;
/// The slope of the view: the floor fills more of a picture than the ceiling.
const DESCENT: f64 = 0.12;
/// The rays of a view, across and down.
const RAYS: [u32; 2] = [16, 9];
/// The distance up to which nothing may stand before the eye, as a share of the scene's extent.
const CLEARANCE: f64 = 0.02;

/// The name of the view.
pub(crate) const OWN: &str = "inside";

/// Whether light is known at a place of a triangle, by its number, whether it is its back, and barycentric coordinates.
pub(crate) type IsLit<'a> = dyn Fn(u32, bool, [f64; 2]) -> bool + Sync + 'a;

/// The camera that sees most lit space; the overview where none sees any.
pub(super) fn inside(scene: &Scene, is_lit: &IsLit<'_>) -> Camera {
    let Some((low, high)) = scene.bvh().mesh().bounds() else { return overview(scene) };
    let extent_m = (high - low).length();
    let views: Vec<Camera> = places(scene, low, high)
        .into_iter()
        .filter(|&at| is_clear(scene, at, CLEARANCE * extent_m))
        .flat_map(|at| (0..DIRECTIONS).map(move |k| camera(scene, at, k)))
        .collect();
    let seen = |camera: &Camera| seen(scene, camera, extent_m, is_lit);
    let scores: Vec<f64> = views.par_iter().map(seen).collect();
    // The first of equals, so that the choice is the same on every machine.
    let best = (0..scores.len()).fold(None, |best: Option<usize>, k| match best {
        Some(best) if scores[best] >= scores[k] => Some(best),
        _ => Some(k),
    });
    best.filter(|&k| scores[k] > 0.0).map_or_else(|| overview(scene), |k| views[k].clone())
}

/// The unit vectors along the horizontal axes and upwards.
fn axes(scene: &Scene) -> [Vector; 3] {
    let [x, y, z] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|[x, y, z]| Vector::new(x, y, z));
    match scene.up() {
        UpAxis::Y => [z, x, y],
        UpAxis::Z => [x, y, z],
    }
}

/// A grid of places at eye height.
fn places(scene: &Scene, low: Point, high: Point) -> Vec<Point> {
    let [east, north, up] = axes(scene);
    let size = high - low;
    let height_m = size.dot(up);
    let eye_m = match ROOM_HEIGHTS_M.contains(&height_m) {
        true => EYE_HEIGHT_M.min(0.7 * height_m),
        false => BELOW_MIDDLE * height_m,
    };
    let share = |k: usize| (k as f64 + 0.5) / PLACES_ALONG as f64;
    let at = |k: usize| {
        let [i, j] = [share(k % PLACES_ALONG), share(k / PLACES_ALONG)];
        low + east * (i * size.dot(east)) + north * (j * size.dot(north)) + up * eye_m
    };
    (0..PLACES_ALONG * PLACES_ALONG).map(at).collect()
}

/// Whether nothing stands closer to a place than a distance, along the axes.
fn is_clear(scene: &Scene, at: Point, distance_m: f64) -> bool {
    let ways = axes(scene).into_iter().flat_map(|axis| [axis, axis * -1.0]);
    let mut ways = ways.filter_map(Vector::direction);
    ways.all(|way| !scene.bvh().any_hit(&Ray::new(at, way).up_to(distance_m as f32)))
}

fn camera(scene: &Scene, position: Point, number: usize) -> Camera {
    let [east, north, up] = axes(scene);
    let (sin, cos) = libm::sincos(TAU * number as f64 / DIRECTIONS as f64);
    let towards = east * cos + north * sin - up * DESCENT;
    Camera {
        name: OWN.to_owned(),
        position,
        direction: towards.direction().unwrap_or(Direction::X),
        up: up_of(scene),
        vertical_fov_rad: VERTICAL_FOV_RAD,
    }
}

/// The lit space that a camera sees: over its rays that end on known light, the sum of the roots of their lengths. The
/// root keeps a view down one long corridor from being better than a view of a room.
fn seen(scene: &Scene, camera: &Camera, extent_m: f64, is_lit: &IsLit<'_>) -> f64 {
    let [across, down] = RAYS;
    let Ok(size) = Size::new(across, down) else { return 0.0 };
    let rays = ViewRays::new(camera, size);
    let lit = |k: u32| {
        let middle = |pixel: u32| f64::from(pixel) + 0.5;
        let (ray, _) = rays.through(middle(k % across), middle(k / across))?;
        let hit = scene.bvh().closest_hit(&ray)?;
        let is_lit = is_lit(hit.triangle, hit.back, [f64::from(hit.u), f64::from(hit.v)]);
        is_lit.then(|| (f64::from(hit.t) / extent_m).max(0.0).sqrt())
    };
    (0..across * down).filter_map(lit).sum()
}
