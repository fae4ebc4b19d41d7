//! Direct light at the vertices, and its interpolation errors.

use super::bare::USUAL_MESH_GOAL;
use super::look::PilotRequest;
use super::state::Pilot;
use super::surroundings::LEAST_DIM_AREA_SHARE;
use crate::elements::{Elements, Origin};
use crate::engine::gather::Gatherer;
use crate::engine::light::{Goal, Measured};
use crate::engine::mesh::{Carriers, Details, LeafError, trust};
use crate::sampling::Sequence;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;

/// The largest number of vertices for direct light, in multiples of those for indirect light.
const MOST_DIRECT_VERTICES_RATIO: f64 = 4.0;
/// The number of vertices for direct light that is always allowed, because it is cheap.
const FREE_DIRECT_VERTICES: usize = 50_000;
/// The allowed mean error of direct light that rays read, after all reflections, in accuracy goals.
const MEAN_ERROR_SHARE: f64 = 0.25;
/// The allowed mean error of direct light per triangle in dim rooms, weighted by the light there, in accuracy goals.
const ROOM_ERROR_SHARE: f64 = 0.5;
/// The coarsest accuracy goal for dim rooms. Surveys of coarse meshes find a fraction of the error.
const COARSEST_ROOM_GOAL: f64 = 0.01;
/// The number of vertices that the level of direct light is measured from.
const LEVEL_VERTICES: usize = 512;
/// The largest mean reflectance in estimates of reflected light.
pub(super) const MOST_MEAN_REFLECTANCE: f64 = 0.9;
/// The number of vertices per task; some take a hundred times as long as others.
const TASK_VERTICES: usize = 32;
/// The allowed noise at vertices made at shadow borders, in multiples of that at others. The interpolation error
/// falls like n^-0.5 with n vertices, that of combs as below. A given number of rays then gives the least error if
/// noise has two fifths of its square.
const SHADOW_NOISE_FACTOR: f64 = 2.5;
/// The largest factor on the allowed noise for borders and small areas together. With ten, there are blotches
/// below the desks of the hall (decision 55).
const MOST_NOISE_FACTOR: f64 = 6.0;
/// The largest factor on the allowed noise for vertices of small area.
const MOST_RELIEF_FACTOR: f64 = 4.0;

/// The factor on the allowed noise at a vertex, by its area as a share of the mean area. Combs of n teeth err like
/// n^-0.7, so the best number of teeth grows like the area to the power 1 / 2.4 (see [`crate::engine::gather::allot`]).
fn relief(area: f64) -> f64 {
    libm::pow(area.max(f64::MIN_POSITIVE), -0.7 / 2.4).clamp(1.0, MOST_RELIEF_FACTOR)
}

impl Pilot<'_> {
    /// Measures direct light at the vertices without any, as the increments will read it.
    pub(super) fn complete_direct(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let started = Instant::now();
        let new = self.direct.lx.len()..gatherers.len();
        let measured = self.measured(elements, gatherers, new.collect());
        let is_for_it_alone = self.mesh.for_indirect_light.is_some();
        let costs = &mut self.costs;
        let cost = if is_for_it_alone { &mut costs.in_shadows } else { &mut costs.direct };
        cost.add(started.elapsed(), measured.len() as f64);
        if self.direct.in_time.has_passed() {
            self.direct.is_hurried = true;
            self.is_whole = false;
        }
        self.direct.lx.extend(measured.iter().map(|m| m.lx));
        self.direct.variance.extend(measured.iter().map(|m| m.variance));
        self.direct
            .measured_at
            .extend(gatherers[self.direct.measured_at.len()..].iter().map(|g| g.origin));
    }

    /// Measures direct light again where receivers have moved. Those on borders move when elements are bisected.
    pub(super) fn measure_moved(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let has_moved = |&k: &usize| gatherers[k].origin != self.direct.measured_at[k];
        let moved: Vec<usize> = (0..gatherers.len()).filter(has_moved).collect();
        let measured = self.measured(elements, gatherers, moved.clone());
        for (k, measured) in moved.into_iter().zip(measured) {
            self.direct.lx[k] = measured.lx;
            self.direct.variance[k] = measured.variance;
        }
    }

    /// Direct light at some vertices. If it has noise, that of each vertex is independent and as large as allowed. Vertices
    /// whose turn comes too late get the fewest shadow rays.
    fn measured(
        &self,
        elements: &Elements,
        gatherers: &[Gatherer],
        some: Vec<usize>,
    ) -> Vec<Measured> {
        let vertices = elements.vertices();
        let mean_m2 = vertices.iter().map(|v| v.area_m2).sum::<f64>() / vertices.len() as f64;
        let first = self.mesh.for_indirect_light.as_ref().map_or(usize::MAX, |(count, _)| *count);
        let alike = Sequence::new(self.key.with(1));
        let measured = |k: usize| {
            if self.direct.in_time.has_passed() {
                let sequence = Sequence::new(self.key.with(5).with(k as u64));
                let looks = if self.end.has_passed() { self.rays_too_late } else { 2 };
                return self.lighting.measured_in_a_hurry(&gatherers[k].surface, looks, sequence);
            }
            let (goal, sequence) = match self.direct.noise_lx {
                Some(lx) => {
                    let relief = relief(vertices[k].area_m2 / mean_m2);
                    let more = if k >= first { SHADOW_NOISE_FACTOR } else { 1.0 };
                    let goal = Goal::lux(lx).relaxed((relief * more).min(MOST_NOISE_FACTOR));
                    (goal, Sequence::new(self.key.with(5).with(k as u64)))
                }
                None => (Goal::ANY, alike),
            };
            self.lighting.measured(&gatherers[k].surface, goal, sequence)
        };
        some.into_par_iter().with_max_len(TASK_VERTICES).map(measured).collect()
    }

    /// Fixes the allowed noise of direct light, lx, from a few vertices. It is a share of all light: direct light, and
    /// the mean reflected light of a closed room. For open rooms that light is overestimated.
    pub(super) fn look_at_direct_light(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let Some(share) = self.direct.noise else { return };
        let every = (gatherers.len() / LEVEL_VERTICES).max(1);
        let sequence = Sequence::new(self.key.with(8));
        let look = |k: usize| {
            let light = self.lighting.measured(&gatherers[k].surface, Goal::ANY, sequence);
            (elements.vertices()[k].area_m2, light.lx.luminance())
        };
        let some: Vec<usize> = (0..gatherers.len()).step_by(every).collect();
        // The first is looked at in any case: without any nothing is known.
        let in_time = some.into_par_iter().filter(|&k| k == 0 || !self.direct.in_time.has_passed());
        let some: Vec<(f64, f64)> = in_time.map(look).collect();
        let area_m2: f64 = some.iter().map(|(m2, _)| m2).sum();
        let mean =
            |power: i32| some.iter().map(|&(m2, lx)| m2 * lx.powi(power)).sum::<f64>() / area_m2;
        let (mean_lx, square) = (mean(1), mean(2));
        let reflectance = self.mean_reflectance().min(MOST_MEAN_REFLECTANCE);
        let whole_lx = mean_lx / (1.0 - reflectance);
        let varies = (square - mean_lx * mean_lx).max(0.0);
        self.direct.noise_lx = Some(share * (varies + whole_lx * whole_lx).sqrt());
    }

    /// The largest number of vertices for direct light. Best effort: sharp shadow borders would take unlimited elements,
    /// and with emitting surfaces refinement cannot distinguish noise from borders.
    pub(super) fn most_for_direct_light(&self, request: &PilotRequest) -> usize {
        let finer = (USUAL_MESH_GOAL / request.mesh_target).max(1.0);
        let most =
            (MOST_DIRECT_VERTICES_RATIO * finer * self.indirect.gathered.len() as f64) as usize;
        most.max(FREE_DIRECT_VERTICES).min(request.max_vertices)
    }

    /// The interpolation error of direct light by element, lx, and the ratio of the total to its goal. If vertices gather
    /// for the stored map, the error is that of all light.
    pub(super) fn direct_excess(
        &self,
        elements: &Elements,
        request: &PilotRequest,
        reference_lx: f64,
    ) -> (Vec<LeafError>, f64) {
        let signal = self.in_the_open(&self.direct.lx);
        // All vertices have direct light of their own.
        let (carriers, no) = (Carriers::all(), |_, _| false);
        let details = Details::of(&self.mesh.subdivision, elements, &signal, &carriers, no);
        let errors = details.leaf_errors(|_| None, |_| false, |_, _| false);
        let target = request.mesh_target;
        let bare = self.bare_errors(elements, &signal);
        let seen = bare.as_ref().unwrap_or(&errors);
        let excess = trust::error_of(seen, |_| true) / (target * reference_lx);
        let of_mean =
            self.mean_excess(&errors) / (MEAN_ERROR_SHARE * request.target * reference_lx);
        let excess = excess.max(of_mean);
        let in_rooms = self.lighting.are_read_at_ends().then(|| self.weighed_in_rooms(&errors));
        let Some(in_rooms) = in_rooms.flatten() else { return (bare.unwrap_or(errors), excess) };
        let target = request.target.min(COARSEST_ROOM_GOAL);
        let of_rooms =
            self.mean_excess_in_rooms(&in_rooms) / (ROOM_ERROR_SHARE * target * reference_lx);
        let whole = bare.unwrap_or(errors);
        if of_rooms > excess { (in_rooms, of_rooms) } else { (whole, excess) }
    }

    /// The weighted mean error of direct light in dim rooms beside bright places after all reflections, lx. Means are
    /// taken per triangle of the scene: errors on a ceiling and on a floor do not cancel.
    fn mean_excess_in_rooms(&self, errors: &[LeafError]) -> f64 {
        let (mut dim_m2, mut all_m2) = (0.0, 0.0);
        let mut lacking: BTreeMap<(u32, bool), f64> = BTreeMap::new();
        for error in errors {
            let Origin { triangle, back, .. } = self.mesh.subdivision.node(error.node).1;
            let own_m2 = error.area_m2 * (1.0 - 1.0 / error.weight);
            all_m2 += error.area_m2;
            dim_m2 += own_m2;
            if own_m2 > 0.0 {
                *lacking.entry((triangle, back)).or_default() +=
                    own_m2 * error.weight * error.excess;
            }
        }
        let lacking: f64 = lacking.values().map(|lx_m2| lx_m2.abs()).sum();
        lacking / dim_m2.max(LEAST_DIM_AREA_SHARE * all_m2) * self.reflected_again()
    }

    /// The ratio of reflected to direct light in a closed room.
    pub(super) fn reflected_again(&self) -> f64 {
        let reflectance = self.mean_reflectance().min(MOST_MEAN_REFLECTANCE);
        reflectance / (1.0 - reflectance)
    }

    /// The mean error of reflected light from these errors of direct light after all reflections, lx; zero where rays
    /// do not read direct light from the map.
    fn mean_excess(&self, errors: &[LeafError]) -> f64 {
        if !self.lighting.are_read_at_ends() {
            return 0.0;
        }
        let area_m2: f64 = errors.iter().map(|e| e.area_m2).sum();
        let lacking: f64 = errors.iter().map(|e| e.area_m2 * e.excess).sum();
        (lacking / area_m2).abs() * self.reflected_again()
    }
}
