//! What vertices stand for: the open, gaps, nothing.

use super::state::Pilot;
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::Gatherer;
use crate::engine::occlusion::{Side, barriers};
use crate::map::Standing;
use crate::units::Rgb;

/// Error of an element that is read as it is inside, as a share of what light falls by to its rim: root mean square of what falls evenly.
const ERROR_OF_FALL: f64 = 0.4;

impl Pilot<'_> {
    /// Photometric values of the vertices in the open.
    pub(super) fn in_the_open(&self, values: &[Rgb]) -> Vec<Option<f64>> {
        let is_open = |k: usize| self.near.standings[k] == Some(Standing::Open);
        (0..self.near.standings.len()).map(|k| is_open(k).then(|| values[k].luminance())).collect()
    }

    /// What an element errs by in a gap that is brighter inside than at the rim, as over a lamp that hangs close below a ceiling, and than
    /// most of the scene, lx: all of it is read as it is inside. Nothing elsewhere: light that comes in at a rim does not reach far.
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

    /// Finds out what vertices stand for that are new, or whose elements are.
    pub(super) fn complete_standings(&mut self, gatherers: &[Gatherer]) {
        let mut before = std::mem::take(&mut self.near.standings);
        before.resize(gatherers.len(), None);
        let surface = |k: usize| gatherers[k].surface;
        self.near.standings =
            self.near.felt.standings(self.scene, &self.mesh.subdivision, &before, surface);
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

    /// Whether something stands on vertices that were not looked at yet; where nobody looked at elements, it may stand close to them.
    pub(super) fn look_for_torn(&mut self) {
        if without("footprints") {
            self.near.footprints.skip(&self.mesh.subdivision);
            return;
        }
        let is_beset =
            |node: u32| self.near.beset.get(node as usize).is_none_or(|&is_beset| is_beset);
        self.near.footprints.look(self.scene, &self.mesh.subdivision, is_beset);
    }

    /// Elements that reach into the dark behind what stands across them are read from the corners before it.
    fn set_shaded_apart(&mut self) {
        if self.indirect.lx.is_empty() {
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

    pub(super) fn extend_known(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        self.look_for_torn();
        let mut known = std::mem::take(&mut self.near.known);
        self.sight(elements, gatherers).extend_known(&self.direct.lx, &mut known);
        self.near.known = known;
    }
}
