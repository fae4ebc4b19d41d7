//! Objects close before elements and vertices.

use super::state::{HEM_EDGE_SHARE, Pilot};
use crate::engine::gather::Gatherer;
use crate::engine::occlusion::nearby;
use crate::engine::ray::SurfacePoint;
use rayon::prelude::*;

impl Pilot<'_> {
    /// Finds the new nodes with an object close before their middle.
    pub(super) fn complete_beset(&mut self) {
        let new = self.near.beset.len() as u32..self.mesh.subdivision.node_count() as u32;
        let is_beset = |node: u32| {
            if self.end.has_passed() {
                return false;
            }
            let place = SurfacePoint::amid_node(self.scene, &self.mesh.subdivision, node);
            nearby::is_beset(self.scene, &place, self.mesh.subdivision.longest_edge_m(node))
        };
        let new: Vec<bool> = new.into_par_iter().map(is_beset).collect();
        self.near.beset.extend(new);
    }

    /// Finds the distance to the nearest object before each new vertex. Vertices on borders are left out, since walls
    /// stand before them.
    pub(super) fn complete_hemmed(&mut self, gatherers: &[Gatherer]) {
        let on_border = self.mesh.subdivision.border_vertices();
        let edges_m = self.mesh.subdivision.longest_edges_m();
        let stands_in_m = |vertex: usize| {
            if on_border[vertex] || self.end.has_passed() {
                return f64::INFINITY;
            }
            nearby::hemmed_in_m(
                self.scene,
                &gatherers[vertex].surface,
                HEM_EDGE_SHARE * edges_m[vertex],
            )
        };
        let new: Vec<f64> = (self.near.hemmed_in_m.len()..gatherers.len())
            .into_par_iter()
            .map(stands_in_m)
            .collect();
        self.near.hemmed_in_m.extend(new);
    }

    /// Finds that distance for the new carriers that other vertices are interpolated from.
    pub(super) fn complete_beset_carriers(&mut self, gatherers: &[Gatherer]) {
        let is_new = |vertex: &u32| !self.near.beset_from_m.contains_key(vertex);
        let new: Vec<u32> = self.mesh.carriers.parents().into_iter().filter(is_new).collect();
        let beset_from_m = |&vertex: &u32| {
            if self.end.has_passed() {
                return (vertex, f64::INFINITY);
            }
            let place = &gatherers[vertex as usize].surface;
            (vertex, nearby::beset_from_m(self.scene, place, self.mesh.spacing_m))
        };
        let new: Vec<(u32, f64)> = new.par_iter().map(beset_from_m).collect();
        self.near.beset_from_m.extend(new);
    }
}
