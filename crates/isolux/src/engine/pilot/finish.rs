//! The end of the pilot: assembly of the plan that all increments share.

use super::criteria::{CausticErrors, Caustics, DirectError};
use super::forecast::{FINE_EXCESS, GoOn};
use super::look::{PilotRequest, Survey};
use super::state::Pilot;
use crate::ablation::without;
use crate::elements::{Elements, Subdivision};
use crate::engine::gather::{Gatherer, RayTrial, areas_m2};
use crate::engine::mesh::Fit;
use crate::engine::occlusion::{Barriers, Side};
use crate::engine::plan::{
    PilotResult, Plan, PlannedErrors, PlannedLight, PlannedMesh, PlannedNoise,
};
use crate::map::Standing;
use std::sync::Arc;

impl<'s> Pilot<'s> {
    /// Refines further for caustics and direct light, and assembles the plan.
    pub(super) fn finish(
        mut self,
        mut look: Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Plan<'s> {
        let caustics = self.refine_for_caustics(&mut look, request, go_on);
        let indirect_vertices = self.mesh.subdivision.vertex_count();
        let coarse = self.fix_for_indirect_light();
        self.look_at_walls_again(&look.elements, request.target);
        let mut gatherers = self.measure_direct_light(&mut look, request, go_on);
        self.stand_before_walls(&mut gatherers[..indirect_vertices]);
        let standings = self.final_standings(&look.elements, indirect_vertices);
        let open: Vec<bool> = standings.iter().map(|of| *of == Some(Standing::Open)).collect();
        let cuts = self.cuts(&coarse, &look.elements);
        let gathering_for_bare = self.gathering_for_bare(&look, request, &standings);
        let caustics_share = caustics.share(look.reference_lx);
        let fit = self.fit(&coarse, &open, &cuts);
        let errors = PlannedErrors {
            trusts: look.trusts(request),
            interpolation: libm::hypot(look.interpolation(request), caustics_share),
            caustics_lx: caustics.lx,
            parts: caustics.parts(&coarse),
            caustics_beside_lx2: caustics.beside_lx2,
            of_elements: Vec::new(),
        };
        let mesh = PlannedMesh {
            indirect_vertices,
            level: coarse.node_count() as u32,
            waiting: self.mesh.carriers.waiting(),
            carriers: std::mem::take(&mut self.mesh.carriers),
            gatherers,
            gathering_for_bare,
            fit,
            standings,
            cuts,
            elements: look.elements,
            subdivision: coarse,
        };
        let errors = PlannedErrors { of_elements: look.errors, ..errors };
        self.plan(mesh, errors, look.reference_lx, request)
    }

    /// Refines elements for caustics, if there are any, and returns the errors that are left.
    fn refine_for_caustics(
        &mut self,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> CausticErrors {
        let Some(mut caustics) = Caustics::new(self, look, request) else {
            return CausticErrors::default();
        };
        self.refine(&mut caustics, look, request, go_on);
        caustics.into_errors()
    }

    /// The plan over a mesh, with the known light and noise.
    fn plan(
        self,
        mesh: PlannedMesh,
        errors: PlannedErrors,
        reference_lx: f64,
        request: &PilotRequest,
    ) -> Plan<'s> {
        let light = PlannedLight {
            direct: self.direct.lx,
            direct_variance: self.direct.variance,
            guess: self.indirect.lx,
            bright: self.bright,
            backdrop: self.walls.backdrop,
            reference_lx,
            mean_reflectance: self.mesh.reflectances.of_all(self.scene, &mesh.subdivision),
        };
        let tried = PlannedNoise {
            trial: self.tried.trial.unwrap_or(RayTrial::usual(reference_lx)),
            caustic_noise: self.tried.caustic_noise,
            aim: self.tried.aim,
        };
        let result = PilotResult {
            mesh: Arc::new(mesh),
            light: Arc::new(light),
            errors: Arc::new(errors),
            tried: Arc::new(tried),
            unlit: Arc::new(self.near.unlit),
            is_whole: self.is_whole && !self.end.has_passed(),
            is_finest: self.mesh.is_full
                && self.direct.excess.is_some_and(|(_, excess)| excess > 1.0),
            rays: self.traced,
        };
        Plan { scene: self.scene, lighting: self.lighting, result, end: request.end.clone() }
    }

    /// Fixes the elements for indirect light and returns them.
    fn fix_for_indirect_light(&mut self) -> Subdivision {
        let areas_m2 = areas_m2(&self.mesh.subdivision, &self.mesh.carriers);
        self.mesh.for_indirect_light = Some((self.mesh.subdivision.vertex_count(), areas_m2));
        self.mesh.subdivision.clone()
    }

    /// The final standings of the vertices. Those from number `first` on, for direct light alone, have none if both
    /// ends of their edge are hidden.
    fn final_standings(&mut self, elements: &Elements, first: usize) -> Vec<Option<Standing>> {
        let mut standings = std::mem::take(&mut self.near.standings);
        forget_orphans(elements, first, &mut standings);
        standings
    }

    /// Refines elements for direct light, measures that light and returns the receivers. If time is short, receivers
    /// that have moved keep the light of their earlier places.
    fn measure_direct_light(
        &mut self,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Vec<Gatherer> {
        if !without("direct-refinement") {
            self.look_at_bare(look, request);
            let max_vertices = self.most_for_direct_light(request);
            self.refine(&mut DirectError::new(max_vertices), look, request, go_on);
        }
        // Readers use the finer elements for direct light.
        for error in look.errors.iter_mut().filter(|e| e.is_beset) {
            error.is_beset_afar |= self.mesh.subdivision.node(error.node).0.split.is_some();
        }
        let gatherers = self.gatherers();
        if self.has_time(look, request, FINE_EXCESS, go_on) {
            self.measure_moved(&look.elements, &gatherers);
        }
        // Increments measure direct light again, unless it is measured once.
        let is_told = self.direct.is_hurried && self.lighting.is_measured_once();
        if self.direct.noise_lx.is_none() && !is_told {
            self.direct.variance.fill(0.0);
        }
        self.direct.is_measured = true;
        if !self.end.has_passed() {
            go_on(&self.round(request, Some(look), FINE_EXCESS));
        }
        self.complete_standings(&gatherers);
        gatherers
    }

    /// The elements with an object across them.
    fn cuts(&self, coarse: &Subdivision, elements: &Elements) -> Barriers {
        let nodes = coarse.leaves().map(|node| Side::of(coarse, node));
        let (first, light) = (coarse.vertex_count(), &self.indirect.lx);
        Barriers::of(self.scene, elements, (nodes, light), (first, &self.end))
    }

    fn fit(&self, coarse: &Subdivision, open: &[bool], cuts: &Barriers) -> Fit {
        let tells =
            |corners: [u32; 3]| corners.iter().all(|&v| open[v as usize]) && !cuts.has(corners);
        Fit::new(&coarse.elements(), coarse.vertex_count(), tells, &self.mesh.carriers)
    }
}

/// Removes the standing of vertices for direct light if both ends of their edge are hidden. Their indirect light
/// would be interpolated from these ends.
fn forget_orphans(elements: &Elements, first: usize, standings: &mut [Option<Standing>]) {
    for (k, vertex) in elements.vertices().iter().enumerate().skip(first) {
        let ends = vertex.parents.unwrap_or([k as u32; 2]);
        if ends.iter().all(|&end| standings[end as usize].is_none()) {
            standings[k] = None;
        }
    }
}
