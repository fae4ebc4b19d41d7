//! The control variate for the rays of a reader.

use super::state::MapReader;
use crate::elements::Element;
use crate::engine::gather::{
    ControlVariate, Gatherer, Gathering, RayTrial, control_variate, known_at, ray_trial,
};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::map::Standing;
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;

impl MapReader<'_> {
    /// The control variate, if it removes much of the noise of light gathered at places of the map. Finding
    /// it takes longer than gathering in gaps, so there is none for a map that is trusted everywhere else.
    pub(super) fn walls(&self) -> Option<ControlVariate> {
        self.map.provenance.fresh.filter(|fresh| !fresh.in_gaps_alone)?;
        let places = self.some_places();
        let mut backdrop = ControlVariate::seen_by(self.scene, ray_trial::stands(&places))?;
        if backdrop.see(self.scene, |at| self.light_at(at)) > control_variate::LEFT_OUT {
            return None;
        }
        let gathering =
            Gathering { backdrop: Some(&backdrop), ..self.gathering(self.direct_at_ends()) };
        let of = (self.unseen.reference_lx, Key::new(self.map.provenance.seed).with(13));
        let left = RayTrial::of_walls(&gathering, &places, &self.light, of).left;
        left.is_some_and(|left| left <= control_variate::WORTH).then_some(backdrop)
    }

    /// Some gatherers in the open, each with the area of its element, m2.
    fn some_places(&self) -> Vec<(Gatherer, f64)> {
        let all = self.map.elements.elements();
        let is_open = |v: u32| self.standings[v as usize] == Some(Standing::Open);
        let open: Vec<&Element> =
            all.iter().filter(|e| e.vertices.into_iter().all(is_open)).collect();
        let every = open.len().div_ceil(control_variate::SOME).max(1);
        open.iter().step_by(every).map(|element| self.amid(element)).collect()
    }

    /// All light at a place, as the map gives it.
    fn light_at(&self, at: &SurfacePoint) -> Option<Rgb> {
        let known = known_at(&self.map.elements, u32::MAX, &self.standings, at)?;
        let read = |values: &[Rgb]| -> Rgb {
            known.iter().map(|&(vertex, weight)| values[vertex as usize] * weight).sum()
        };
        let direct = self.at_ends.values.as_deref().map_or_else(
            || self.lighting.estimate(at, &mut Dice::new(Sequence::new(Key::new(0)), 0)),
            read,
        );
        Some(direct + read(&self.light))
    }
}
