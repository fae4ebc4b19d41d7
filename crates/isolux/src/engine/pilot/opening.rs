//! Refinement of elements with hidden vertices that light reaches.

use super::state::Pilot;
use crate::elements::Elements;
use crate::engine::gather::{CutOff, Element, Sight};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Sequence;
use isolux_geometry::Point;
use rayon::prelude::*;

/// The number of places tested for light in an element with hidden vertices: one per bit of
/// [`Unlit`](crate::engine::gather::Unlit).
const PLACES: u32 = 16;

impl Pilot<'_> {
    /// Bisects elements with hidden vertices if light reaches a place that sees none of the open ones, and elements
    /// with all vertices at the rim of a gap. Returns whether there are any.
    pub(super) fn open_up(&mut self, elements: &Elements, max_vertices: usize) -> bool {
        let gatherers = self.gatherers();
        let sight = self.sight(elements, &gatherers);
        let hidden: Vec<u32> =
            self.mesh.subdivision.leaves().filter(|&n| self.has_hidden(n)).collect();
        let asked: Vec<(u32, Option<u16>)> =
            hidden.into_par_iter().map(|node| (node, self.unlit_places(&sight, node))).collect();
        let rims: Vec<u32> =
            self.mesh.subdivision.leaves().filter(|&n| self.has_only_rim(n)).collect();
        let mut any = !rims.is_empty();
        for (node, unlit) in asked {
            if let Some(unlit) = unlit {
                self.near.unlit.0.insert(self.element(node), unlit);
                continue;
            }
            any = true;
            if self.mesh.subdivision.vertex_count() < max_vertices {
                self.mesh.subdivision.bisect_twice(node);
            }
        }
        for node in rims {
            if self.mesh.subdivision.vertex_count() < max_vertices {
                self.mesh.subdivision.bisect(node);
            }
        }
        any
    }

    /// The places of an element, as bits, that see no lit surface; `None` if light reaches a place that sees no open
    /// vertex.
    fn unlit_places(&self, sight: &Sight<'_>, node: u32) -> Option<u16> {
        let sequence = Sequence::new(self.key.with(4).with(u64::from(node)));
        let mut unlit = self.near.unlit.0.get(&self.element(node)).copied().unwrap_or(0);
        for k in 0..PLACES {
            let square = Dice::new(sequence, k).pair();
            let place = SurfacePoint::in_node(self.scene, &self.mesh.subdivision, node, square);
            let number = u64::from(node * PLACES + k);
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
