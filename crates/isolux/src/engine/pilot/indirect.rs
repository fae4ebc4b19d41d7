//! Indirect light on the elements of the pilot.

use super::forecast::GoOn;
use super::look::PilotRequest;
use super::{FIRST_PART, PILOT_TOLERANCE, Pilot};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::Gatherer;
use crate::engine::mesh::Carriers;
use crate::engine::occlusion::nearby;
use crate::map::Standing;
use crate::units::Rgb;
use rayon::prelude::*;
use std::time::Instant;

impl Pilot<'_> {
    /// Gathers at the vertices that carry light and have not gathered; all of the first mesh, where light is solved for.
    pub(super) fn complete_indirect(
        &mut self,
        elements: &Elements,
        gatherers: &[Gatherer],
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        let is_first = self.indirect.is_empty();
        // On the first mesh nobody knows yet what stands close.
        if is_first {
            self.set_out(elements, gatherers);
            self.find_walls(elements, gatherers);
        }
        let new = self.new_carriers(gatherers.len());
        let rows = self.rows(&new, gatherers);
        self.keep_behind(&new, &rows);
        let level = if is_first { u32::MAX } else { self.solved_nodes };
        let gathering = self.gathering(elements, level, &self.standings);
        let key = self.key.with(2);
        let mut started = Instant::now();
        let head = if is_first { rows.len() / FIRST_PART } else { 0 };
        let mut operator = gathering.operator(&rows[..head], |_| key);
        if is_first {
            // How long it takes is told as soon as it is known how long a part takes; before walls rays take little of it.
            self.costs.rays.add(started.elapsed(), operator.rays as f64);
            if self.backdrop.is_none() {
                go_on(&self.round(request, None, (None, None)));
            }
            started = Instant::now();
        }
        let gathering = self.gathering(elements, level, &self.standings);
        let tail = gathering.operator(&rows[head..], |_| key);
        let rays = tail.rays as f64;
        operator.append(tail);
        self.traced += operator.rays;
        self.indirect.resize(gatherers.len(), Rgb::BLACK);
        if is_first {
            let black = vec![Rgb::BLACK; gatherers.len()];
            self.indirect =
                operator.solve(&black, &black, &self.carriers.waiting(), PILOT_TOLERANCE);
            if !self.known.contains(&true) {
                // No light at all: what is not closed in is dark.
                self.known = operator.open();
            }
        } else {
            self.extend_known(elements, gatherers);
            let light = operator.apply(&self.indirect);
            new.iter().zip(light).for_each(|(&v, light)| self.indirect[v as usize] = light);
            self.carriers.fill(&mut self.indirect);
        }
        self.costs.rays.add(started.elapsed(), rays);
        self.complete_standings(gatherers);
        if is_first {
            self.look_about(elements, gatherers, &operator);
        }
        new.iter().for_each(|&v| self.gathered[v as usize] = self.carriers.is_active(v));
        self.complete_beset_carriers(gatherers);
        self.solved_nodes = self.subdivision.node_count() as u32;
    }

    /// Finds out what stands close before the vertices of the first mesh, and which of them carry light.
    fn set_out(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let started = Instant::now();
        self.reached = self.reached_by_caustics();
        self.extend_known(elements, gatherers);
        self.complete_standings(gatherers);
        self.costs.first.add(started.elapsed(), gatherers.len() as f64);
        if self.spacing_m > 0.0 && !without("carriers") {
            let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
            let open: Vec<bool> = self.standings.iter().map(is_open).collect();
            self.carriers = Carriers::sparse(&self.subdivision, self.spacing_m, &open);
        }
    }

    /// The vertices that are to gather; all of the first mesh, as far as they carry light.
    fn new_carriers(&mut self, vertices: usize) -> Vec<u32> {
        let is_first = self.gathered.is_empty();
        self.gathered.resize(vertices, false);
        let is_new =
            |&v: &u32| is_first || self.carriers.is_active(v) && !self.gathered[v as usize];
        (0..vertices as u32).filter(is_new).collect()
    }

    pub(super) fn rows(&self, vertices: &[u32], gatherers: &[Gatherer]) -> Vec<Gatherer> {
        let edges_m = self.subdivision.longest_edges_m();
        let row = |&vertex: &u32| {
            let gatherer = &gatherers[vertex as usize];
            let edge_m = edges_m[vertex as usize];
            let rays = if self.carriers.is_active(vertex) { self.rays[vertex as usize] } else { 0 };
            let in_gap = nearby::is_closed_in(self.scene, &gatherer.surface, edge_m);
            let gatherer = gatherer.with_rays(rays).in_gap(in_gap);
            if rays > 0 { self.before_walls(vertex, gatherer) } else { gatherer }
        };
        vertices.par_iter().map(row).collect()
    }
}
