//! Places that are asked for, and the surfaces that they lie on.

use super::surface::SurfacePoint;
use crate::sampling::Key;
use crate::scene::Scene;
use isolux_geometry::{Direction, Normal, Point, Ray, Vector};

/// A point counts as on a surface within this share of the scene's extent.
const REACH_SHARE: f64 = 1e-4;

/// Roundings of coordinates that places on the rim of a triangle are moved inwards by. The nearest wall is nearer than that by
/// the sine of the angle between it and the way to the middle: by more than one rounding down to a degree.
pub(crate) const INWARDS: f64 = 64.0;

/// A place and the way a luxmeter faces there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbePoint {
    /// Where, m.
    pub position: Point,
    /// Where it faces.
    pub normal: Normal,
}

/// The surfaces of a scene, by place.
pub(crate) struct Places<'a> {
    scene: &'a Scene,
    reach_m: f64,
}

impl<'a> Places<'a> {
    /// Those of a scene.
    pub(crate) fn of(scene: &'a Scene) -> Self {
        let bounds = scene.bvh().mesh().bounds();
        let extent_m = bounds.map_or(1.0, |(low, high)| (high - low).length());
        Self { scene, reach_m: REACH_SHARE * extent_m }
    }

    /// The surface of those that `carries` accepts at a point: straight below it, or, at the rim of a
    /// surface, just beside.
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
        // Sixty degrees: a surface that faces quite another way is not the one asked for.
        (surface.geometric.dot(normal) > 0.5).then_some(surface)
    }

    /// A place on the rim of a triangle, moved inwards beyond the rounding of coordinates, so that
    /// it does not lie in the wall that meets it there. Rounding is that of the corners, which a wall may share: that of the place
    /// is nothing where its coordinates are zero. Of a triangle that is hardly larger than that, half the way to its middle is left.
    pub(crate) fn pulled_in(&self, at: SurfacePoint) -> SurfacePoint {
        let triangle = self.scene.triangle(at.triangle);
        let inwards = triangle.centroid() - at.point;
        let largest_m = self.scene.bvh().mesh().largest_coordinate_m(at.triangle);
        let rounding_m = f64::from(f32::EPSILON) * largest_m;
        let distance_m = (INWARDS * rounding_m).min(0.5 * inwards.length());
        let near_rim = at.u.min(at.v).min(1.0 - at.u - at.v) * inwards.length() < distance_m;
        match inwards.direction() {
            Some(direction) if near_rim => {
                SurfacePoint { point: at.point + direction * distance_m, ..at }
            }
            _ => at,
        }
    }
}

/// Random numbers belong to the place, so that neighbours are independent.
pub(crate) fn place_key(point: Point) -> Key {
    let place = [point.x, point.y, point.z];
    place.iter().fold(Key::new(0).with(5), |key, c| key.with(c.to_bits()))
}
