//! A place on one side of a surface.

use crate::elements::{PlaceOnSide, Subdivision};
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Direction, Hit, Normal, Point, Ray};

/// A place on one side of a triangle; both normals point to that side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfacePoint {
    pub(crate) triangle: u32,
    pub(crate) back: bool,
    /// Barycentric weights of the second and third corner.
    pub(crate) u: f64,
    pub(crate) v: f64,
    pub(crate) point: Point,
    pub(crate) geometric: Normal,
    pub(crate) shading: Normal,
    /// How far from it rays start.
    pub(crate) away_m: f64,
}

impl SurfacePoint {
    /// Where a ray arrives.
    pub(crate) fn from_hit(scene: &Scene, hit: &Hit) -> Self {
        Self::new(scene, hit.triangle, hit.back, f64::from(hit.u), f64::from(hit.v))
    }

    /// A place by its barycentric weights.
    /// The place itself.
    pub(crate) fn on_side(scene: &Scene, place: PlaceOnSide) -> Self {
        Self::new(scene, place.triangle, place.back, place.uv[0], place.uv[1])
    }

    /// The place by its weights.
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

    /// A place of a node of a subdivision, for a point of the unit square, evenly over its area.
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

    /// The middle of a node of a subdivision.
    pub(crate) fn amid_node(scene: &Scene, subdivision: &Subdivision, node: u32) -> Self {
        // The point of the unit square that is taken to equal weights.
        Self::in_node(scene, subdivision, node, [4.0 / 9.0, 0.5])
    }

    /// A place in space that faces a way, and the rounding of the scene there, m.
    pub(crate) fn in_space(point: Point, normal: Normal, away_m: f64) -> Self {
        let (geometric, shading) = (normal, normal);
        Self { triangle: u32::MAX, back: false, u: 0.0, v: 0.0, point, geometric, shading, away_m }
    }

    /// Where rays start that leave this side.
    pub(crate) fn start(&self) -> Point {
        self.point + self.geometric * self.away_m
    }

    /// The ray that leaves this side.
    pub(crate) fn leave(&self, direction: Direction) -> Ray {
        Ray::new(self.start(), direction).skipping(self.triangle)
    }

    /// The ray that goes through to the other side.
    pub(crate) fn cross(&self, direction: Direction) -> Ray {
        self.other_side().leave(direction)
    }

    /// What it reflects diffusely; nothing where it is transparent.
    pub(crate) fn reflectance(&self, scene: &Scene) -> Rgb {
        let finish = scene.material(self.triangle).finish(self.back);
        finish.map_or(Rgb::BLACK, |finish| {
            scene.diffuse_reflectance(finish, self.triangle, self.u, self.v)
        })
    }

    /// The same place seen from the other side.
    pub(crate) fn other_side(&self) -> Self {
        Self { back: !self.back, geometric: -self.geometric, shading: -self.shading, ..*self }
    }
}
