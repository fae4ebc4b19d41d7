//! What carries a map.

use crate::elements::carries_map;
use crate::scene::Scene;

/// Area of all sides that carry the map, m2.
pub fn lit_area_m2(scene: &Scene) -> f64 {
    area_of_m2(scene, |_| true)
}

/// The same of some of them, m2.
pub(super) fn area_of_m2(scene: &Scene, is_one: impl Fn((u32, bool)) -> bool) -> f64 {
    let sides = lit_sides(scene).filter(|&side| is_one(side));
    sides.map(|(triangle, _)| scene.triangle(triangle).area()).sum()
}

pub(super) fn lit_sides(scene: &Scene) -> impl Iterator<Item = (u32, bool)> + '_ {
    (0..scene.triangle_count())
        .flat_map(|triangle| [(triangle, false), (triangle, true)])
        .filter(|&(triangle, back)| carries_map(scene, triangle, back))
}
