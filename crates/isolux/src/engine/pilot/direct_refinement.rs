//! Adaptive refinement for direct light.

use super::forecast::{FINE, GoOn};
use super::look::{PilotRequest, Survey};
use super::state::{MAX_ROUNDS, MOST_STALLS, Pilot};
use crate::ablation::without;
use crate::engine::mesh::{Carriers, Refinement, refine_worst};

/// The share of the error left after a round above which the round counts as without progress.
const STALLED: f64 = 0.98;

impl Pilot<'_> {
    /// Refines elements until the interpolation error of direct light meets its goal, or as far as time and limits allow.
    pub(super) fn refine_for_direct_light(
        &mut self,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        let how_far = Refinement {
            wanted: 0.0,
            least_edge_m: self.mesh.least_edge_m,
            max_vertices: self.most_for_direct_light(request),
        };
        if without("direct-refinement") {
            return;
        }
        self.look_at_bare(look, request);
        let (mut before, mut stalls) = (f64::INFINITY, 0);
        for _ in 0..MAX_ROUNDS {
            let (errors, excess) = self.direct_excess(&look.elements, request, look.reference_lx);
            self.direct.excess = Some((self.mesh.subdivision.vertex_count(), excess));
            // The largest errors may lie in elements that are already as small as allowed.
            stalls = if excess > STALLED * before { stalls + 1 } else { 0 };
            if excess <= 1.0 || stalls > MOST_STALLS || !self.has_time(look, request, FINE, go_on) {
                break;
            }
            before = excess;
            if !refine_worst(&mut self.mesh.subdivision, &mut Carriers::all(), &errors, how_far) {
                break;
            }
            look.elements = self.mesh.subdivision.elements();
            self.direct.added = look.elements.vertices().len() - self.direct.lx.len();
            self.complete_rays();
            let gatherers = self.gatherers();
            self.complete_direct(&look.elements, &gatherers);
            self.extend_known(&look.elements, &gatherers);
            self.complete_standings(&gatherers);
            self.complete_bare(&look.elements, &gatherers);
        }
    }
}
