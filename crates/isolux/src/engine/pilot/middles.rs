//! Light in the middle of elements without details.

use super::state::Pilot;
use crate::elements::{Elements, Subdivision};
use crate::engine::gather::Gatherer;
use crate::engine::occlusion::nearby;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::map::Standing;
use crate::sampling::Sequence;
use rayon::prelude::*;

/// Shadow rays per emitting surface in the test whether luminaires shine into a gap.
const SAMPLES_IN_GAPS: usize = 4;

impl Pilot<'_> {
    /// Gathers in the middle of new elements that have no details and an object close before them. Readers gather in
    /// gaps anyway, so middles there gather only if luminaires shine in, as above a lamp close below the ceiling.
    /// Light missing in such a gap is missing elsewhere, too.
    pub(super) fn complete_middles(&mut self, elements: &Elements, values: &[Option<f64>]) {
        let details = self.details(elements, values);
        let is_new = |&node: &u32| {
            !self.indirect.middles.contains_key(&node) && details.told_error(node).is_none()
        };
        let new: Vec<u32> = self.mesh.subdivision.leaves().filter(is_new).collect();
        let asking = |node: u32| {
            if !self.near.beset[node as usize] || self.end.has_passed() {
                return None;
            }
            let place = SurfacePoint::amid_node(self.scene, &self.mesh.subdivision, node);
            let edge_m = self.mesh.subdivision.longest_edge_m(node);
            let corner = self.mesh.subdivision.node(node).0.vertices[0];
            let gatherer = Gatherer::on_surface(place, self.mesh.rays[corner as usize]);
            let in_gap = nearby::is_closed_in(self.scene, &place, edge_m);
            let asks = !in_gap || self.is_lit_up(node, &place);
            asks.then_some((node, gatherer.in_gap(in_gap)))
        };
        let asked: Vec<Option<(u32, Gatherer)>> = new.par_iter().map(|&n| asking(n)).collect();
        self.indirect.middles.extend(new.into_iter().map(|node| (node, None)));
        let (nodes, rows): (Vec<u32>, Vec<Gatherer>) = asked.into_iter().flatten().unzip();
        let key = self.key.with(2);
        let gathering = self.gathering(elements, self.indirect.solved_nodes, &self.near.standings);
        let operator = self.operator(&gathering, &rows, key);
        let light = operator.apply(&self.indirect.lx);
        self.traced += operator.rays;
        let middles = light.iter().map(|e| e.luminance()).zip(&rows);
        // Nothing reads gaps that are too bright.
        let told = |(node, (lx, row)): (u32, (f64, &Gatherer))| {
            let darker =
                || values_read(&self.mesh.subdivision, node, values).all(|read| lx <= read);
            (node, (!row.in_gap || !darker()).then_some(lx))
        };
        let told: Vec<(u32, Option<f64>)> = nodes.into_iter().zip(middles).map(told).collect();
        self.indirect.sees_lit_gaps =
            told.iter().zip(&rows).any(|((_, lx), row)| row.in_gap && lx.is_some());
        self.indirect.middles.extend(told);
    }

    /// Whether a place gets more direct light than each open vertex of its element.
    fn is_lit_up(&self, node: u32, place: &SurfacePoint) -> bool {
        let corners = self.mesh.subdivision.node(node).0.vertices;
        let is_read = |v: &u32| self.near.standings[*v as usize] == Some(Standing::Open);
        let mut read = corners.into_iter().filter(is_read).peekable();
        if read.peek().is_none() {
            return false;
        }
        let mut dice = Dice::new(Sequence::new(self.key.with(11).with(u64::from(node))), 0);
        let direct = match self.lighting.are_countless() {
            // One sample of the sources that would give most.
            true => self.lighting.estimate(place, &mut dice),
            false => self.lighting.sampled(place, SAMPLES_IN_GAPS, &mut dice),
        };
        read.all(|v| self.direct.lx[v as usize].luminance() < direct.luminance())
    }
}

/// The known values at the vertices of an element.
fn values_read<'a>(
    subdivision: &Subdivision,
    node: u32,
    values: &'a [Option<f64>],
) -> impl Iterator<Item = f64> + 'a {
    subdivision.node(node).0.vertices.into_iter().filter_map(|v| values[v as usize])
}
