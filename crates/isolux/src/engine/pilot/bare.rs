//! Indirect light of the bare map, where there are as many elements for it as there may be.
//!
//! Close to what stands on a surface indirect light changes over less than the elements that it lives on. Readers and rays gather
//! there afresh; a viewer of the bare map shows what the vertices say. Where that is worse than asked for, vertices that are made
//! for direct light gather, too, over the light that is known already. No ray of an increment reads them: they cost rays of their
//! own, and no more.

use super::look::{PilotRequest, Survey};
use super::state::{Bare, Pilot};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::{Gatherer, Gathering};
use crate::engine::mesh::{Carriers, Details, LeafError};
use crate::map::Standing;
use crate::units::Rgb;
use std::time::Instant;

/// For an accuracy of the mesh that is finer than this, more by as much.
pub(super) const USUAL_MESH: f64 = 0.05;

/// It is worth it where indirect light takes this part of what the bare map may err by.
const MUCH: f64 = 0.5;

/// By how much light at a vertex must differ from what is interpolated there for increments to gather at it, in accuracies of the
/// mesh: half as much takes twice the vertices in the hall, for a fiftieth of the error.
const WORTH: f64 = 1.0;

/// The part of the vertices for direct light for which that is so, roughly.
const OF_MADE: f64 = 0.3;

impl Bare {
    /// What lies between the ends of an edge; `coarse` is the light of the vertices before the first.
    fn between(&self, coarse: &[Rgb], ends: [u32; 2]) -> Rgb {
        let light = |end: usize| {
            end.checked_sub(self.first).map_or_else(|| coarse[end], |k| self.indirect[k])
        };
        (light(ends[0] as usize) + light(ends[1] as usize)) * 0.5
    }
}

impl Pilot<'_> {
    /// Whether vertices gather for it, or will: if a finer bare map than usual is asked for, and indirect light has much of what it may
    /// err by.
    pub(super) fn gathers_for_bare(&self, look: &Survey, request: &PilotRequest) -> bool {
        if self.indirect.bare.is_some() {
            return true;
        }
        let is_asked_for =
            request.has_means && request.mesh_target < USUAL_MESH && !without("bare-map-vertices");
        if !is_asked_for || self.indirect.is_smoothed {
            return false;
        }
        let beset = look.errors.iter().filter(|e| e.is_beset);
        let area_m2: f64 = look.errors.iter().map(|e| e.area_m2).sum();
        let squared: f64 = beset.map(|e| e.area_m2 * e.error * e.error).sum();
        let much_lx = MUCH * request.mesh_target * look.reference_lx;
        squared > much_lx * much_lx * area_m2
    }

    /// Begins with that, if they do.
    pub(super) fn look_at_bare(&mut self, look: &Survey, request: &PilotRequest) {
        if self.gathers_for_bare(look, request) {
            let (first, indirect) = (self.mesh.subdivision.vertex_count(), Vec::new());
            let beset = look.errors.iter().filter(|e| e.is_beset).map(|e| e.node).collect();
            self.indirect.bare = Some(Bare { first, indirect, beset });
        }
    }

    /// Gathers at the vertices that have not, as far as they lie in the open and something stands close.
    pub(super) fn complete_bare(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let Some(mut bare) = self.indirect.bare.take() else { return };
        let started = Instant::now();
        let mut is_beset = vec![false; gatherers.len()];
        let mut mark =
            |corners: [u32; 3]| corners.into_iter().for_each(|v| is_beset[v as usize] = true);
        bare.beset.iter().for_each(|&node| elements.visit_below(node, &mut mark));
        let row = |k: usize| {
            let gathers = is_beset[k] && self.near.standings[k] == Some(Standing::Open);
            gatherers[k].with_rays(if gathers { self.mesh.rays[k] } else { 0 })
        };
        let new = bare.first + bare.indirect.len()..gatherers.len();
        let rows: Vec<Gatherer> = new.clone().map(row).collect();
        let gathering = self.gathering(elements, self.indirect.solved_nodes, &self.near.standings);
        let gathering = Gathering { regathers: true, ..gathering };
        let key = self.key.with(2);
        let operator = gathering.operator(&rows, |_| key);
        let gathered = operator.apply(&self.indirect.lx);
        for ((k, row), light) in new.zip(&rows).zip(gathered) {
            let ends = elements.vertices()[k].parents.expect("made by bisection");
            let between = || bare.between(&self.indirect.lx, ends);
            bare.indirect.push(if row.rays > 0 { light } else { between() });
        }
        self.traced += operator.rays;
        self.costs.in_shadows.add(started.elapsed(), 0.0);
        self.indirect.bare = Some(bare);
    }

    /// What the bare map errs by in every element, if vertices gather for it; `direct` is what luminaires give.
    pub(super) fn bare_errors(
        &self,
        elements: &Elements,
        direct: &[Option<f64>],
    ) -> Option<Vec<LeafError>> {
        let bare = self.indirect.bare.as_ref()?;
        let indirect = self.indirect.lx[..bare.first].iter().chain(&bare.indirect);
        let both =
            |(direct, indirect): (&Option<f64>, &Rgb)| Some((*direct)? + indirect.luminance());
        let light: Vec<Option<f64>> = direct.iter().zip(indirect).map(both).collect();
        let (carriers, no) = (Carriers::all(), |_, _| false);
        let details = Details::of(&self.mesh.subdivision, elements, &light, &carriers, no);
        Some(details.leaf_errors(|_| None, |_| false, |_, _| false))
    }

    /// How many vertices increments will gather at for the bare map, if so many more are made for direct light.
    pub(super) fn rows_for_bare(&self, look: &Survey, request: &PilotRequest, more: f64) -> f64 {
        let made = self.indirect.bare.as_ref().map_or(0, |bare| bare.indirect.len());
        let gathers = self.gathers_for_bare(look, request);
        if gathers { OF_MADE * (made as f64 + more) } else { 0.0 }
    }

    /// The vertices that increments are to gather at for the bare map: where light is not what is interpolated there.
    pub(super) fn gathering_for_bare(
        &self,
        look: &Survey,
        request: &PilotRequest,
        standings: &[Option<Standing>],
    ) -> Vec<u32> {
        let Some(bare) = &self.indirect.bare else { return Vec::new() };
        let (vertices, may_be_lx) =
            (look.elements.vertices(), request.mesh_target * look.reference_lx);
        let luminance = |light: &Rgb| light.luminance();
        let mut light_lx: Vec<f64> = self.indirect.lx[..bare.first].iter().map(luminance).collect();
        let mut gathering = Vec::new();
        for (k, light) in bare.indirect.iter().enumerate() {
            let vertex = bare.first + k;
            let ends = vertices[vertex].parents.expect("made by bisection");
            let between_lx = 0.5 * ends.map(|end| light_lx[end as usize]).iter().sum::<f64>();
            let differs = (light.luminance() - between_lx).abs() > WORTH * may_be_lx;
            let gathers = differs && standings[vertex] == Some(Standing::Open);
            light_lx.push(if gathers { light.luminance() } else { between_lx });
            if gathers {
                gathering.push(vertex as u32);
            }
        }
        gathering
    }
}
