//! Elements with hidden vertices that light reaches.

use super::{Criterion, Marked, Rounds, Which};
use crate::engine::gather::{CutOff, Element, Sight};
use crate::engine::pilot::forecast::GoOn;
use crate::engine::pilot::look::{PilotRequest, Survey};
use crate::engine::pilot::state::Pilot;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Sequence;
use isolux_geometry::Point;
use rayon::prelude::*;

/// The number of places tested for light in an element with hidden vertices: one per bit of
/// [`Unlit`](crate::engine::gather::Unlit). Four places miss strips of open floor beside walls and cupboards
/// (decision 41).
const TESTED_PLACES: u32 = 16;

/// The largest number of rounds.
const MOST_ROUNDS: usize = 4;

/// The criterion for elements with hidden vertices.
pub(crate) struct Hidden {
    max_vertices: usize,
    rounds: Rounds,
}

impl Hidden {
    pub(crate) const fn new(max_vertices: usize) -> Self {
        Self { max_vertices, rounds: Rounds::at_most(MOST_ROUNDS) }
    }
}

impl Criterion for Hidden {
    /// Marks elements with hidden vertices if light reaches a place that sees none of the open ones, and elements with
    /// all vertices at the rim of a gap.
    fn marked(
        &mut self,
        pilot: &mut Pilot<'_>,
        look: &mut Survey,
        request: &PilotRequest,
        _go_on: &mut GoOn<'_>,
    ) -> Option<Marked> {
        if !self.rounds.go_on(false) {
            return None;
        }
        let gatherers = pilot.gatherers();
        let sight = pilot.sight(&look.elements, &gatherers);
        let leaves = || pilot.mesh.subdivision.leaves();
        let hidden: Vec<u32> = leaves().filter(|&n| pilot.has_hidden(n)).collect();
        let asked: Vec<(u32, Option<u16>)> =
            hidden.into_par_iter().map(|node| (node, pilot.unlit_places(&sight, node))).collect();
        let once: Vec<u32> = leaves().filter(|&n| pilot.has_only_rim(n)).collect();
        let mut twice = Vec::new();
        for (node, unlit) in asked {
            match unlit {
                Some(unlit) => _ = pilot.near.unlit.0.insert(pilot.element(node), unlit),
                None => twice.push(node),
            }
        }
        let excess = (Some(look.greatest_excess(request)), None);
        let any = !once.is_empty() || !twice.is_empty();
        let which = Which::Nodes { once, twice };
        any.then_some(Marked { which, excess: Some(excess), max_vertices: self.max_vertices })
    }
}

impl Pilot<'_> {
    /// The places of an element, as bits, that are known to see no lit surface; `None` if light reaches a place that sees no open
    /// vertex.
    fn unlit_places(&self, sight: &Sight<'_>, node: u32) -> Option<u16> {
        let sequence = Sequence::new(self.key.with(4).with(u64::from(node)));
        let mut unlit = self.near.unlit.0.get(&self.element(node)).copied().unwrap_or(0);
        for k in 0..TESTED_PLACES {
            if self.end.has_passed() {
                break;
            }
            let square = Dice::new(sequence, k).pair();
            let place = SurfacePoint::in_node(self.scene, &self.mesh.subdivision, node, square);
            let number = u64::from(node * TESTED_PLACES + k);
            match sight.cut_off((&place, number), &self.near.known, unlit >> k & 1 == 1) {
                CutOff::Yes => return None,
                CutOff::No => {}
                CutOff::Unlit => unlit |= 1 << k,
            }
        }
        Some(unlit)
    }

    fn element(&self, node: u32) -> Element {
        let bits = |p: Point| [p.x, p.y, p.z].map(f64::to_bits);
        (node, self.mesh.subdivision.triangle(node).corners.map(bits))
    }

    /// Whether an element can be bisected and has all vertices at the rim of a gap. Light from the rim does not reach
    /// far into it.
    fn has_only_rim(&self, node: u32) -> bool {
        let corners = self.mesh.subdivision.node(node).0.vertices;
        self.mesh.subdivision.longest_edge_m(node) > 2.0 * self.mesh.least_edge_m
            && corners.iter().all(|&v| self.near.standings[v as usize] == Some(Standing::Rim))
    }

    /// Whether an element can be bisected and has a hidden vertex.
    fn has_hidden(&self, node: u32) -> bool {
        let corners = self.mesh.subdivision.node(node).0.vertices;
        self.mesh.subdivision.longest_edge_m(node) > 2.0 * self.mesh.least_edge_m
            && corners.iter().any(|&v| !self.near.known[v as usize])
    }
}
