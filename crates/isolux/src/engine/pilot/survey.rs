//! The survey of the light on the present elements, and of their interpolation errors.

use super::forecast::{FIRST_SURVEY_COST, GoOn};
use super::look::{PilotRequest, Survey};
use super::state::{HEM_EDGE_SHARE, Pilot};
use crate::ablation::without;
use crate::engine::judge::Light;
use crate::engine::mesh::WorstElements;
use std::time::Instant;

impl Pilot<'_> {
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
        if is_first {
            // All that follows takes about as long, even without rays: it visits the same vertices and elements.
            self.end = self.end.clone().ahead_by(self.started.elapsed());
        }
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
            self.direct.in_time = self.end.clone();
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
}
