//! The loop of adaptive refinement: light on the present elements, their interpolation errors, bisection of the
//! worst.

use super::forecast::{GoOn, LONGER};
use super::look::{PilotRequest, ReadFor, Survey};
use super::state::{HEM, LEAST_ORDER, MAX_ROUNDS, MOST_STALLS, Pilot};
use crate::ablation::without;
use crate::engine::judge::Light;
use crate::engine::mesh::{Refinement, WorstElements, refine_worst};
use std::time::Instant;

/// The largest number of rounds in which the error may rise.
const MOST_RISEN: usize = 3;
/// The largest number of vertices for indirect light, unless the first mesh has nearly as many.
const MOST_FOR_INDIRECT_LIGHT: usize = 40_000;
/// The share of the largest number of vertices above which the mesh counts as full. The worst elements are
/// bisected in groups.
const FULL: f64 = 0.95;
/// The largest number of rounds that bisect elements with hidden vertices.
const ROUNDS_FOR_HIDDEN: usize = 4;

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
        let most = request.most_for_indirect_light.unwrap_or(MOST_FOR_INDIRECT_LIGHT);
        let most = most.max(look.elements.vertices().len() / 2 * 3);
        let most = request.max_vertices.min(most);
        self.mesh.most_for_indirect_light = most as f64;
        self.try_some(&look, request.target);
        let excess = |look: &Survey| (Some(look.greatest_excess(request)), None);
        let mut has_time = self.has_time(&look, request, excess(&look), go_on);
        for _ in 0..ROUNDS_FOR_HIDDEN {
            if !(has_time && self.open_up(&look.elements, most)) {
                break;
            }
            look = self.look(request, go_on);
            has_time = self.has_time(&look, request, excess(&look), go_on);
        }
        // Readers gather over gathered maps alone: maps of particles are blurred nearby.
        let reads = if request.is_fitted { &ReadFor::EVERY[..] } else { &[ReadFor::All] };
        for &what in reads {
            look = self.refine(look, request, (what, most), go_on);
        }
        self.mesh.is_full = look.elements.vertices().len() as f64 > FULL * most as f64;
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
            self.near.hemmed_in_m[vertex as usize] < HEM * edge_m && !without("hemmed-errors")
        };
        let mut errors = details.leaf_errors(middle, beset, hemmed);
        let reference_lx = Light::of_vertices(&elements, &self.near.standings, lx).reference_lx();
        for error in &mut errors {
            error.error = error.error.max(self.error_in_lit_gap_lx(error.node, reference_lx));
        }
        let left_by_fit = details.left_by_fit(&errors);
        self.weigh(&mut errors);
        let carriers = self.mesh.carriers.count(gatherers.len());
        let longer = if is_first { LONGER } else { 1.0 };
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
        }
    }

    /// Bisects elements until they are good enough for these readers, or bisection makes no progress.
    pub(super) fn refine(
        &mut self,
        mut look: Survey,
        request: &PilotRequest,
        (what, max_vertices): (ReadFor, usize),
        go_on: &mut GoOn<'_>,
    ) -> Survey {
        let mut before = (f64::INFINITY, look.carriers as f64);
        let (mut risen, mut stalls) = (0, 0);
        for _ in 0..MAX_ROUNDS {
            let Some((errors, excess)) = look.excess(what, request) else { break };
            // Where bisection no longer helps, the rest is noise, which check points measure. While it finds light in
            // gaps, errors may rise.
            let carriers = look.carriers as f64;
            let has_risen = self.indirect.sees_lit_gaps && excess > before.0;
            risen += usize::from(has_risen);
            let is_excused = has_risen && risen <= MOST_RISEN;
            let fallen = libm::pow(before.1 / carriers, LEAST_ORDER);
            let stalled = !is_excused && excess > before.0 * fallen;
            let known = Some(before).filter(|(excess, _)| excess.is_finite());
            let excesses = (Some(look.greatest_excess(request)), known);
            stalls = if stalled { stalls + 1 } else { 0 };
            if stalls > MOST_STALLS || !self.has_time(&look, request, excesses, go_on) {
                break;
            }
            before = (excess, carriers);
            let least_edge_m = self.mesh.least_edge_m;
            let how_far = Refinement { wanted: 1.0 / excess, least_edge_m, max_vertices };
            if !refine_worst(&mut self.mesh.subdivision, &mut self.mesh.carriers, &errors, how_far)
            {
                break;
            }
            look = self.look(request, go_on);
        }
        look
    }
}
