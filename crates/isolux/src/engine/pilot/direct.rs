//! Direct light, and elements for it.

use super::{MAX_ROUNDS, Pilot};
use crate::elements::Elements;
use crate::engine::carriers::Carriers;
use crate::engine::detail::{Details, LeafError, Refinement, refine_worst};
use crate::engine::direct::{Goal, Measured};
use crate::engine::forecast::{FINE, GoOn};
use crate::engine::gather::Gatherer;
use crate::engine::look::{Look, PilotRequest};
use crate::engine::shrink::beyond_noise;
use crate::engine::trust;
use crate::sampling::Sequence;
use rayon::prelude::*;
use std::time::Instant;

/// Vertices for direct light as interpolated, in multiples of those for indirect light, unless so
/// many are cheap anyway.
const MOST_FOR_DIRECT_LIGHT: usize = 2;
const ALWAYS_FOR_DIRECT_LIGHT: usize = 50_000;
/// The part of the mesh accuracy asked for that noise of direct light may take, where it is not exact.
const NOISE_OF_DIRECT_LIGHT: f64 = 0.25;
/// Vertices of one task: some take a hundred times as long as others.
const AT_ONCE: usize = 32;
/// The most of the noise of others that light may have at vertices of little area.
const MOST_RELIEF: f64 = 4.0;

/// How much noisier light may be at a vertex that stands for such a part of the mean area: combs of n teeth err like n^-0.7, so
/// that what allots them best grows like the area to the power 1 / 2.4 (see [`super::super::allot`]).
fn relief(area: f64) -> f64 {
    libm::pow(area.max(f64::MIN_POSITIVE), -0.7 / 2.4).clamp(1.0, MOST_RELIEF)
}

impl Pilot<'_> {
    /// Direct light at the vertices that have none yet, by the fewest rays.
    pub(super) fn complete_direct(&mut self, gatherers: &[Gatherer]) {
        let sequence = Sequence::new(self.key.with(1));
        let measured = |g: &Gatherer| self.lighting.measured(&g.surface, Goal::ANY, sequence);
        let started = Instant::now();
        let new: Vec<Measured> =
            gatherers[self.direct.len()..].par_iter().with_max_len(AT_ONCE).map(measured).collect();
        self.costs.direct.add(started.elapsed(), new.len() as f64);
        self.direct.extend(new.iter().map(|m| m.lx));
        self.direct_variance.extend(new.iter().map(|m| m.variance));
    }

    /// Direct light at all vertices for the increments: with noise of their own, where it has noise.
    pub(super) fn measure_direct(
        &mut self,
        gatherers: &[Gatherer],
        request: &PilotRequest,
        Look { elements, rms_lx, .. }: &Look,
    ) {
        self.direct.clear();
        self.direct_variance.clear();
        let lighting = self.lighting;
        if !(request.is_fitted && lighting.has_many() && lighting.is_measured_once()) {
            self.complete_direct(gatherers);
            self.direct_variance.fill(0.0);
            return;
        }
        let key = self.key.with(5);
        let vertices = elements.vertices();
        let mean_m2 = vertices.iter().map(|v| v.area_m2).sum::<f64>() / vertices.len() as f64;
        let goal_lx = NOISE_OF_DIRECT_LIGHT * request.mesh_target * rms_lx;
        let measured = |(k, g): (usize, &Gatherer)| {
            let goal = Goal::lux(goal_lx).relaxed(relief(vertices[k].area_m2 / mean_m2));
            lighting.measured(&g.surface, goal, Sequence::new(key.with(k as u64)))
        };
        let all: Vec<Measured> =
            gatherers.par_iter().with_max_len(AT_ONCE).enumerate().map(measured).collect();
        self.direct.extend(all.iter().map(|m| m.lx));
        self.direct_variance.extend(all.iter().map(|m| m.variance));
    }

    /// Photometric direct light at the known vertices, without details that may be noise.
    fn direct_signal(&self, elements: &Elements) -> Vec<Option<f64>> {
        let luminances = self.in_the_open(&self.direct);
        beyond_noise(elements, &luminances, &self.direct_variance)
    }

    /// Refines where direct light as interpolated errs, until it is as good as asked.
    pub(super) fn refine_for_direct_light(
        &mut self,
        look: &mut Look,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        let how_far = Refinement {
            wanted: 0.0,
            least_edge_m: self.least_edge_m,
            max_vertices: self.most_for_direct_light(request),
        };
        for _ in 0..MAX_ROUNDS {
            let (errors, excess) = self.direct_excess(&look.elements, request, look.rms_lx);
            if excess <= 1.0 || !self.has_time(look, request, FINE, go_on) {
                break;
            }
            if !refine_worst(&mut self.subdivision, &mut Carriers::all(), &errors, how_far) {
                break;
            }
            look.elements = self.subdivision.elements();
            self.complete_rays();
            let gatherers = self.gatherers();
            self.complete_direct(&gatherers);
            self.extend_known(&look.elements, &gatherers);
            self.complete_standings(&gatherers);
        }
    }

    /// Vertices for direct light. Best effort: sharp shadow borders would take elements without end, and of
    /// emitting surfaces refinement cannot tell noise from borders.
    pub(super) fn most_for_direct_light(&self, request: &PilotRequest) -> usize {
        let most = MOST_FOR_DIRECT_LIGHT * self.gathered.len();
        most.max(ALWAYS_FOR_DIRECT_LIGHT).min(request.max_vertices)
    }

    /// What interpolation of direct light errs by in every element, and by how much that exceeds what is
    /// asked for.
    pub(super) fn direct_excess(
        &self,
        elements: &Elements,
        request: &PilotRequest,
        rms_lx: f64,
    ) -> (Vec<LeafError>, f64) {
        let signal = self.direct_signal(elements);
        // All vertices have direct light of their own.
        let (carriers, no) = (Carriers::all(), |_, _| false);
        let details = Details::of(&self.subdivision, elements, &signal, &carriers, no);
        let errors = details.leaf_errors(|_| None, |_| false);
        let excess = trust::error_of(&errors, |_| true) / (request.mesh_target * rms_lx);
        (errors, excess)
    }
}
