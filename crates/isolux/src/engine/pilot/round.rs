//! The report of a round: work done, and the prediction of the remaining time.

use super::forecast::{EachIncrement, Excess, GoOn, Outlook, Round};
use super::look::{PilotRequest, Survey};
use super::state::{FIRST_PART_DIVISOR, Pilot};
use crate::elements::Elements;
use crate::engine::gather::{
    FEWEST_UNJUDGED, Gatherer, RayTrial, allot, areas_m2, mean_of, noise_for,
};
use crate::engine::judge::{BELIEVED_INCREMENTS, check_points};
use crate::engine::method::hybrid;
use crate::engine::ray::Dice;
use crate::sampling::{CosineHemisphere, Sequence};
use isolux_geometry::Ray;
use rayon::prelude::*;
use std::borrow::Cow;
use std::time::Instant;

/// The number of rays per vertex in the measurement of the time of a traced ray.
const TRACED_RAYS: u32 = 16;

/// The growth of vertices for direct light, as a power of the ratio of its error to the goal. Measured in the hall.
const ORDER_FOR_DIRECT: f64 = 0.5;
/// The power of that growth where vertices also gather indirect light for the stored map. Measured in the hall.
const ORDER_FOR_BARE: f64 = 1.3;

/// The vertices that a round for direct light adds, in multiples of those of the last round (decision 53).
const NEXT_ROUND_RATIO: f64 = 1.5;

/// The share of the vertices that bisection moves: a guess.
const MOVED_VERTEX_SHARE: f64 = 0.1;

impl Pilot<'_> {
    /// Reports a round and returns whether there is time for the next step. Without time the pilot counts as
    /// incomplete.
    pub(super) fn has_time(
        &mut self,
        look: &Survey,
        request: &PilotRequest,
        excess: Excess,
        go_on: &mut GoOn<'_>,
    ) -> bool {
        // A prediction takes long where there are many vertices.
        let has_time = !self.end.has_passed() && go_on(&self.round(request, Some(look), excess));
        self.is_whole &= has_time;
        has_time
    }

    /// Measures the costs of direct light and of rays before the first survey, and reports the first prediction, in
    /// scenes of many objects. In other scenes it only fixes the noise of direct light.
    pub(super) fn begin(
        &mut self,
        elements: &Elements,
        gatherers: &[Gatherer],
        request: &PilotRequest,
        go_on: &mut GoOn<'_>,
    ) {
        self.look_at_direct_light(elements, gatherers);
        if !self.mesh.has_many_things {
            return;
        }
        self.complete_direct(elements, &gatherers[..gatherers.len() / FIRST_PART_DIVISOR]);
        let (started, sequence) = (Instant::now(), Sequence::new(self.key));
        let some: Vec<&Gatherer> = gatherers.iter().step_by(FIRST_PART_DIVISOR).collect();
        let trace = |gatherer: &&Gatherer| {
            if self.end.has_passed() {
                return 0;
            }
            let axis = gatherer.normal.to_direction();
            for index in 0..TRACED_RAYS {
                let local = CosineHemisphere::sample(Dice::new(sequence, index).pair());
                let ray = Ray::new(gatherer.origin, axis.from_local(local));
                std::hint::black_box(self.scene.bvh().closest_hit(&ray));
            }
            TRACED_RAYS
        };
        let traced: u32 = some.par_iter().map(trace).sum();
        self.costs.traced.add(started.elapsed(), f64::from(traced));
        self.report_before_survey(request, go_on);
    }

    /// Reports what is known before the first survey. Costs of work done in a hurry tell nothing.
    pub(super) fn report_before_survey(&self, request: &PilotRequest, go_on: &mut GoOn<'_>) {
        if !self.end.has_passed() {
            go_on(&self.round(request, None, (None, None)));
        }
    }

    /// The work done and the work to come, from the last survey if there was one.
    pub(super) fn round(
        &self,
        request: &PilotRequest,
        look: Option<&Survey>,
        (excess, before): Excess,
    ) -> Round {
        let vertices = self.mesh.subdivision.vertex_count();
        let trial =
            self.tried.trial.unwrap_or(RayTrial::usual(look.map_or(1.0, |look| look.reference_lx)));
        let reference_lx = look.map_or(trial.reference_lx, |look| look.reference_lx);
        let fixed = self.mesh.for_indirect_light.as_ref().map(|(count, _)| *count);
        let carriers = self.mesh.carriers.count(fixed.unwrap_or(vertices));
        // Each round adds more than the one before, except the last.
        let another = NEXT_ROUND_RATIO * self.direct.added as f64;
        let unmeasured = look.filter(|_| !self.direct.is_measured);
        let more = unmeasured.map_or(0.0, |look| self.more_for_direct(look, request, another));
        let for_bare = look.map_or(0.0, |look| self.rows_for_bare(look, request, more));
        let interpolation = look.map_or(request.target, |look| look.interpolation(request));
        let noise = noise_for(request.target, interpolation);
        let wanted = trial.wanted(noise, reference_lx, BELIEVED_INCREMENTS);
        let rays = look.map_or(wanted, |_| self.mean_allotted(wanted));
        let of_one = f64::from(trial.rays_anywhere(noise, reference_lx, BELIEVED_INCREMENTS));
        let checks = check_points::count(carriers) as f64;
        let outlook = Outlook {
            carriers: carriers as f64,
            gathered: self.indirect.gathered.iter().filter(|&&gathered| gathered).count() as f64,
            vertices: vertices as f64,
            most: self.mesh.most_for_indirect_light,
            measured: self.direct.lx.len() as f64,
            pilot_rays: mean_of(&self.mesh.rays),
            each: EachIncrement {
                rays,
                check_rays: (checks + for_bare) * of_one,
                particles: self.particles(request.target, (vertices, reference_lx), carriers, rays),
                measures_direct: !self.lighting.is_measured_once(),
            },
            checks,
            trials: hybrid::rays_tried(carriers, rays),
            target: request.target,
            excess,
            before,
            usual: if look.is_none() && !self.direct.is_measured { self.usual() } else { None },
            more_for_direct: more,
            measured_again: if self.direct.is_measured { 0.0 } else { MOVED_VERTEX_SHARE },
        };
        Round {
            receivers: vertices,
            rays: self.traced,
            receivers_then: outlook.vertices_then(),
            step_s: self.costs.in_shadows(another.min(more)),
            left: outlook.left(&self.costs),
        }
    }

    /// The number of vertices still to be added for direct light alone. `another` is the number that the next round
    /// will add, if there is one.
    fn more_for_direct(&self, look: &Survey, request: &PilotRequest, another: f64) -> f64 {
        let vertices = self.mesh.subdivision.vertex_count() as f64;
        let excess = self.direct_excess_now(look, request);
        let gathers = self.gathers_for_bare(look, request);
        let order = if gathers { ORDER_FOR_BARE } else { ORDER_FOR_DIRECT };
        let then = vertices * libm::pow(excess.max(1.0), order);
        let least = if excess > 1.0 { vertices + another } else { vertices };
        let most = self.most_for_direct_light(request) as f64;
        (then.max(least).min(most) - vertices).max(0.0)
    }

    /// The mean number of rays of a vertex, allotted by area from a mean of `rays`. Vertices without a control
    /// variate get at least [`FEWEST_UNJUDGED`].
    fn mean_allotted(&self, rays: f64) -> f64 {
        let areas_m2 = match &self.mesh.for_indirect_light {
            Some((_, areas_m2)) => Cow::Borrowed(areas_m2),
            None => Cow::Owned(areas_m2(&self.mesh.subdivision, &self.mesh.carriers)),
        };
        let mut allotted = allot(&areas_m2, rays);
        for (vertex, rays) in allotted.iter_mut().enumerate().filter(|(_, rays)| **rays > 0) {
            let behind =
                self.walls.behind.get(&(vertex as u32)).and_then(|(_, light)| light.as_ref());
            *rays = if behind.is_none() { (*rays).max(FEWEST_UNJUDGED) } else { *rays };
        }
        mean_of(&allotted)
    }

    /// The number of particles of an increment, shared out with the rays of the carriers.
    fn particles(
        &self,
        target: f64,
        (vertices, reference_lx): (usize, f64),
        carriers: usize,
        rays: f64,
    ) -> f64 {
        if !self.lighting.leaves_caustics() {
            return 0.0;
        }
        let (goal, increments) = ((target, reference_lx), BELIEVED_INCREMENTS);
        let rays = carriers as f64 * rays;
        let share = self.tried.caustic_noise.share(vertices, goal, increments, rays);
        f64::from(self.tried.caustic_noise.particles(vertices, goal, increments, share))
    }

    /// The ratio of the interpolation error of direct light to its goal, from the last round or computed anew.
    fn direct_excess_now(&self, look: &Survey, request: &PilotRequest) -> f64 {
        let known =
            self.direct.excess.filter(|(of, _)| *of == self.mesh.subdivision.vertex_count());
        let look_now = || self.direct_excess(&look.elements, request, look.reference_lx).1;
        known.map_or_else(look_now, |(_, excess)| excess)
    }

    /// The size of the usual first mesh, in multiples of the present one; `None` where there are few objects. Among
    /// many objects light is not smooth.
    fn usual(&self) -> Option<f64> {
        let edge_m = self.mesh.usual_edge_m.filter(|_| self.mesh.has_many_things)?;
        let leaves = || self.mesh.subdivision.leaves();
        // Two bisections halve the longest edge.
        let parts = |node: u32| {
            let halvings = libm::log2(self.mesh.subdivision.longest_edge_m(node) / edge_m);
            libm::exp2((2.0 * halvings).ceil().max(0.0))
        };
        Some(leaves().map(parts).sum::<f64>() / leaves().count().max(1) as f64)
    }
}
