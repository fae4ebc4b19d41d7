//! `hybrid`: direct light exact, indirect light by final gathering with a shared fixed point, caustics by
//! particles.
//!
//! An increment is an independent replicate on the elements that the pilot has fixed: it has its own random
//! rays, operator and fixed point. Replicates share nothing random, so their spread gives the error of their
//! mean.

use super::caustics::{self, Caustics};
use crate::ablation::without;
use crate::engine::gather::{
    DirectAtEnds, DirectResidual, FEWEST_UNJUDGED, Gatherer, Gathering, NET_ORDER, Operator, allot,
    allot_by_noise, mean_of, ray_trial,
};
use crate::engine::judge::{BELIEVED_INCREMENTS, Check, DirectThere, FEWEST_TO_MISS, check_points};
use crate::engine::mesh::LeafError;
use crate::engine::plan::Plan;
use crate::engine::ray::{Deadline, Dice, Effort, Sample};
use crate::map::Standing;
use crate::sampling::{Key, Sequence};
use crate::units::Rgb;
use rayon::prelude::*;
use std::collections::VecDeque;
use std::time::Instant;

/// The largest change in the last sweep of the fixed point after all its reflections, as a share of the
/// accuracy goal. All increments start from one guess, so a remainder of it does not average out.
const UNSETTLED: f64 = 0.03;
/// The coarsest accuracy that this share is taken of. Where the control variate removes noise, the remainder
/// of the guess would else exceed all noise.
const COARSEST: f64 = 0.01;
/// The least absorptance assumed for that bound.
const LEAST_ABSORBED: f64 = 1e-3;

/// The most rays that increments made ahead have together.
const RAYS_AHEAD: u64 = 1 << 19;

/// The number of rays per vertex that measure the error which readings have in common.
pub(crate) const READERS: u32 = 16;
/// The divisor of the memory limit of rays per vertex that gives the limit of these rays.
const OF_READERS: u32 = 4;
/// The number of passes that average over the elements about each vertex.
const SMOOTHINGS: u32 = 4;

/// The number of rays per receiver from which a trial looks for noisy receivers.
const WORTH_TRYING: f64 = 32.0;
/// The number of rays in all from which a trial looks for noisy receivers.
const WORTH_TRYING_ANY: f64 = 262_144.0;
/// The largest number of rays of a receiver in a trial for noisy receivers.
const RAYS_TRIED: u32 = 8;
/// The number of receivers in the first round of that trial.
const TRIED_FIRST: usize = 1024;
/// The factor on the number of receivers from round to round.
const TRIED_NEXT: usize = 4;
/// The ratio of measured to expected noise from which sharing rays anew pays: the run would not end in time.
const MORE_THAN_THOUGHT: f64 = 1.5;
/// The largest power of two that the rays are multiplied by if the trial shows more noise than expected. They
/// are never fewer: noise inside housings of lamps is passed on to others, so receivers alone show too little
/// of it.
const MORE: f64 = 4.0;

/// One receiver in this many is timed for the duration of an increment.
const TRIED: usize = 64;

/// The method, ready for increments.
pub(crate) struct Hybrid<'p, 's> {
    plan: &'p Plan<'s>,
    check_direct: DirectThere,
    /// The number of rays of each vertex of indirect light.
    rays: Vec<u32>,
    /// The number of rays of each vertex that gathers for the stored map.
    rays_for_bare: u32,
    /// The check points, then the vertices that gather for the bare map.
    fresh_rows: Vec<Gatherer>,
    /// A few rays of every vertex, the same in all increments; `None` before the first one.
    reader: Option<Operator>,
    /// The number of these rays.
    readers: u32,
    /// The vertices of the elements that indirect light lives on.
    corners: Vec<[u32; 3]>,
    /// The residual of direct light between vertices, where rays read direct light.
    kept: Option<DirectResidual>,
    /// The number of particles for caustics per increment.
    particles: u32,
    /// The accuracy goal of the increments.
    goal: f64,
    key: Key,
    /// The increments made ahead, in order.
    ahead: VecDeque<Increment>,
    /// The number of the increment to end before.
    end: u64,
}

/// The size of an increment, and the accuracy goal that it serves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IncrementSize {
    /// The mean number of gathering rays of a visible vertex, before halving.
    pub(crate) rays: f64,
    /// The number of times that the rays are halved.
    pub(crate) halvings: u32,
    /// The number of particles for caustics.
    pub(crate) particles: u32,
    /// The relative accuracy goal.
    pub(crate) goal: f64,
}

/// The result of an increment.
pub(crate) struct Increment {
    /// The light at the vertices.
    pub(crate) receivers: Vec<Sample>,
    /// The samples for the sums of the check points.
    pub(crate) checks: Vec<Sample>,
    /// The caustics that the map lacks in parts of elements, lx.
    pub(crate) lacking: Vec<f64>,
    pub(crate) effort: Effort,
}

impl<'p, 's> Hybrid<'p, 's> {
    /// The method with increments of a size. Memory allows `most` rays per vertex.
    pub(crate) fn new(
        plan: &'p Plan<'s>,
        checks: &[Check],
        size: IncrementSize,
        most: u32,
        seed: u64,
    ) -> Self {
        let IncrementSize { rays, halvings, particles, goal } = size;
        let key = Key::new(seed).with(1);
        let rays = rays / f64::from(1_u32 << halvings);
        let areas_m2 = plan.areas_m2();
        let allotted = allot(&areas_m2, rays);
        let fewest = FEWEST_UNJUDGED >> halvings;
        let own = |vertex: usize| {
            let own = allotted[vertex];
            let needs_more = own > 0 && plan.mesh.gatherers[vertex].behind.is_none();
            if needs_more { own.max(fewest) } else { own }
        };
        let own: Vec<u32> = (0..plan.mesh.indirect_vertices).map(own).collect();
        let own = if is_worth_trying(own.len(), rays) && !without("noise-sharing") {
            shared_by_noise(plan, own, &areas_m2, (rays, most), key.with(u64::MAX - 1))
        } else {
            own
        };
        let check_direct = check_points::direct(plan, checks, goal, (key.with(0), &plan.end));
        let rays_for_bare = (libm::exp2(libm::round(libm::log2(rays))) as u32).max(fewest);
        let for_bare = plan.mesh.gathering_for_bare.iter();
        let for_bare = for_bare.map(|&v| plan.mesh.gatherers[v as usize].with_rays(rays_for_bare));
        let fresh_rows = checks.iter().map(|check| check.gatherer).chain(for_bare).collect();
        let over = plan.over(&plan.light.direct);
        let kept = DirectResidual::of(
            &over,
            goal * plan.light.reference_lx,
            (key.with(u64::MAX - 2), &plan.end),
        );
        let ahead = VecDeque::new();
        let readers = READERS.min((most / OF_READERS).max(1));
        let corners = |error: &LeafError| plan.mesh.subdivision.node(error.node).0.vertices;
        let corners = plan.errors.of_elements.iter().map(corners).collect();
        Self {
            plan,
            check_direct,
            rays: own,
            rays_for_bare,
            fresh_rows,
            reader: None,
            readers,
            corners,
            kept,
            particles,
            goal,
            key,
            ahead,
            end: u64::MAX,
        }
    }

    /// The variance of direct light in readings that all increments have in common, lx2.
    pub(crate) const fn noise_of_direct_lx2(&self) -> f64 {
        self.check_direct.noise_lx2
    }

    /// The approximate duration of an increment, s, from a part of its receivers.
    pub(crate) fn pace_s(&self) -> f64 {
        let started = Instant::now();
        let lighting = self.plan.lighting;
        let rows: Vec<Gatherer> = self.rows().step_by(TRIED).collect();
        let gathering = Gathering::of(self.plan, &self.plan.light.direct);
        gathering.operator(&rows, |row| self.key.with(0).with(row as u64));
        if !lighting.is_measured_once() {
            let key = self.key.with(0).with(1);
            let all: Vec<_> = self.plan.mesh.gatherers.iter().step_by(TRIED).collect();
            all.par_iter().enumerate().for_each(|(k, gatherer)| {
                let mut dice = Dice::new(Sequence::new(key.with(k as u64)), 0);
                lighting.illuminance(&gatherer.surface, &mut dice);
            });
        }
        started.elapsed().as_secs_f64() * TRIED as f64
    }

    /// The number of rays of a vertex in an increment; zero where it does not gather.
    pub(crate) fn rays_of(&self, vertex: usize) -> u32 {
        let is_for_bare =
            || self.plan.mesh.gathering_for_bare.binary_search(&(vertex as u32)).is_ok();
        let beyond = || if is_for_bare() { self.rays_for_bare } else { 0 };
        self.rays.get(vertex).copied().unwrap_or_else(beyond)
    }

    fn rows(&self) -> impl Iterator<Item = Gatherer> + '_ {
        self.rays.iter().enumerate().map(|(vertex, &rays)| row(self.plan, vertex, rays))
    }

    /// Increment `index`; `None` if the deadline passes meanwhile. Small increments that will be needed
    /// anyway are made beside it, if they are complete by then. One small increment alone would leave threads
    /// idle.
    pub(crate) fn increment(
        &mut self,
        index: u64,
        checks: &[Check],
        deadline: &Deadline,
    ) -> Option<Increment> {
        if self.reader.is_none() {
            let with = (self.readers, self.key.with(u64::MAX));
            self.reader = Some(reader(self.plan, &self.rays, with, deadline)?);
        }
        if self.ahead.is_empty() {
            let next = (index + 1).next_multiple_of(FEWEST_TO_MISS);
            let is_ahead = next <= BELIEVED_INCREMENTS && !without("increments-ahead");
            let until = if is_ahead { next.min(self.end) } else { index + 1 };
            let rays = self.rays.iter().chain(self.fresh_rows.iter().map(|row| &row.rays));
            let rays = rays.map(|&of| u64::from(of)).sum::<u64>() + u64::from(self.particles);
            let count = (until - index).min((RAYS_AHEAD / rays.max(1)).max(1)) as usize;
            let one = |k: usize| self.made(index + k as u64, checks, deadline);
            let made: Vec<_> = (0..count).into_par_iter().with_max_len(1).map(one).collect();
            self.ahead.extend(made.into_iter().map_while(|increment| increment));
        }
        self.ahead.pop_front()
    }

    /// Begins anew at some increment, to end before another.
    pub(crate) fn begin_at(&mut self, end: u64) {
        self.ahead.clear();
        self.end = end;
    }

    /// The number of increments made ahead.
    pub(crate) fn ahead(&self) -> u64 {
        self.ahead.len() as u64
    }

    fn made(&self, index: u64, checks: &[Check], deadline: &Deadline) -> Option<Increment> {
        let plan = self.plan;
        let key = self.key.with(1 + index);
        let (direct, check_direct) =
            direct_light(plan, (&self.check_direct, checks), key.with(0), deadline)?;
        let Caustics { light: caustic, means: reflected_on, lacking, effort: particles } =
            caustics::deposit(plan, self.particles, key.with(1), deadline)?;
        let kept = self.kept.as_ref();
        let kept = match kept {
            Some(kept) => Some(kept.read(&plan.over(&direct), (1, key.with(6)), deadline)?),
            None => None,
        };
        let at_ends = kept.as_ref().map_or(&direct, |kept| &kept.values);
        let gathering = Gathering::of(plan, at_ends);
        let rows = (self.rays.len(), |vertex: usize| row(plan, vertex, self.rays[vertex]));
        let operator =
            gathering.operator_until(deadline, rows, |row| key.with(2).with(row as u64))?;
        let absorbed = (1.0 - plan.light.mean_reflectance).max(LEAST_ABSORBED);
        let tolerance = UNSETTLED * self.goal.min(COARSEST) * absorbed;
        let (gathered, unsettled_lx) = operator.solve_or_give_up(
            &plan.light.guess,
            &reflected_on,
            (&plan.mesh.waiting, Some(&plan.mesh.fit)),
            (tolerance, deadline),
        );
        if deadline.has_passed() {
            return None;
        }
        let gathered = plan.mesh.fit.apply(&gathered);
        let light: Vec<Rgb> = gathered.iter().zip(&reflected_on).map(|(&e, &c)| e + c).collect();
        let passed_on = self.passed_on(&light);
        // Check points gather as readers do.
        let gathering = Gathering { regathers: true, ..gathering };
        let rows = (self.fresh_rows.len(), |k: usize| self.fresh_rows[k]);
        let fresh = gathering.operator_until(deadline, rows, |row| key.with(3).with(row as u64))?;
        let fresh_light = fresh.apply(&light);
        let (fresh_light, for_bare) = fresh_light.split_at(checks.len());
        let indirect = plan.prolongate_beside(&gathered, for_bare);
        let caustic = plan.prolongate(&caustic);
        let map = [direct.as_slice(), &caustic, &indirect];
        let checks = check_points::samples(checks, (fresh_light, &check_direct), map, None);
        let vertex = |k: usize| {
            let passed_on = passed_on[k];
            Sample { direct: direct[k], caustic: caustic[k], indirect: indirect[k], passed_on }
        };
        let receivers = (0..direct.len()).map(vertex).collect();
        // Rays given up are taken to have seen the mean light.
        let unseen_lx = operator.given_up() * plan.light.reference_lx;
        let effort = Effort {
            rays: operator.rays + fresh.rays + particles.rays,
            given_up_lx: particles.given_up_lx + unseen_lx + unsettled_lx,
        };
        Some(Increment { receivers, checks, lacking, effort })
    }

    /// The light of an increment that fixed rays read at the vertices. Its variation between increments is
    /// the error that all readings of their mean share nearby. Means over the elements about every vertex
    /// even out the views of few rays.
    fn passed_on(&self, light: &[Rgb]) -> Vec<f64> {
        let plan = self.plan;
        let reader = self.reader.as_ref().expect("made before the first increment");
        let mut passed_on = reader.reflected(light);
        plan.mesh.waiting.fill(&mut passed_on);
        let mut passed_on: Vec<f64> = passed_on.iter().map(|light| light.luminance()).collect();
        for _ in 0..SMOOTHINGS {
            let mut sums = vec![(0.0, 0.0); passed_on.len()];
            for element in &self.corners {
                let mean = element.iter().map(|&v| passed_on[v as usize]).sum::<f64>() / 3.0;
                for &vertex in element {
                    let (sum, count) = &mut sums[vertex as usize];
                    *sum += mean;
                    *count += 1.0;
                }
            }
            for (passed_on, (sum, count)) in passed_on.iter_mut().zip(sums) {
                if count > 0.0 {
                    *passed_on = sum / count;
                }
            }
        }
        let passed_on: Vec<Rgb> = passed_on.into_iter().map(Rgb::grey).collect();
        plan.prolongate(&passed_on).iter().map(|light| light.luminance()).collect()
    }
}

/// Whether a trial for noisy receivers pays.
fn is_worth_trying(rows: usize, rays: f64) -> bool {
    rays >= WORTH_TRYING || rays * rows as f64 >= WORTH_TRYING_ANY
}

/// The number of rays of that trial.
pub(crate) fn rays_tried(rows: usize, rays: f64) -> f64 {
    let tried = if is_worth_trying(rows, rays) { rows.min(TRIED_FIRST) } else { 0 };
    (tried as u32 * RAYS_TRIED * ray_trial::INCREMENTS as u32).into()
}

/// The receivers, with rays shared anew where some are far noisier than others, as inside housings of lamps.
/// They change only if there is more noise than the pilot expected and sharing leaves much less. If the
/// remaining noise is still more than expected, the total number of rays grows. A receiver has `rays` rays in
/// the mean; memory allows `most`.
fn shared_by_noise(
    plan: &Plan,
    own: Vec<u32>,
    areas_m2: &[f64],
    (rays, most): (f64, u32),
    key: Key,
) -> Vec<u32> {
    let gathering = Gathering::of(plan, &plan.light.direct);
    let thought_lx = plan.tried.trial.noise_lx(rays);
    let of_one = libm::pow(f64::from(RAYS_TRIED), NET_ORDER);
    let shared = |every: usize| {
        let some = || own.iter().copied().enumerate().step_by(every);
        let tried: Vec<Gatherer> =
            some().map(|(vertex, own)| row(plan, vertex, own.min(RAYS_TRIED))).collect();
        let with = (plan.light.reference_lx, key);
        let (variances_lx2, _) =
            ray_trial::variances_lx2(&gathering, &tried, &plan.light.guess, with);
        let areas_m2: Vec<f64> = areas_m2.iter().step_by(every).copied().collect();
        let rays: Vec<u32> = some().map(|(_, own)| own).collect();
        allot_by_noise(&areas_m2, &variances_lx2, &rays)
            .filter(|shared| of_one * shared.before_lx > MORE_THAN_THOUGHT * thought_lx)
    };
    // The trial grows step by step while the receivers tried so far show that sharing may pay.
    let mut every = own.len().div_ceil(TRIED_FIRST).max(1);
    let mut found = shared(every);
    while every > 1 && found.is_some() {
        every = (every / TRIED_NEXT).max(1);
        found = shared(every);
    }
    let Some(shared) = found else { return own };
    let wanted = libm::log2(of_one * shared.left_lx / thought_lx) / NET_ORDER;
    let allowed = libm::log2(f64::from(most) / mean_of(&shared.rays)).floor();
    let steps = wanted.round().min(MORE).min(allowed).max(0.0);
    let with = |(own, rays): (u32, u32)| {
        let rays = (f64::from(rays) * libm::exp2(steps)) as u32;
        rays.max(own.min(FEWEST_UNJUDGED))
    };
    own.into_iter().zip(shared.rays).map(with).collect()
}

/// The gatherer of a vertex of indirect light, with a number of rays.
fn row(plan: &Plan, vertex: usize, rays: u32) -> Gatherer {
    let in_gap = plan.mesh.standings[vertex] != Some(Standing::Open);
    plan.mesh.gatherers[vertex].with_rays(rays).in_gap(in_gap)
}

/// A few rays of every vertex that read indirect light alone; `None` if the deadline passes.
fn reader(
    plan: &Plan,
    own: &[u32],
    (rays, key): (u32, Key),
    deadline: &Deadline,
) -> Option<Operator> {
    let dark = vec![Rgb::BLACK; plan.mesh.elements.vertices().len()];
    let direct = DirectAtEnds::Read { values: &dark, level: u32::MAX };
    let gathering = Gathering { direct, ..Gathering::of(plan, &plan.light.direct) };
    let few = (own.len(), |vertex: usize| row(plan, vertex, own[vertex].min(rays)));
    gathering.operator_until(deadline, few, |row| key.with(row as u64))
}

/// The direct light of an increment at vertices and check points; that of the plan if it is measured once.
/// `None` if the deadline passes.
pub(crate) fn direct_light(
    plan: &Plan,
    (check_direct, checks): (&DirectThere, &[Check]),
    key: Key,
    deadline: &Deadline,
) -> Option<(Vec<Rgb>, Vec<Rgb>)> {
    if plan.lighting.is_measured_once() {
        return Some((plan.light.direct.clone(), check_direct.lx.clone()));
    }
    let vertex = |(k, gatherer): (usize, &Gatherer)| {
        let mut dice = Dice::new(Sequence::new(key.with(k as u64)), 0);
        let light = || plan.lighting.illuminance(&gatherer.surface, &mut dice);
        (!deadline.has_passed()).then(light)
    };
    let vertices: Option<Vec<Rgb>> =
        plan.mesh.gatherers.par_iter().enumerate().map(vertex).collect();
    let vertices = vertices?;
    let at_checks = check_direct.again(plan, checks, key.with(u64::MAX), deadline);
    (!deadline.has_passed()).then_some((vertices, at_checks))
}
