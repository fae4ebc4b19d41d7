//! The interpolation error of direct light.

use super::{Criterion, Marked, Rounds, Which};
use crate::engine::pilot::forecast::{FINE_EXCESS, GoOn};
use crate::engine::pilot::look::{PilotRequest, Survey};
use crate::engine::pilot::state::{MAX_ROUNDS, Pilot};

/// The ratio of the excess to that of the last round above which a round makes no progress. With a lamp close to
/// a ceiling, 5000 receivers so take the place of 50,000 (decision 40).
const STALLED_ERROR_RATIO: f64 = 0.98;

/// The criterion for direct light.
pub(crate) struct DirectError {
    max_vertices: usize,
    /// The excess one round ago.
    before: f64,
    rounds: Rounds,
}

impl DirectError {
    pub(crate) const fn new(max_vertices: usize) -> Self {
        Self { max_vertices, before: f64::INFINITY, rounds: Rounds::at_most(MAX_ROUNDS) }
    }
}

impl Criterion for DirectError {
    fn marked(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        _go_on: &mut GoOn<'_>,
    ) -> Option<Marked> {
        let (errors, excess) = pilot.direct_excess(&look.elements, request, look.reference_lx);
        pilot.direct.excess = Some((pilot.mesh.subdivision.vertex_count(), excess));
        // The largest errors may lie in elements that are already as small as allowed.
        let has_stalled = excess > STALLED_ERROR_RATIO * self.before;
        if !self.rounds.go_on(has_stalled) || excess <= 1.0 {
            return None;
        }
        self.before = excess;
        let which = Which::Worst { errors, wanted: 0.0, activates: false };
        Some(Marked { which, excess: Some(FINE_EXCESS), max_vertices: self.max_vertices })
    }

    fn follow(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        _request: &PilotRequest,
        _go_on: &mut GoOn<'_>,
    ) {
        look.elements = pilot.mesh.subdivision.elements();
        pilot.direct.added = look.elements.vertices().len() - pilot.direct.lx.len();
        pilot.complete_rays();
        let gatherers = pilot.gatherers();
        pilot.complete_direct(&look.elements, &gatherers);
        pilot.extend_known(&look.elements, &gatherers);
        pilot.complete_standings(&gatherers);
        pilot.complete_bare(&look.elements, &gatherers);
    }
}
