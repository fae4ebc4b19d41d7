//! The loop of adaptive refinement: bisection of the elements that a criterion marks.

use super::criteria::{Criterion, Hidden, IndirectError, Marked, Which};
use super::forecast::GoOn;
use super::look::{PilotRequest, ReadFor, Survey};
use super::state::{Mesh, Pilot};
use crate::engine::mesh::{Carriers, Refinement, refine_worst};

/// The largest number of vertices for indirect light, or one and a half times those of the first survey, if more.
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
        let (mut look, most, has_time) = self.first_elements(request, go_on);
        if has_time {
            self.refine(&mut Hidden::new(most), &mut look, request, go_on);
        }
        self.refine_for_readers(most, &mut look, request, go_on);
        self.mesh.is_full = look.elements.vertices().len() as f64 > FULL_MESH_SHARE * most as f64;
        look
    }

    /// Surveys and refines for the predictions of the remaining time alone, as long as there is time. The search for
    /// light beside hidden vertices is left out: it takes longer than all else here and adds few elements.
    pub(super) fn foresee(&mut self, request: &PilotRequest, go_on: &mut GoOn<'_>) -> usize {
        self.rays_too_late = 0;
        let (mut look, most, has_time) = self.first_elements(request, go_on);
        if has_time {
            self.refine_for_readers(most, &mut look, request, go_on);
        }
        self.mesh.subdivision.vertex_count()
    }

    /// The survey of the first elements, the largest number of vertices for indirect light, and whether there is time
    /// for more.
    fn first_elements(
        &mut self,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) -> (Survey, usize, bool) {
        let mut look = self.look(request, go_on);
        if let Some(edge_m) = self.mesh.usual_edge_m.filter(|_| self.is_whole && !look.is_smooth())
        {
            self.mesh.subdivision.bisect_to(edge_m, self.mesh.most_first_vertices);
            look = self.look(request, go_on);
        }
        let most = request.most_for_indirect_light.unwrap_or(MOST_INDIRECT_VERTICES);
        let most = most.max(look.elements.vertices().len() / 2 * 3);
        let most = request.max_vertices.min(most);
        self.mesh.most_for_indirect_light = most as f64;
        self.try_some(&look, request.target);
        let excess = (Some(look.greatest_excess(request)), None);
        let has_time = self.has_time(&look, request, excess, go_on);
        (look, most, has_time)
    }

    /// Refines the elements for every kind of reading.
    fn refine_for_readers(
        &mut self,
        most: usize,
        look: &mut Survey,
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        // Readers gather over gathered maps alone: maps of particles are blurred nearby.
        let reads = if request.is_fitted { &ReadFor::EVERY[..] } else { &[ReadFor::All] };
        for &what in reads {
            self.refine(&mut IndirectError::of(what, most), look, request, go_on);
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
        while !self.end.has_passed() {
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
                    if subdivision.size() >= max_vertices {
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
