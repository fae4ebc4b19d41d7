//! Places without light.

use super::effort::LOOKS;
use super::state::MapReader;
use crate::engine::gather::{Gatherer, sees};
use crate::engine::ray::{Dice, ProbePoint, SurfacePoint, follow, place_key};
use crate::map::{Illuminance, Standing};
use crate::sampling::{CosineHemisphere, Sequence};
use isolux_geometry::{Point, Ray};

/// The light of a place, as a share of that of its element, up to which the place counts as unlit. Rays read
/// some light through cracks.
const NO_LIGHT: f64 = 3e-3;
/// The number of estimates of direct light that test whether any luminaire shines on a place.
const LOOKS_AT_LUMINAIRES: u32 = 4;

impl MapReader<'_> {
    /// The map's value at a place; `None` where the map knows nothing or no light reaches the place, like the
    /// floor below a box that stands across an element. The vertices of that element lie beyond something or
    /// are unknown, and the place itself sees no light.
    pub(super) fn stored_at(&self, at: &SurfacePoint) -> Option<Illuminance> {
        let stored = self.map.interpolate(at.triangle, at.back, at.u, at.v)?;
        let bias_lx = self.part_at(at) * self.unseen.bias_lx;
        let is_known = !self.is_closed_off(at, stored.illuminance_lx());
        is_known.then_some(Illuminance { bias_lx, ..stored })
    }

    /// Whether no light reaches a place whose element has the light `light_lx`.
    fn is_closed_off(&self, at: &SurfacePoint, light_lx: f64) -> bool {
        let Some(corners) = self.map.elements.locate(at.triangle, at.back, at.u, at.v) else {
            return false;
        };
        let tells = |of: Standing| of != Standing::Rim;
        let is_told =
            |&(vertex, _): &(u32, f64)| self.standings[vertex as usize].is_some_and(tells);
        if corners.iter().all(is_told) {
            return false;
        }
        let at = self.places.pulled_in(*at);
        if self.sees_vertex(&at, tells) {
            return false;
        }
        let sequence = Sequence::new(place_key(at.point).with(16));
        let shines = |index| {
            let dice = &mut Dice::new(sequence, index);
            !self.lighting.estimate(&at, dice).is_black()
        };
        if (0..LOOKS_AT_LUMINAIRES).any(shines) {
            return false;
        }
        let gatherer = Gatherer::on_surface(at, LOOKS).in_gap(true);
        let key = place_key(at.point).with(17);
        let gathered = self.gather(gatherer, self.direct_at_ends(), (1, key));
        gathered.lx.luminance() <= NO_LIGHT * light_lx
    }

    /// Whether a place sees a vertex of its element with a known standing that `is_asked` accepts.
    pub(super) fn sees_vertex(
        &self,
        place: &SurfacePoint,
        is_asked: impl Fn(Standing) -> bool,
    ) -> bool {
        let corners = self.map.elements.locate(place.triangle, place.back, place.u, place.v);
        corners.into_iter().flatten().any(|(vertex, _)| {
            let at = self.map.elements.vertices()[vertex as usize];
            self.standings[vertex as usize].is_some_and(&is_asked)
                && sees(self.scene, place, at.position + at.normal.to_vector() * place.away_m)
        })
    }

    /// Whether a lit surface of the map is seen from a point, on a surface or not. A point in shadow sees lit
    /// surfaces; one outside the walls of a room sees none. Best effort: a few rays test it.
    pub fn sees_lit(&self, at: ProbePoint) -> bool {
        let on_surface = self.find_surface(at).map(|s| self.places.pulled_in(s));
        let from = on_surface.map_or_else(
            || Gatherer::in_space(self.scene, at.position, at.normal, LOOKS),
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
