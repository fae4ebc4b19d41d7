//! What a run will still take, as the pilot sees it coming.
//!
//! Of its work it knows how long a ray and a measurement of direct light take here, how many vertices
//! carry light, and by how much their error exceeds what it should be. Errors of piecewise linear
//! functions fall with the first power of the number of vertices; from round to round they are seen
//! to. None of this enters a map.

use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::method::READERS;
use std::time::Duration;

/// Error of the elements against the number of vertices: a power between these is believed.
const LEAST_ORDER: f64 = 0.7;
const MOST_ORDER: f64 = 1.0;

/// Before anything is seen, vertices grow so with the accuracy asked for, beyond this one.
const USUAL_TARGET: f64 = 0.01;
const USUAL_ORDER: f64 = 2.0;

/// What an increment does beside its rays: the fixed point over what they have found, as a share of what they take, and all that is
/// done for every vertex, in rays. Measured in the hall, CUBE, SPHERE and offices, as is what follows.
const SOLVED: f64 = 0.4;
const EVERY: f64 = 1.0;
/// What is done once before the first increment, in looks at the vertices; and direct light of a check point, in vertices.
const ONCE: f64 = 2.0;
const CHECKED: f64 = 6.5;
/// Direct light of a vertex that is made for it alone, where shadows end, in others.
const IN_SHADOWS: f64 = 2.3;
/// How much longer the first look takes than those after it.
pub(crate) const LONGER: f64 = 1.4;
/// A look at vertices that are known, in first looks, as long as there was none.
const LATER: f64 = 0.1;

/// Where light is smooth: what it takes to make the vertices that it has functions between, before it is known, as a multiple of
/// first looks at as many; and what they take once more before the first increment, of that. Measured in CUBE and an empty room.
const SMOOTHING: f64 = 1.5;
const FITTING: f64 = 1.3;

/// Increments: most runs end as soon as their error is believed, some after twice as many.
const INCREMENTS: f64 = BELIEVED_INCREMENTS as f64 + 0.5;

/// Rounds in which elements are mostly refined for indirect light once they are to be, and those for direct light
/// after them: each looks at all vertices.
const ROUNDS: f64 = 5.0;
const ROUNDS_FOR_DIRECT: f64 = 3.0;

/// Among many things, before the first look: the accuracy that the usual first mesh is good enough for; vertices that direct light
/// adds to it, as a share of what it has more than the first (one that is fine already needs no more); and what it takes in all, as a
/// multiple of what is known then. Measured in the hall.
const GOOD_ENOUGH: f64 = 0.02;
const MORE_FOR_DIRECT: f64 = 0.75;
const MANY_IN_ALL: f64 = 1.2;
/// Among few, before the first look: what it takes in all, as a multiple of what it would if elements stayed as they are, in the
/// middle of rooms, offices and places outside; an empty room takes a fourth of that.
const FEW_IN_ALL: f64 = 3.0;
/// And before that: what a gathering ray and a vertex cost, as multiples of a ray that is only traced.
const GATHERING: f64 = 1.9;
const FIRST: f64 = 19.0;

/// Factors between what is said and what comes, in nine of ten runs: before the first look among few things and among many, while
/// elements are refined, and when they are fixed.
const BLIND_AMONG_FEW: f64 = 6.0;
const BLIND: f64 = 2.5;
const REFINING: f64 = 1.7;
const FIXED: f64 = 1.25;

/// Time spent on a number of things.
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

/// What the pilot's work costs here.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Costs {
    /// Rays that gather, sweeps included.
    pub(crate) rays: Cost,
    /// The same in trials, without.
    pub(crate) tried: Cost,
    /// Places where direct light is measured, and those of them that are made for it alone.
    pub(crate) direct: Cost,
    pub(crate) in_shadows: Cost,
    /// The same as increments do it that measure it again.
    pub(crate) again: Cost,
    /// All else, by vertices that are looked at.
    pub(crate) looks: Cost,
    /// The same of the first mesh, where all of them are new.
    pub(crate) first: Cost,
    /// Rays that are only traced.
    pub(crate) traced: Cost,
    /// Making vertices where light is smooth, by all that there are then.
    pub(crate) smoothing: Cost,
}

impl Costs {
    /// What some rays that gather take.
    fn of_rays(&self, rays: f64) -> f64 {
        let known = if self.rays.things > 0.0 { self.rays } else { self.traced.times(GATHERING) };
        known.of(rays)
    }

    /// The same in an increment.
    fn of_rays_then(&self, rays: f64) -> f64 {
        if self.tried.things > 0.0 { self.tried.of(rays) } else { self.of_rays(rays) }
    }

    /// Direct light of vertices that are made for it alone.
    pub(crate) fn in_shadows(&self, vertices: f64) -> f64 {
        let is_known = self.in_shadows.things > 0.0;
        if is_known { self.in_shadows.of(vertices) } else { IN_SHADOWS * self.direct.of(vertices) }
    }

    /// Direct light of an increment that measures it.
    fn again(&self, vertices: f64) -> f64 {
        if self.again.things > 0.0 { self.again.of(vertices) } else { self.direct.of(vertices) }
    }

    /// What vertices take once.
    fn of_first(&self, vertices: f64) -> f64 {
        let known = if self.first.things > 0.0 { self.first } else { self.traced.times(FIRST) };
        known.of(vertices)
    }

    /// What it takes to look at vertices once more.
    fn of_looks(&self, vertices: f64) -> f64 {
        let is_known = self.looks.things > 0.0;
        if is_known { self.looks.of(vertices) } else { LATER * self.of_first(vertices) }
    }

    /// What it takes to make vertices where light is smooth.
    fn of_smoothing(&self, vertices: f64) -> f64 {
        let is_known = self.smoothing.things > 0.0;
        if is_known { self.smoothing.of(vertices) } else { SMOOTHING * self.of_first(vertices) }
    }
}

/// What is known of the work to come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outlook {
    /// Vertices that carry light, those of them that have gathered already, and all vertices.
    pub(crate) carriers: f64,
    pub(crate) gathered: f64,
    pub(crate) vertices: f64,
    /// All that there may be for indirect light.
    pub(crate) most: f64,
    /// Those whose direct light is measured.
    pub(crate) measured: f64,
    /// Rays of each in the pilot, and in an increment.
    pub(crate) pilot_rays: f64,
    pub(crate) rays: f64,
    /// Check points, and their rays and those of places where means are measured, together; and particles of an increment.
    pub(crate) checks: f64,
    pub(crate) check_rays: f64,
    pub(crate) particles: f64,
    /// Rays of trials before the first increment.
    pub(crate) trials: f64,
    /// Accuracy asked for.
    pub(crate) target: f64,
    /// By how much errors exceed what they should be, and what that was with how many carriers a
    /// round ago; unknown before the first look.
    pub(crate) excess: Option<f64>,
    pub(crate) before: Option<(f64, f64)>,
    /// Among many things, before the first look: the usual first mesh as a multiple of that there is.
    pub(crate) usual: Option<f64>,
    /// Into how many vertices each is made, where light is smooth.
    pub(crate) smoothed: f64,
    /// Whether it is, made already or not.
    pub(crate) is_smooth: bool,
    /// Vertices more than there are now that direct light alone will take, the part of all where it will be measured again, and
    /// whether it is in each increment.
    pub(crate) more_for_direct: f64,
    pub(crate) measured_again: f64,
    pub(crate) measured_each: bool,
}

/// Time left, s, and the factor either way that holds in nine of ten runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Left {
    pub(crate) time_s: f64,
    pub(crate) factor: f64,
}

impl Outlook {
    /// Vertices that will carry light, as a multiple of those that do.
    fn growth(&self) -> f64 {
        let Some(excess) = self.excess else {
            let (usual, target) =
                self.usual.map_or((1.0, USUAL_TARGET), |usual| (usual, GOOD_ENOUGH));
            return usual * libm::pow(target / self.target, 1.0 / USUAL_ORDER).max(1.0);
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

    /// All that there will be as long as there are details to look at.
    fn looked_at(&self) -> f64 {
        self.vertices + self.carriers * (self.growth() - 1.0)
    }

    /// Rounds of refinement to come.
    fn rounds(&self) -> f64 {
        if let Some(usual) = self.usual {
            return (ROUNDS + ROUNDS_FOR_DIRECT) * (2.0 * (usual - 1.0)).min(1.0);
        }
        let indirect = if self.growth() > 1.0 { ROUNDS } else { 0.0 };
        indirect + if self.more_for_direct > 0.0 { ROUNDS_FOR_DIRECT } else { 0.0 }
    }

    /// Those of them that direct light alone will take.
    fn more_for_direct(&self) -> f64 {
        match self.usual {
            Some(usual) => MORE_FOR_DIRECT * (usual - 1.0) * self.vertices,
            None => self.more_for_direct,
        }
    }

    /// All vertices that there will be.
    pub(crate) fn vertices_then(&self) -> f64 {
        self.looked_at() * self.smoothed + self.more_for_direct()
    }

    /// What all of it takes.
    pub(crate) fn left(&self, costs: &Costs) -> Left {
        let growth = self.growth();
        let carriers = self.carriers * growth;
        let vertices = self.vertices_then();
        let for_direct = self.more_for_direct();
        // Before anything was looked at.
        let is_blind = self.usual.is_some();
        // Where light is smooth, vertices between those that carry it are not looked at.
        let looked_at = if self.is_smooth { carriers } else { self.looked_at() };
        let look_s = if is_blind { costs.of_first(looked_at) } else { costs.of_looks(looked_at) };
        let smoothing_s = if self.is_smooth { costs.of_smoothing(vertices) } else { 0.0 };
        let smooth_now_s = if self.smoothed > 1.0 { smoothing_s } else { 0.0 };
        let pilot_s = smooth_now_s
            + costs.of_rays((carriers - self.gathered) * self.pilot_rays)
            + costs.direct.of(vertices - for_direct - self.measured)
            + costs.in_shadows(for_direct)
            + self.rounds() * look_s;
        let direct_s = costs.direct.of(self.measured_again * vertices);
        let (own, others) = (carriers * self.rays, self.check_rays + self.particles * growth);
        let each_s = costs.of_rays_then(own * (1.0 + SOLVED) + others + vertices * EVERY)
            + if self.measured_each { costs.again(vertices) } else { 0.0 };
        let looks = if self.is_smooth { carriers } else { vertices };
        let once_s = ONCE * costs.of_looks(looks)
            + FITTING * smoothing_s
            + costs.of_rays_then(carriers * self.rays.min(READERS.into()) + self.trials)
            + CHECKED * costs.direct.of(self.checks);
        let (in_all, factor) = match self.excess {
            None if is_blind => (MANY_IN_ALL, BLIND),
            None => (FEW_IN_ALL, BLIND_AMONG_FEW),
            Some(excess) if excess > 1.0 => (1.0, REFINING),
            Some(_) => (1.0, FIXED),
        };
        let time_s = pilot_s + direct_s + once_s + INCREMENTS * each_s;
        Left { time_s: in_all * time_s, factor }
    }
}

/// By how much errors exceed what they should be, and what that was with how many carriers a round ago, as
/// far as that is known.
pub(crate) type Excess = (Option<f64>, Option<(f64, f64)>);

/// Elements are as fine as they will be.
pub(crate) const FINE: Excess = (Some(1.0), None);

/// Is told of every round, and says whether there is time for another.
pub(crate) type GoOn<'g> = dyn FnMut(&Round) -> bool + 'g;

/// What a pilot has done, and what will come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    /// Vertices.
    pub(crate) receivers: usize,
    /// Rays traced.
    pub(crate) rays: u64,
    /// Vertices that there will be.
    pub(crate) receivers_then: f64,
    /// Time of the next step, which is made whole, s, as far as it measures direct light.
    pub(crate) step_s: f64,
    /// Time to the accuracy asked for.
    pub(crate) left: Left,
}
