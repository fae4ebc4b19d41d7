//! Places on surfaces, found from points in space.

use super::surface::SurfacePoint;
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::{Direction, Normal, Point, Ray, Vector};

/// Distance within which a point counts as on a surface, as a share of the scene's extent.
const REACH_SHARE: f64 = 1e-4;

/// Distance by which places on the rim of a triangle move inwards, in rounding steps of its coordinates. A
/// wall that meets the rim is nearer than this by the sine of its angle with the direction to the centroid.
/// The place stays more than one rounding step away from it for angles down to one degree.
pub(crate) const INWARD_ROUNDINGS: f64 = 64.0;

/// A place and the direction in which a luxmeter faces there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbePoint {
    /// Position, m.
    pub position: Point,
    /// Direction that the luxmeter faces.
    pub normal: Normal,
}

/// A search for surfaces of a scene by place.
pub(crate) struct Places<'a> {
    scene: &'a Scene,
    reach_m: f64,
}

impl<'a> Places<'a> {
    /// A search over one scene. Its reach follows from the extent of the scene.
    pub(crate) fn of(scene: &'a Scene) -> Self {
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        Self { scene, reach_m: REACH_SHARE * extent_m }
    }

    /// The surface at a point, among those that `carries` accepts. It lies straight below the point or, at
    /// the rim of a surface, just beside it.
    pub(crate) fn surface_at(
        &self,
        at: ProbePoint,
        carries: impl Fn(&SurfacePoint) -> bool,
    ) -> Option<SurfacePoint> {
        let (u, v) = at.normal.to_direction().frame();
        let side = 0.1 * self.reach_m;
        let beside = (0..8).map(|k| {
            let (s, c) = libm::sincos(f64::from(k) * std::f64::consts::FRAC_PI_4);
            u * (side * c) + v * (side * s)
        });
        std::iter::once(Vector::ZERO)
            .chain(beside)
            .filter_map(|shift| self.surface_below(at.position + shift, at.normal))
            .find(carries)
    }

    fn surface_below(&self, point: Point, normal: Normal) -> Option<SurfacePoint> {
        let down: Direction = -normal.to_direction();
        let ray = Ray::new(point + normal * self.reach_m, down).up_to(2.0 * self.reach_m as f32);
        let hit = self.scene.bvh().closest_hit(&ray)?;
        let surface = SurfacePoint::from_hit(self.scene, &hit);
        // Surfaces that face more than 60 degrees away are not the one asked for.
        (surface.geometric.dot(normal) > 0.5).then_some(surface)
    }

    /// A place on the rim of a triangle, moved inwards beyond the rounding of coordinates. It then does not
    /// lie in a wall that meets the rim. The rounding is that of the corners, which a wall may share; the
    /// place itself may have zero coordinates, whose rounding is zero. In a tiny triangle the place moves at
    /// most half the distance to the centroid.
    pub(crate) fn pulled_in(&self, at: SurfacePoint) -> SurfacePoint {
        let triangle = self.scene.triangle(at.triangle);
        let inwards = triangle.centroid() - at.point;
        let largest_m = self.scene.bvh().mesh().largest_coordinate_m(at.triangle);
        let rounding_m = f64::from(f32::EPSILON) * largest_m;
        let distance_m = (INWARD_ROUNDINGS * rounding_m).min(0.5 * inwards.length());
        let near_rim = at.u.min(at.v).min(1.0 - at.u - at.v) * inwards.length() < distance_m;
        match inwards.direction() {
            Some(direction) if near_rim => {
                SurfacePoint { point: at.point + direction * distance_m, ..at }
            }
            _ => at,
        }
    }
}

/// A key for random numbers that depends on the place alone, so that neighbouring places are independent.
pub(crate) fn place_key(point: Point) -> Key {
    let place = [point.x, point.y, point.z];
    place.iter().fold(Key::new(0).with(5), |key, c| key.with(c.to_bits()))
}
