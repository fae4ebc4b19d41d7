//! Indirect light of the stored (interpolated) map on elements for direct light.
//!
//! Close to objects on a surface, indirect light changes within its elements. Readers and rays gather there afresh,
//! but a viewer of the stored map shows the vertex values. If their error exceeds the accuracy goal of the
//! mesh, vertices made for direct light gather, too, over the known light. No ray of an increment reads these vertices;
//! they cost only their own rays.

use super::look::{PilotRequest, Survey};
use super::state::{Bare, Pilot};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::{Gatherer, Gathering};
use crate::engine::mesh::{Carriers, Details, LeafError};
use crate::map::Standing;
use crate::units::Rgb;
use std::time::Instant;

/// The usual accuracy goal of the mesh. Finer goals allow more vertices, in the same ratio.
pub(super) const USUAL_MESH_GOAL: f64 = 0.05;

/// The error of indirect light from which vertices gather for the stored map, as a share of the goal of that map.
const MUCH_ERROR_SHARE: f64 = 0.5;

/// The approximate share of the vertices for direct light at which increments gather.
const GATHERING_VERTEX_SHARE: f64 = 0.3;

impl Bare {
    /// The mean light of the ends of an edge; `coarse` is the light of the vertices before the first.
    fn between(&self, coarse: &[Rgb], ends: [u32; 2]) -> Rgb {
        let light = |end: usize| {
            end.checked_sub(self.first).map_or_else(|| coarse[end], |k| self.indirect[k])
        };
        (light(ends[0] as usize) + light(ends[1] as usize)) * 0.5
    }
}

impl Pilot<'_> {
    /// Whether vertices gather for the stored map, now or later. They do if its goal is finer than usual, and the
    /// error of indirect light is a large share of that goal.
    pub(super) fn gathers_for_bare(&self, look: &Survey, request: &PilotRequest) -> bool {
        if self.indirect.bare.is_some() {
            return true;
        }
        let is_asked_for = request.is_hybrid
            && request.mesh_target < USUAL_MESH_GOAL
            && !without("bare-map-vertices");
        if !is_asked_for {
            return false;
        }
        let beset = look.errors.iter().filter(|e| e.is_beset);
        let area_m2: f64 = look.errors.iter().map(|e| e.area_m2).sum();
        let squared: f64 = beset.map(|e| e.area_m2 * e.error * e.error).sum();
        let much_lx = MUCH_ERROR_SHARE * request.mesh_target * look.reference_lx;
        squared > much_lx * much_lx * area_m2
    }

    /// Prepares the gathering for the stored map, if vertices gather for it.
    pub(super) fn look_at_bare(&mut self, look: &Survey, request: &PilotRequest) {
        if self.gathers_for_bare(look, request) {
            let (first, indirect) = (self.mesh.subdivision.vertex_count(), Vec::new());
            let beset = look.errors.iter().filter(|e| e.is_beset).map(|e| e.node).collect();
            self.indirect.bare = Some(Bare { first, indirect, beset });
        }
    }

    /// Gathers at new open vertices of elements with an object close before them, and interpolates at the others.
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
        let operator = self.operator(&gathering, &rows, key);
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

    /// The error of the stored map by element, lx; `None` if no vertices gather for it. `direct` is the direct light
    /// at the vertices, lx.
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

    /// The number of vertices at which increments will gather for the stored map, with `more` new vertices for
    /// direct light.
    pub(super) fn rows_for_bare(&self, look: &Survey, request: &PilotRequest, more: f64) -> f64 {
        let made = self.indirect.bare.as_ref().map_or(0, |bare| bare.indirect.len());
        let gathers = self.gathers_for_bare(look, request);
        if gathers { GATHERING_VERTEX_SHARE * (made as f64 + more) } else { 0.0 }
    }

    /// The vertices at which increments are to gather for the stored map: those whose light differs from the
    /// interpolated light.
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
            // With half of this difference, the hall takes twice the vertices for a fiftieth of the error.
            let differs = (light.luminance() - between_lx).abs() > may_be_lx;
            let gathers = differs && standings[vertex] == Some(Standing::Open);
            light_lx.push(if gathers { light.luminance() } else { between_lx });
            if gathers {
                gathering.push(vertex as u32);
            }
        }
        gathering
    }
}
