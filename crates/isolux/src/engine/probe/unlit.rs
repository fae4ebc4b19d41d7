//! What places without light see.

use super::{LOOKS, MapReader};
use crate::engine::gather::Gatherer;
use crate::engine::path::{Dice, follow};
use crate::engine::place::{ProbePoint, place_key};
use crate::sampling::{CosineHemisphere, Sequence};
use isolux_geometry::{Point, Ray};

impl MapReader<'_> {
    /// Whether anything that is lit, as the map tells it, is seen from a point, on a surface or not: a point in shadow sees
    /// surfaces in light, one outside of the walls of a room sees none. Best effort: a few rays look.
    pub fn sees_lit(&self, at: ProbePoint) -> bool {
        let on_surface = self.find_surface(at).map(|s| self.places.pulled_in(s));
        let from = on_surface.map_or_else(
            || Gatherer::in_space(at.position, at.normal, LOOKS),
            |at| Gatherer::on_surface(at, LOOKS),
        );
        let sequence = Sequence::new(place_key(from.surface.point).with(15));
        let axis = from.normal.to_direction();
        (0..LOOKS).any(|index| {
            let mut dice = Dice::new(sequence, index);
            let direction = axis.from_local(CosineHemisphere::sample(dice.pair()));
            let ray = Ray::new(from.origin, direction);
            let ray = on_surface.map_or(ray, |at| ray.skipping(at.triangle));
            let mut is_lit = false;
            follow(self.scene, ray, direction, &mut dice, |met, _, _| {
                let told = self.map.interpolate(met.triangle, met.back, met.u, met.v);
                is_lit |= told.is_some_and(|told| told.illuminance_lx() > 0.0);
            });
            is_lit
        })
    }

    /// Whether a point lies beyond the bounds of all surfaces.
    pub fn is_beyond_bounds(&self, at: Point) -> bool {
        self.scene.bvh().mesh().bounds().is_none_or(|(low, high)| {
            let (from_low, to_high) = (at - low, high - at);
            let margins = [from_low, to_high].map(|off| off.x.min(off.y).min(off.z));
            margins[0].min(margins[1]) < 0.0
        })
    }
}
