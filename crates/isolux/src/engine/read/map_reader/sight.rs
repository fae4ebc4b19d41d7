//! Visibility between places of a surface.

use super::MapReader;
use crate::elements::PlaceOnSide;
use crate::engine::occlusion::{LOW, NEAR};
use crate::engine::ray::SurfacePoint;
use isolux_geometry::{Normal, Ray};

/// The height of test rays above a bent surface, as a share of their length at a bend of a right angle. A
/// ball rises over the line between two of its places by a quarter of that for a small bend, a crease by a
/// half.
const BENT: f64 = 0.5;

impl MapReader<'_> {
    /// Whether nothing separates the light of two near places of a surface: no obstacle stands between them,
    /// both close to the surface and well above it. Panes separate light, too.
    pub fn sees(&self, from: PlaceOnSide, to: PlaceOnSide) -> bool {
        let [from, to] =
            [from, to].map(|place| self.places.pulled_in(SurfacePoint::on_side(self.scene, place)));
        let length_m = (to.point - from.point).length();
        let [up, up_there] = [from, to].map(|at| Normal::to_vector(at.geometric));
        let over_m = BENT * length_m * up.cross(up_there).length();
        let is_blocked = |height_m: f64| {
            let height_m = height_m + over_m;
            let way = Ray::between(from.point + up * height_m, to.point + up_there * height_m);
            self.scene.bvh().closest_hit(&way.skipping(from.triangle)).is_some()
        };
        // The high ray is usually free, so the low one is rarely traced.
        !(is_blocked(NEAR * length_m) && is_blocked(LOW * from.away_m.max(to.away_m)))
    }
}
