//! The standings of vertices: open, in a gap, at a rim, or hidden.

use super::state::Pilot;
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::Gatherer;
use crate::engine::occlusion::{Side, barriers};
use crate::map::Standing;
use crate::units::Rgb;

/// The interpolation error of an element in a lit gap, as a share of the fall of light from the gap to its rim. The
/// value is the root mean square for a linear fall.
const ERROR_OF_FALL: f64 = 0.4;

impl Pilot<'_> {
    /// The photometric values of open vertices; `None` for all others.
    pub(super) fn in_the_open(&self, values: &[Rgb]) -> Vec<Option<f64>> {
        let is_open = |k: usize| self.near.standings[k] == Some(Standing::Open);
        (0..self.near.standings.len()).map(|k| is_open(k).then(|| values[k].luminance())).collect()
    }

    /// The interpolation error of an element in a lit gap, lx. A lit gap is brighter than its rim and than the
    /// reference illuminance, as above a lamp close below a ceiling. All of the element is read with the value inside.
    /// The error is zero elsewhere, since light that enters at a rim does not reach far.
    pub(super) fn error_in_lit_gap_lx(&self, node: u32, reference_lx: f64) -> f64 {
        let corners = self.mesh.subdivision.node(node).0.vertices;
        let of_standing = |standing: Standing| {
            let is_it = move |v: &u32| self.near.standings[*v as usize] == Some(standing);
            corners.into_iter().filter(is_it).map(|v| self.indirect.lx[v as usize].luminance())
        };
        if of_standing(Standing::Open).next().is_some() {
            return 0.0;
        }
        let inside_lx = of_standing(Standing::Gap).reduce(f64::min).filter(|&lx| lx > reference_lx);
        let at_rim_lx = of_standing(Standing::Rim).reduce(f64::min);
        let darker_lx = inside_lx.zip(at_rim_lx).map_or(0.0, |(inside, at_rim)| inside - at_rim);
        ERROR_OF_FALL * darker_lx.max(0.0)
    }

    /// Determines the standings of new vertices and of vertices whose elements have changed. A vertex that an object
    /// stands on counts as a rim, or as hidden if an element joins it to a hidden vertex.
    pub(super) fn complete_standings(&mut self, gatherers: &[Gatherer]) {
        let mut before = std::mem::take(&mut self.near.standings);
        before.resize(gatherers.len(), None);
        let surface = |k: usize| gatherers[k].surface;
        let of = (self.scene, &self.mesh.subdivision);
        self.near.standings = self.near.felt.standings(of, &before, surface, &self.end);
        let beside_hidden =
            self.near.footprints.beside(&self.mesh.subdivision, |vertex| !self.near.known[vertex]);
        for (k, standing) in self.near.standings.iter_mut().enumerate() {
            let own = standing.filter(|_| self.near.known[k]);
            let footprints = own.filter(|_| !beside_hidden.contains(&(k as u32)));
            *standing =
                if self.near.footprints.has(k) { footprints.and(Some(Standing::Rim)) } else { own };
        }
        self.set_shaded_apart();
    }

    /// Tests new vertices for objects that stand on them. Elements that were not tested for close objects count as
    /// having some.
    pub(super) fn look_for_torn(&mut self) {
        if without("footprints") {
            self.near.footprints.skip(&self.mesh.subdivision);
            return;
        }
        let is_beset =
            |node: u32| self.near.beset.get(node as usize).is_none_or(|&is_beset| is_beset);
        let end = &self.end;
        self.near.footprints.look(self.scene, &self.mesh.subdivision, is_beset, end);
    }

    /// Sets dark vertices close behind an object across their elements to the standing of a rim. Their elements are
    /// then read from the lit corners before the object.
    fn set_shaded_apart(&mut self) {
        if self.indirect.lx.is_empty() || self.end.has_passed() {
            return;
        }
        let light_lx = |v: u32| {
            let k = v as usize;
            let indirect = self.indirect.lx.get(k).copied().unwrap_or(Rgb::BLACK);
            self.near.standings[k].map(|_| (self.direct.lx[k] + indirect).luminance())
        };
        let is_beside = |node: &u32| self.near.beset.get(*node as usize).is_none_or(|&beset| beset);
        let leaves = self.mesh.subdivision.leaves().filter(is_beside);
        let sides: Vec<Side> = leaves.map(|node| Side::of(&self.mesh.subdivision, node)).collect();
        for vertex in barriers::shaded(self.scene, &self.mesh.subdivision, &sides, light_lx) {
            self.near.standings[vertex as usize] = Some(Standing::Rim);
        }
    }

    /// Determines whether light can reach the new vertices.
    pub(super) fn extend_known(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        self.look_for_torn();
        let mut known = std::mem::take(&mut self.near.known);
        self.sight(elements, gatherers).extend_known(&self.direct.lx, &mut known);
        self.near.known = known;
    }
}
