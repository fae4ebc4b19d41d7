//! The loop of adaptive refinement: survey of the light on the present elements, and bisection of those that a
//! criterion marks.

use super::criteria::{Criterion, Hidden, IndirectError, Marked, Which};
use super::forecast::{FIRST_SURVEY_COST, GoOn};
use super::look::{PilotRequest, ReadFor, Survey};
use super::state::{HEM_EDGE_SHARE, Mesh, Pilot};
use crate::ablation::without;
use crate::engine::judge::Light;
use crate::engine::mesh::{Carriers, Refinement, WorstElements, refine_worst};
use std::time::Instant;

/// The largest number of vertices for indirect light, unless the first mesh has nearly as many.
const MOST_INDIRECT_VERTICES: usize = 40_000;
/// The share of the largest number of vertices above which the mesh counts as full. The worst elements are
/// bisected in groups.
const FULL_MESH_SHARE: f64 = 0.95;

impl Pilot<'_> {
    /// Refines the elements until they are fine enough for indirect light, or as fine as time allows.
    pub(super) fn elements_for_indirect_light(
        &mut self,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> Survey {
        let mut look = self.look(request, go_on);
        if let Some(edge_m) = self.mesh.usual_edge_m.filter(|_| !look.is_smooth()) {
            self.mesh.subdivision.bisect_to(edge_m, request.max_vertices);
            look = self.look(request, go_on);
        }
        let most = request.most_for_indirect_light.unwrap_or(MOST_INDIRECT_VERTICES);
        let most = most.max(look.elements.vertices().len() / 2 * 3);
        let most = request.max_vertices.min(most);
        self.mesh.most_for_indirect_light = most as f64;
        self.try_some(&look, request.target);
        let excess = (Some(look.greatest_excess(request)), None);
        if self.has_time(&look, request, excess, go_on) {
            self.refine(&mut Hidden { max_vertices: most }, &mut look, request, go_on);
        }
        // Readers gather over gathered maps alone: maps of particles are blurred nearby.
        let reads = if request.is_fitted { &ReadFor::EVERY[..] } else { &[ReadFor::All] };
        for &what in reads {
            self.refine(&mut IndirectError::of(what, most), &mut look, request, go_on);
        }
        self.mesh.is_full = look.elements.vertices().len() as f64 > FULL_MESH_SHARE * most as f64;
        look
    }

    /// Surveys the present mesh. The first call solves for the light; later calls gather at the new vertices over
    /// the known light.
    pub(super) fn look(&mut self, request: &PilotRequest, go_on: &mut GoOn<'_>) -> Survey {
        let mut elements = self.mesh.subdivision.elements();
        let is_first = self.indirect.lx.is_empty();
        self.complete_rays();
        let mut gatherers = self.gatherers();
        if is_first {
            self.begin(&elements, &gatherers, request, go_on);
        }
        let started = Instant::now();
        self.complete_beset();
        self.costs.looks.add(started.elapsed(), 0.0);
        self.complete_direct(&elements, &gatherers);
        if is_first && self.resolve_what_lands((&mut elements, &mut gatherers), request) {
            self.complete_beset();
        }
        self.complete_indirect(&elements, &gatherers, request, go_on);
        let started = Instant::now();
        let luminances = self.in_the_open(&self.indirect.lx);
        self.complete_hemmed(&gatherers);
        if !without("midpoints") {
            self.complete_middles(&elements, &luminances);
        }
        let lx = |k: usize| (self.direct.lx[k] + self.indirect.lx[k]).luminance();
        let middle = |node: u32| self.indirect.middles.get(&node).copied().flatten();
        let beset = |node: u32| self.near.beset[node as usize];
        let details = self.details(&elements, &luminances);
        let hemmed = |vertex: u32, edge_m: f64| {
            self.near.hemmed_in_m[vertex as usize] < HEM_EDGE_SHARE * edge_m
                && !without("hemmed-errors")
        };
        let mut errors = details.leaf_errors(middle, beset, hemmed);
        let reference_lx = Light::of_vertices(&elements, &self.near.standings, lx).reference_lx();
        for error in &mut errors {
            error.error = error.error.max(self.error_in_lit_gap_lx(error.node, reference_lx));
        }
        let left_by_fit = details.left_by_fit(&errors);
        self.weigh(&mut errors);
        let carriers = self.mesh.carriers.count(gatherers.len());
        let longer = if is_first { FIRST_SURVEY_COST } else { 1.0 };
        self.costs.looks.add(started.elapsed().div_f64(longer), gatherers.len() as f64);
        if is_first {
            self.costs.first.add(started.elapsed(), 0.0);
        }
        let worst = WorstElements::of(&errors);
        Survey {
            carriers,
            elements,
            errors,
            worst,
            left_by_fit,
            reference_lx,
            dim_m2: self.indirect.surroundings.dim_m2,
            reflected_again: self.reflected_again(),
        }
    }

    /// The loop of refinement: bisects the elements that a criterion marks until it marks none, or as far as time
    /// allows.
    pub(super) fn refine(
        &mut self,
        criterion: &mut dyn Criterion,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        for _ in 0..criterion.most_rounds() {
            let Some(marked) = criterion.marked(self, look, request, go_on) else { break };
            let has_time =
                marked.excess.is_none_or(|excess| self.has_time(look, request, excess, go_on));
            if !has_time || !self.bisect(marked) {
                break;
            }
            criterion.follow(self, look, request, go_on);
        }
        criterion.end(self, look, request);
    }

    /// Bisects marked elements. Returns whether there was anything to bisect.
    fn bisect(&mut self, marked: Marked) -> bool {
        let Marked { which, max_vertices, .. } = marked;
        let Mesh { subdivision, carriers, least_edge_m, .. } = &mut self.mesh;
        match which {
            Which::Worst { errors, wanted, activates } => {
                let how_far = Refinement { wanted, least_edge_m: *least_edge_m, max_vertices };
                let mut all = Carriers::all();
                let carriers = if activates { carriers } else { &mut all };
                refine_worst(subdivision, carriers, &errors, how_far)
            }
            Which::Nodes { once, twice } => {
                let before = subdivision.vertex_count();
                let halvings = twice.into_iter().map(|node| (node, 2));
                for (node, halvings) in halvings.chain(once.into_iter().map(|node| (node, 1))) {
                    if subdivision.vertex_count() >= max_vertices {
                        break;
                    }
                    match halvings {
                        1 => subdivision.bisect(node),
                        _ => subdivision.bisect_twice(node),
                    }
                }
                subdivision.vertex_count() > before
            }
        }
    }
}
