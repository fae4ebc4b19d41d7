//! Indirect light at the vertices of the pilot, by final gathering.

use super::forecast::GoOn;
use super::look::PilotRequest;
use super::state::{FIRST_PART_DIVISOR, PILOT_TOLERANCE, Pilot};
use crate::ablation::without;
use crate::elements::Elements;
use crate::engine::gather::Gatherer;
use crate::engine::mesh::Carriers;
use crate::engine::particle::Flights;
use crate::engine::ray::SurfacePoint;
use crate::map::Standing;
use crate::units::Rgb;
use rayon::prelude::*;
use std::cell::RefCell;
use std::time::Instant;

/// The number of particles that find the places reached by way of specular surfaces.
const SPECULAR_PARTICLES: u32 = 1 << 13;

impl Pilot<'_> {
    /// Gathers at the carriers that have not gathered yet. On the first mesh all carriers gather, and the fixed point
    /// of light is solved.
    pub(super) fn complete_indirect(
        &mut self,
        elements: &Elements,
        gatherers: &[Gatherer],
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        let is_first = self.indirect.lx.is_empty();
        // On the first mesh the geometry close to vertices is not known yet.
        if is_first {
            self.set_out(elements, gatherers);
            self.find_walls(elements, gatherers);
        }
        let new = self.new_carriers(gatherers.len());
        let rows = self.rows(&new, gatherers);
        self.keep_behind(&new, &rows);
        let level = if is_first { u32::MAX } else { self.indirect.solved_nodes };
        let gathering = self.gathering(elements, level, &self.near.standings);
        let key = self.key.with(2);
        let mut started = Instant::now();
        let head = if is_first { rows.len() / FIRST_PART_DIVISOR } else { 0 };
        let mut operator = self.operator(&gathering, &rows[..head], key);
        if is_first {
            // The time of a portion gives an early prediction. With a control variate, rays take little of the time.
            self.costs.rays.add(started.elapsed(), operator.rays as f64);
            if self.walls.backdrop.is_none() {
                self.report_before_survey(request, go_on);
            }
            started = Instant::now();
        }
        let tail = &rows[head..];
        let tail = if is_first { self.affordable(tail, request) } else { tail.to_vec() };
        let gathering = self.gathering(elements, level, &self.near.standings);
        let tail = self.operator(&gathering, &tail, key);
        let rays = tail.rays as f64;
        operator.append(tail);
        self.traced += operator.rays;
        self.indirect.lx.resize(gatherers.len(), Rgb::BLACK);
        if is_first {
            let black = vec![Rgb::BLACK; gatherers.len()];
            let waiting = self.mesh.carriers.waiting();
            self.indirect.lx =
                operator.solve(&black, &black, &waiting, (PILOT_TOLERANCE, &self.reflects_until));
            if !self.near.known.contains(&true) {
                // No vertex has light: places that are not closed in count as dark, not as hidden.
                self.near.known = operator.open();
            }
        } else {
            self.extend_known(elements, gatherers);
            let light = operator.apply(&self.indirect.lx);
            new.iter().zip(light).for_each(|(&v, light)| self.indirect.lx[v as usize] = light);
            self.mesh.carriers.fill(&mut self.indirect.lx);
        }
        self.costs.rays.add(started.elapsed(), rays);
        self.complete_standings(gatherers);
        if is_first {
            self.look_about(elements, gatherers, &operator);
        }
        new.iter()
            .for_each(|&v| self.indirect.gathered[v as usize] = self.mesh.carriers.is_active(v));
        self.complete_beset_carriers(gatherers);
        self.indirect.solved_nodes = self.mesh.subdivision.node_count() as u32;
    }

    /// Receivers of the first survey, with fewer rays each where time is short. The pilot then counts as incomplete.
    fn affordable(&mut self, tail: &[Gatherer], request: &PilotRequest) -> Vec<Gatherer> {
        let rays = |some: &[Gatherer]| some.iter().map(|g| f64::from(g.rays)).sum::<f64>();
        let share = request.deadline.share_of(self.costs.rays.of(rays(tail)));
        self.is_whole &= share == 1.0;
        let fewer = |g: &Gatherer| match g.rays {
            0 => *g,
            rays => g.with_rays(((f64::from(rays) * share) as u32).max(1)),
        };
        tail.iter().map(fewer).collect()
    }

    /// Finds the geometry close to the vertices of the first mesh, and selects the carriers.
    fn set_out(&mut self, elements: &Elements, gatherers: &[Gatherer]) {
        let started = Instant::now();
        self.near.reached = self.reached_by_caustics();
        self.extend_known(elements, gatherers);
        self.complete_standings(gatherers);
        self.costs.first.add(started.elapsed(), gatherers.len() as f64);
        if self.mesh.spacing_m > 0.0 && !without("carriers") {
            let is_open = |of: &Option<Standing>| *of == Some(Standing::Open);
            let open: Vec<bool> = self.near.standings.iter().map(is_open).collect();
            self.mesh.carriers =
                Carriers::sparse(&self.mesh.subdivision, self.mesh.spacing_m, &open);
        }
    }

    /// The vertices that are to gather: carriers that have not gathered yet, and on the first mesh all vertices.
    fn new_carriers(&mut self, vertices: usize) -> Vec<u32> {
        let is_first = self.indirect.gathered.is_empty();
        self.indirect.gathered.resize(vertices, false);
        let is_new = |&v: &u32| {
            is_first || self.mesh.carriers.is_active(v) && !self.indirect.gathered[v as usize]
        };
        (0..vertices as u32).filter(is_new).collect()
    }

    /// The places that trial particles reach by way of specular surfaces.
    fn reached_by_caustics(&self) -> Vec<SurfacePoint> {
        let of = (self.scene, self.lighting);
        let flights = Flights::new(of, None, SPECULAR_PARTICLES, self.key.with(10));
        let Some(flights) = flights.filter(|_| self.lighting.leaves_caustics()) else {
            return Vec::new();
        };
        let places_of = |index: u32| {
            let places = RefCell::new(Vec::new());
            flights.fly(index, |at, _| places.borrow_mut().push(*at));
            places.into_inner()
        };
        (0..SPECULAR_PARTICLES).into_par_iter().flat_map_iter(places_of).collect()
    }
}
