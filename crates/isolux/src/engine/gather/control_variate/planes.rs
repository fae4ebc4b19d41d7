//! The largest plane surfaces of a scene, as rectangles.

use crate::elements::{FewNumbers, carries_map};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::{self, CosineHemisphere, Sequence};
use crate::scene::Scene;
use isolux_geometry::{Point, Ray, Triangle, Vector};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The largest number of rectangles: a room has six walls, each with two sides.
const MOST_RECTANGLES: usize = 16;
/// The least share of all surface that a rectangle has.
const LEAST_AREA_SHARE: f64 = 0.02;
/// The least share of a rectangle that the surface fills.
const LEAST_FILLED_SHARE: f64 = 0.5;
/// The tolerance for triangles of one plane: on components of normals, and on distances as a share of the size of the
/// scene.
const PLANE_TOLERANCE: f64 = 1e-4;
/// The distance before or behind a wall within which a place or the end of a ray lies on it, as a share of the size
/// of the wall and, for rays, of their length.
pub(super) const BESIDE_WALL_SHARE: f64 = 1e-3;
/// A rectangle that faces the room.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Rectangle {
    pub(super) middle: Point,
    /// The directions of its sides, and its normal.
    pub(super) axes: [Vector; 3],
    /// Half of its sides, m.
    pub(super) half_m: [f64; 2],
}

/// The largest number of planes that are kept apart.
const MOST_PLANES: usize = 1 << 16;
/// The number of triangles of a plane whose edges are tried as directions of its sides.
const SIDE_TRIANGLES: usize = 8;

/// The rounded normal of a plane and its distance from a point.
type Key = [i32; 4];

/// The triangles of one plane.
struct Plane {
    normal: Vector,
    triangles: Vec<Triangle>,
}

/// A side of a triangle, with the plane that it lies in.
struct OnPlane {
    key: Key,
    normal: Vector,
    triangle: Triangle,
}

/// The largest plane surfaces that carry a map, as bounding rectangles that they fill well enough.
pub(super) fn largest(scene: &Scene) -> Vec<Rectangle> {
    let Some((low, high)) = scene.bvh().mesh().bounds() else { return Vec::new() };
    let of = (low, (high - low).length());
    let sides = || {
        let all = (0..scene.triangle_count()).flat_map(|t| [(t, false), (t, true)]);
        let mapped = all.filter(|&(t, back)| carries_map(scene, t, back));
        mapped.filter_map(|(t, back)| plane_of(scene.triangle(t), back, of))
    };
    let mut areas_m2: HashMap<Key, f64, FewNumbers> = HashMap::default();
    let mut all_m2 = 0.0;
    for OnPlane { key, triangle, .. } in sides() {
        let own_m2 = triangle.area();
        all_m2 += own_m2;
        if areas_m2.len() < MOST_PLANES || areas_m2.contains_key(&key) {
            *areas_m2.entry(key).or_default() += own_m2;
        }
    }
    let mut large: Vec<(Key, f64)> =
        areas_m2.into_iter().filter(|(_, m2)| *m2 >= LEAST_AREA_SHARE * all_m2).collect();
    large.sort_by(|(a, own_m2), (b, m2)| m2.total_cmp(own_m2).then(a.cmp(b)));
    large.truncate(MOST_RECTANGLES);
    let mut planes: Vec<Option<Plane>> = large.iter().map(|_| None).collect();
    for OnPlane { key, normal, triangle } in sides().filter(|_| !large.is_empty()) {
        if let Some(k) = large.iter().position(|(own, _)| *own == key) {
            let plane = planes[k].get_or_insert(Plane { normal, triangles: Vec::new() });
            plane.triangles.push(triangle);
        }
    }
    let areas_m2 = large.iter().map(|(_, m2)| *m2);
    planes.iter().flatten().zip(areas_m2).filter_map(|(plane, m2)| plane.rectangle(m2)).collect()
}

/// A side of a triangle with its plane; `None` if the triangle has no area. The distance of the plane is measured
/// from a point of the scene and relative to the size of the scene, m.
fn plane_of(triangle: Triangle, back: bool, (from, size_m): (Point, f64)) -> Option<OnPlane> {
    let [a, b, c] = triangle.corners;
    let normal = (b - a).cross(c - a).direction()?.to_vector();
    let normal = if back { -normal } else { normal };
    let far = (a - from).dot(normal) / size_m;
    let key = [normal.x, normal.y, normal.z, far].map(|x| libm::round(x / PLANE_TOLERANCE) as i32);
    Some(OnPlane { key, normal, triangle })
}

impl Plane {
    /// The smallest bounding rectangle with sides along some edge, if the surface fills enough of it.
    fn rectangle(&self, area_m2: f64) -> Option<Rectangle> {
        let every = self.triangles.len().div_ceil(SIDE_TRIANGLES).max(1);
        let edges = self.triangles.iter().step_by(every).flat_map(|t| {
            let [a, b, c] = t.corners;
            [b - a, c - b, a - c]
        });
        let about = |edge: Vector| {
            let along = edge.direction()?.to_vector();
            let axes = [along, self.normal.cross(along), self.normal];
            let from = self.triangles[0].corners[0];
            let [mut low, mut high] = [[0.0_f64; 2]; 2];
            for corner in self.triangles.iter().flat_map(|t| t.corners) {
                for k in 0..2 {
                    let at = (corner - from).dot(axes[k]);
                    low[k] = low[k].min(at);
                    high[k] = high[k].max(at);
                }
            }
            let middle = (0..2).fold(from, |at, k| at + axes[k] * (0.5 * (low[k] + high[k])));
            Some(Rectangle { middle, axes, half_m: [0, 1].map(|k| 0.5 * (high[k] - low[k])) })
        };
        let whole_m2 = |r: &Rectangle| 4.0 * r.half_m[0] * r.half_m[1];
        let smallest =
            edges.filter_map(about).min_by(|a, b| whole_m2(a).total_cmp(&whole_m2(b)))?;
        (area_m2 >= LEAST_FILLED_SHARE * whole_m2(&smallest)).then_some(smallest)
    }
}

/// The number of rays that test whether a rectangle faces anything, as the inner side of a wall does.
const FACING_RAYS: u32 = 16;

impl Rectangle {
    /// Whether more than half of the rays from all over it meet something.
    pub(super) fn faces_something(&self, scene: &Scene) -> bool {
        let sequence = Sequence::new(sampling::Key::new(0));
        let Some(axis) = self.axes[2].direction() else { return false };
        let meets = |&index: &u32| {
            let mut dice = Dice::new(sequence, index);
            let [x, y] = dice.pair().map(|p| 2.0 * p - 1.0);
            let Some(at) = self.surface(scene, [x, y]) else { return false };
            let local = CosineHemisphere::sample(dice.pair());
            scene.bvh().closest_hit(&at.leave(axis.from_local(local))).is_some()
        };
        2 * (0..FACING_RAYS).filter(meets).count() as u32 > FACING_RAYS
    }

    /// The surface point at a place of the rectangle, if there is a surface.
    pub(super) fn surface(&self, scene: &Scene, [x, y]: [f64; 2]) -> Option<SurfacePoint> {
        let at =
            self.middle + self.axes[0] * (x * self.half_m[0]) + self.axes[1] * (y * self.half_m[1]);
        let before_m = BESIDE_WALL_SHARE * self.half_m[0].min(self.half_m[1]);
        let ray = Ray::new(at + self.axes[2] * before_m, (-self.axes[2]).direction()?)
            .up_to((2.0 * before_m) as f32);
        let hit = scene.bvh().closest_hit(&ray)?;
        Some(SurfacePoint::from_hit(scene, &hit))
    }
}
