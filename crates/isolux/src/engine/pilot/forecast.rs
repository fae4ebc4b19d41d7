//! The prediction of the remaining time of a run, from a cost model.
//!
//! The model knows the time of a ray and of a measurement of direct light, the number of vertices that carry
//! light, and the ratio of their error to the goal. The error of piecewise linear functions falls with the first
//! power of the number of vertices; the order is then measured from round to round. None of this enters a map.

use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::method::READERS;
use std::time::Duration;

/// The lowest believed order of convergence of the elements' error in the number of vertices.
const LEAST_ORDER: f64 = 0.7;
/// The highest believed order: that of piecewise linear functions.
const MOST_ORDER: f64 = 1.0;

/// The accuracy goal above which no growth of the mesh is predicted before the first survey.
const USUAL_TARGET: f64 = 0.01;
/// The order of convergence that predicts the growth for finer goals: the error falls like this power of the
/// number of vertices.
const GROWTH_ORDER: f64 = 2.0;

// The next seven were measured in the hall, CUBE, SPHERE and offices.

/// The time of the fixed point of an increment, as a share of the time of its rays (decision 53).
const FIXED_POINT_SHARE: f64 = 0.4;
/// The time of the work before the first increment, in surveys of the vertices.
const FIRST_WORK_SURVEYS: f64 = 2.0;
/// The time of direct light at a check point, in vertices (decision 53).
const CHECK_POINT_COST: f64 = 6.5;
/// The time of direct light at a vertex made for it alone, at a shadow border, in other vertices (decision 53).
const SHADOW_VERTEX_COST: f64 = 2.3;
/// The time of the first survey, in later ones.
pub(crate) const FIRST_SURVEY_COST: f64 = 1.4;
/// The time of a survey of known vertices, in first surveys, until it is measured.
const LATER_SURVEY_COST: f64 = 0.1;

/// The predicted number of increments. Most runs end as soon as their error is believed, some after twice as many.
const EXPECTED_INCREMENTS: f64 = BELIEVED_INCREMENTS as f64 + 0.5;

/// The usual number of rounds of refinement for indirect light, if any (decision 24). Each looks at all vertices.
const INDIRECT_ROUNDS: f64 = 5.0;
/// The usual number of later rounds for direct light, if any (decision 24). Each looks at all vertices.
const DIRECT_ROUNDS: f64 = 3.0;

// The next three hold before the first survey of scenes with many objects and were measured in the hall.

/// The accuracy goal for which the usual first mesh is good enough.
const FIRST_MESH_GOAL: f64 = 0.02;
/// The vertices added for direct light, as a share of the growth from the first mesh to the usual one. A mesh that
/// is fine already needs no more.
const DIRECT_VERTICES_SHARE: f64 = 0.75;
/// The time of the whole run, in multiples of the time of the known work.
const MANY_OBJECTS_TIME_RATIO: f64 = 1.2;
/// The time of the whole run in scenes with few objects before the first survey, in multiples of the time on
/// unchanged elements. Middle value of rooms, offices and outdoor scenes; an empty room takes a fourth of it.
const FEW_OBJECTS_TIME_RATIO: f64 = 3.0;
/// The time of a gathering ray until it is measured, in rays that are only traced.
const GATHERING_RAY_COST: f64 = 1.9;
/// The time of a first survey per vertex until it is measured, in rays that are only traced. With 10, the
/// first forecast of the hall was a quarter too short (decision 43).
const SURVEY_COST_A_VERTEX: f64 = 19.0;

/// The factor either way that holds the true time in nine of ten runs, for few objects before the first survey.
const FEW_OBJECTS_DOUBT_FACTOR: f64 = 6.0;
/// The same factor for many objects before the first survey.
const MANY_OBJECTS_DOUBT_FACTOR: f64 = 2.5;
/// The same factor while elements are refined.
const REFINING_DOUBT_FACTOR: f64 = 1.7;
/// The same factor once elements are fixed.
const FIXED_MESH_DOUBT_FACTOR: f64 = 1.25;

/// The time spent on a number of equal pieces of work.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    time_s: f64,
    things: f64,
}

impl Cost {
    pub(crate) fn add(&mut self, time: Duration, things: f64) {
        self.time_s += time.as_secs_f64();
        self.things += things;
    }

    fn times(self, factor: f64) -> Self {
        Self { time_s: factor * self.time_s, ..self }
    }

    pub(crate) fn of(self, things: f64) -> f64 {
        if self.things > 0.0 { self.time_s * things / self.things } else { 0.0 }
    }
}

/// The measured costs of the pilot's work on this machine and scene.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Costs {
    /// Gathering rays, sweeps of the fixed point included.
    pub(crate) rays: Cost,
    /// Gathering rays of trials, without sweeps.
    pub(crate) tried: Cost,
    /// Vertices where direct light is measured.
    pub(crate) direct: Cost,
    /// Vertices made for direct light alone.
    pub(crate) in_shadows: Cost,
    /// Vertices where increments measure direct light again.
    pub(crate) again: Cost,
    /// All other work of a survey, by its vertices.
    pub(crate) looks: Cost,
    /// All other work of the first survey, by its vertices, all of which are new.
    pub(crate) first: Cost,
    /// Rays that are only traced.
    pub(crate) traced: Cost,
}

impl Costs {
    /// The time of gathering rays in the pilot, s.
    fn of_rays(&self, rays: f64) -> f64 {
        let known =
            if self.rays.things > 0.0 { self.rays } else { self.traced.times(GATHERING_RAY_COST) };
        known.of(rays)
    }

    /// The time of gathering rays in an increment, s.
    fn of_rays_then(&self, rays: f64) -> f64 {
        if self.tried.things > 0.0 { self.tried.of(rays) } else { self.of_rays(rays) }
    }

    /// The time of direct light at vertices made for it alone, s.
    pub(crate) fn in_shadows(&self, vertices: f64) -> f64 {
        let is_known = self.in_shadows.things > 0.0;
        if is_known {
            self.in_shadows.of(vertices)
        } else {
            SHADOW_VERTEX_COST * self.direct.of(vertices)
        }
    }

    /// The time of direct light in an increment that measures it, s.
    fn again(&self, vertices: f64) -> f64 {
        if self.again.things > 0.0 { self.again.of(vertices) } else { self.direct.of(vertices) }
    }

    /// The time of the first survey of vertices, s.
    fn of_first(&self, vertices: f64) -> f64 {
        let known = if self.first.things > 0.0 {
            self.first
        } else {
            self.traced.times(SURVEY_COST_A_VERTEX)
        };
        known.of(vertices)
    }

    /// The time of a later survey of vertices, s.
    fn of_looks(&self, vertices: f64) -> f64 {
        let is_known = self.looks.things > 0.0;
        if is_known { self.looks.of(vertices) } else { LATER_SURVEY_COST * self.of_first(vertices) }
    }
}

/// The work of an increment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EachIncrement {
    /// Rays per carrier.
    pub(crate) rays: f64,
    /// All rays from check points and vertices for the stored map.
    pub(crate) check_rays: f64,
    /// Particles for caustics.
    pub(crate) particles: f64,
    /// Whether direct light is measured anew.
    pub(crate) measures_direct: bool,
}

/// The inputs of the prediction: quantities of the work to come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlook {
    /// The number of vertices that carry light.
    pub(crate) carriers: f64,
    /// The number of carriers that have gathered already.
    pub(crate) gathered: f64,
    /// The number of all vertices.
    pub(crate) vertices: f64,
    /// The largest number of vertices for indirect light.
    pub(crate) most: f64,
    /// The number of vertices whose direct light is measured.
    pub(crate) measured: f64,
    /// Rays per carrier in the pilot.
    pub(crate) pilot_rays: f64,
    /// The work of an increment.
    pub(crate) each: EachIncrement,
    /// The number of check points.
    pub(crate) checks: f64,
    /// Rays of trials before the first increment.
    pub(crate) trials: f64,
    /// The relative accuracy goal.
    pub(crate) target: f64,
    /// The ratio of the error to its goal; `None` before the first survey.
    pub(crate) excess: Option<f64>,
    /// That ratio one round ago, with the number of carriers then; `None` where unknown.
    pub(crate) before: Option<(f64, f64)>,
    /// The size of the usual first mesh, in multiples of the present one; `None` after the first survey and in
    /// scenes of few objects.
    pub(crate) usual: Option<f64>,
    /// The number of vertices still to be added for direct light alone.
    pub(crate) more_for_direct: f64,
    /// The share of all vertices whose direct light will be measured again.
    pub(crate) measured_again: f64,
}

/// The predicted remaining time, s, and the factor either way that holds the true time in nine of ten runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Left {
    pub(crate) time_s: f64,
    pub(crate) factor: f64,
}

impl Outlook {
    /// The final number of carriers, in multiples of the present one.
    fn growth(&self) -> f64 {
        let Some(excess) = self.excess else {
            let (usual, target) =
                self.usual.map_or((1.0, USUAL_TARGET), |usual| (usual, FIRST_MESH_GOAL));
            return usual * libm::pow(target / self.target, 1.0 / GROWTH_ORDER).max(1.0);
        };
        if excess <= 1.0 {
            return 1.0;
        }
        let order = self.before.map_or(MOST_ORDER, |(excess_before, carriers_before)| {
            libm::log(excess_before / excess) / libm::log(self.carriers / carriers_before)
        });
        let order = if order.is_nan() { MOST_ORDER } else { order.clamp(LEAST_ORDER, MOST_ORDER) };
        let allowed = 1.0 + (self.most - self.vertices).max(0.0) / self.carriers.max(1.0);
        libm::pow(excess, 1.0 / order).min(allowed)
    }

    /// The number of vertices after refinement for indirect light.
    fn looked_at(&self) -> f64 {
        self.vertices + self.carriers * (self.growth() - 1.0)
    }

    /// The number of rounds of refinement to come.
    fn rounds(&self) -> f64 {
        if let Some(usual) = self.usual {
            return (INDIRECT_ROUNDS + DIRECT_ROUNDS) * (2.0 * (usual - 1.0)).min(1.0);
        }
        let indirect = if self.growth() > 1.0 { INDIRECT_ROUNDS } else { 0.0 };
        indirect + if self.more_for_direct > 0.0 { DIRECT_ROUNDS } else { 0.0 }
    }

    /// The number of vertices still to be added for direct light alone.
    fn more_for_direct(&self) -> f64 {
        match self.usual {
            Some(usual) => DIRECT_VERTICES_SHARE * (usual - 1.0) * self.vertices,
            None => self.more_for_direct,
        }
    }

    /// The final number of vertices.
    pub(crate) fn vertices_then(&self) -> f64 {
        self.looked_at() + self.more_for_direct()
    }

    /// The predicted time of all remaining work.
    pub(crate) fn left(&self, costs: &Costs) -> Left {
        let growth = self.growth();
        let carriers = self.carriers * growth;
        let vertices = self.vertices_then();
        let for_direct = self.more_for_direct();
        // Nothing was surveyed yet.
        let is_blind = self.usual.is_some();
        let looked_at = self.looked_at();
        let look_s = if is_blind { costs.of_first(looked_at) } else { costs.of_looks(looked_at) };
        let pilot_s = costs.of_rays((carriers - self.gathered) * self.pilot_rays)
            + costs.direct.of(vertices - for_direct - self.measured)
            + costs.in_shadows(for_direct)
            + self.rounds() * look_s;
        let direct_s = costs.direct.of(self.measured_again * vertices);
        let EachIncrement { rays, check_rays, particles, measures_direct } = self.each;
        let (own, others) = (carriers * rays, check_rays + particles * growth);
        // All other work takes as long as one ray per vertex (decision 53).
        let each_s = costs.of_rays_then(own * (1.0 + FIXED_POINT_SHARE) + others + vertices)
            + if measures_direct { costs.again(vertices) } else { 0.0 };
        let once_s = FIRST_WORK_SURVEYS * costs.of_looks(vertices)
            + costs.of_rays_then(carriers * rays.min(READERS.into()) + self.trials)
            + CHECK_POINT_COST * costs.direct.of(self.checks);
        let (in_all, factor) = match self.excess {
            None if is_blind => (MANY_OBJECTS_TIME_RATIO, MANY_OBJECTS_DOUBT_FACTOR),
            None => (FEW_OBJECTS_TIME_RATIO, FEW_OBJECTS_DOUBT_FACTOR),
            Some(excess) if excess > 1.0 => (1.0, REFINING_DOUBT_FACTOR),
            Some(_) => (1.0, FIXED_MESH_DOUBT_FACTOR),
        };
        let time_s = pilot_s + direct_s + once_s + EXPECTED_INCREMENTS * each_s;
        Left { time_s: in_all * time_s, factor }
    }
}

/// The ratio of the error to its goal; then that ratio one round ago with the number of carriers. `None` where
/// unknown.
pub(crate) type Excess = (Option<f64>, Option<(f64, f64)>);

/// The ratio of one, for elements that are fine enough.
pub(crate) const FINE_EXCESS: Excess = (Some(1.0), None);

/// A callback that gets the report of every round and returns whether there is time for another.
pub(crate) type GoOn<'g> = dyn FnMut(&Round) -> bool + 'g;

/// The report of a round: the pilot's work so far and the work to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    /// The number of vertices.
    pub(crate) receivers: usize,
    /// The number of rays traced.
    pub(crate) rays: u64,
    /// The predicted final number of vertices.
    pub(crate) receivers_then: f64,
    /// The time of direct light in the next step, s; that step is not interrupted.
    pub(crate) step_s: f64,
    /// The predicted time to the accuracy goal.
    pub(crate) left: Left,
}
