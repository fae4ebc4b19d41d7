//! A place on one side of a surface, and the start of rays there.

use crate::elements::{PlaceOnSide, Subdivision};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Direction, Hit, Normal, Point, Ray};
use serde::{Deserialize, Serialize};

/// The least cosine between the normals of triangles in one plane. The difference to one is for the rounding of
/// `f32` coordinates.
pub(crate) const COPLANAR_COS: f64 = 1.0 - 1e-6;

/// A place on one side of a triangle; both normals point to that side.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct SurfacePoint {
    pub(crate) triangle: u32,
    pub(crate) back: bool,
    /// Barycentric weight of the second corner; `v` is that of the third.
    pub(crate) u: f64,
    pub(crate) v: f64,
    pub(crate) point: Point,
    pub(crate) geometric: Normal,
    pub(crate) shading: Normal,
    /// Distance from the surface at which rays start, m.
    pub(crate) away_m: f64,
}

/// The start of rays: their origin, the axis of their distribution, and the triangle that they leave and skip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stand {
    pub(crate) origin: Point,
    pub(crate) normal: Normal,
    pub(crate) triangle: u32,
}

impl SurfacePoint {
    /// The same place as a plane with another normal.
    pub(crate) fn facing(&self, normal: Normal) -> Self {
        Self { geometric: normal, shading: normal, ..*self }
    }

    /// The place that a ray hits.
    pub(crate) fn from_hit(scene: &Scene, hit: &Hit) -> Self {
        Self::new(scene, hit.triangle, hit.back, f64::from(hit.u), f64::from(hit.v))
    }

    /// The place with the barycentric weights of `place`.
    pub(crate) fn on_side(scene: &Scene, place: PlaceOnSide) -> Self {
        Self::new(scene, place.triangle, place.back, place.uv[0], place.uv[1])
    }

    /// The place on a side of a triangle with the barycentric weights `u` and `v`.
    pub(crate) fn new(scene: &Scene, triangle: u32, back: bool, u: f64, v: f64) -> Self {
        let corners = scene.triangle(triangle);
        let geometric = scene.geometric_normal(triangle);
        let shading = scene.shading_normal(triangle, u, v);
        let point = corners.point(u, v);
        Self {
            triangle,
            back,
            u,
            v,
            point,
            geometric: if back { -geometric } else { geometric },
            shading: if back { -shading } else { shading },
            away_m: scene.bvh().offset_m(point),
        }
    }

    /// A random place in a node of a subdivision: maps a point of the unit square, uniformly by area.
    pub(crate) fn in_node(
        scene: &Scene,
        subdivision: &Subdivision,
        node: u32,
        [a, b]: [f64; 2],
    ) -> Self {
        let (_, origin) = subdivision.node(node);
        let root = a.sqrt();
        let point = subdivision.triangle(node).point(root * (1.0 - b), root * b);
        let [u, v] = scene.triangle(origin.triangle).barycentric(point);
        Self::new(scene, origin.triangle, origin.back, u, v)
    }

    /// The centroid of a node of a subdivision.
    pub(crate) fn amid_node(scene: &Scene, subdivision: &Subdivision, node: u32) -> Self {
        // This point of the unit square maps to equal weights.
        Self::in_node(scene, subdivision, node, [4.0 / 9.0, 0.5])
    }

    /// A place in free space that faces along `normal`; `away_m` is the rounding of the scene there, m.
    pub(crate) fn in_space(point: Point, normal: Normal, away_m: f64) -> Self {
        let (geometric, shading) = (normal, normal);
        Self { triangle: u32::MAX, back: false, u: 0.0, v: 0.0, point, geometric, shading, away_m }
    }

    /// The origin of rays that leave this side.
    pub(crate) fn start(&self) -> Point {
        self.point + self.geometric * self.away_m
    }

    /// The start of rays that are distributed about the shading normal.
    pub(crate) fn stand(&self) -> Stand {
        Stand { origin: self.start(), normal: self.shading, triangle: self.triangle }
    }

    /// The ray that leaves this side.
    pub(crate) fn leave(&self, direction: Direction) -> Ray {
        Ray::new(self.start(), direction).skipping(self.triangle)
    }

    /// The ray that passes through to the other side.
    pub(crate) fn cross(&self, direction: Direction) -> Ray {
        self.other_side().leave(direction)
    }

    /// Diffuse reflectance; zero where the surface is transparent.
    pub(crate) fn reflectance(&self, scene: &Scene) -> Rgb {
        let finish = scene.material(self.triangle).finish(self.back);
        finish.map_or(Rgb::BLACK, |finish| {
            scene.diffuse_reflectance(finish, self.triangle, self.u, self.v)
        })
    }

    /// The same place on the other side of the triangle.
    pub(crate) fn other_side(&self) -> Self {
        Self { back: !self.back, geometric: -self.geometric, shading: -self.shading, ..*self }
    }
}
