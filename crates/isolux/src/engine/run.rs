//! A run: pilot, increments, stop, map.

use super::accumulate::{Accumulator, MAX_INCREMENTS, Sample, Sums};
use super::accuracy::{BELIEVED_INCREMENTS, accuracy};
use super::checks::{self, Check, InterpolationErrors};
use super::deadline::Deadline;
use super::direct::Lighting;
use super::emission::Emission;
use super::filter::filter;
use super::forward::Forward;
use super::hybrid::Hybrid;
use super::pilot::{FEWEST_RAYS, PilotRequest, Plan, pilot};
use super::predict;
use super::request::{Progress, SolveError, SolveRequest, Stage, Watch};
use super::state::{RunIdentity, RunState, restore};
use super::tally;
use crate::map::{Accuracy, FilterReport, Illuminance, IlluminationMap, Method, Provenance};
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use std::time::{Duration, Instant};

/// Increments before a run may stop at its accuracy: the estimates of single receivers need them.
const FEWEST_INCREMENTS: u64 = 16;
/// Share of the time limit after which elements are refined no further.
const PILOT_SHARE: f64 = 0.4;
/// Halvings of the rays of an increment at most, where time is short.
const MOST_HALVINGS: u32 = 8;
/// Meshes tried before a run settles for what it has.
const MOST_STAGES: u32 = 4;
/// Accuracy that elements are made for where none is asked.
const DEFAULT_ACCURACY: f64 = 0.01;
/// Memory of a vertex, bytes: the subdivision with its edges, the operator's entries at the fewest
/// rays, sums and values. Measured on rooms; rounded up.
const BYTES_A_VERTEX: u64 = 2400;

/// A map, and what it takes to go on with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The map.
    pub map: IlluminationMap,
    /// The run as it was when the map was made.
    pub state: RunState,
    /// Wall-clock time it took, s. Not part of the map, whose bits do not depend on the machine.
    pub time_s: f64,
}

/// Computes the illumination map of a scene, or goes on from a saved state.
///
/// `watch` is called after every round of the pilot and every increment and may stop the run; the
/// map is valid then, too. Everything but the moment of stopping depends only on the scene and the
/// request: a run that stops at its accuracy gives the same bits on any number of threads, stopped
/// and resumed or not.
pub fn solve(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    watch: &mut dyn FnMut(&Progress) -> Watch,
) -> Result<Solution, SolveError> {
    check(scene, request)?;
    let identity = RunIdentity::of(scene, request);
    if let Some(state) = resume {
        identity.check(&state.identity)?;
    }
    let resume = resume.filter(|state| state.increments > 0);
    let lighting = Lighting::new(scene);
    let started = Instant::now();
    let mut run = Run {
        scene,
        request,
        identity,
        started,
        rays: 0,
        stopped: false,
        cut: false,
        stage: 1,
        saved_stage: 0,
    };
    if let Some(state) = resume {
        run.stage = state.stage.clamp(1, MOST_STAGES);
        run.saved_stage = run.stage;
    }
    loop {
        let plan = run.pilot(&lighting, watch);
        let saved = resume.filter(|state| state.stage == run.stage);
        if let Outcome::Done(solution) = run.increments(&plan, saved, watch)? {
            return Ok(*solution);
        }
        run.stage += 1;
    }
}

/// What came of the increments on one mesh.
enum Outcome {
    Done(Box<Solution>),
    /// The elements are too coarse for the accuracy asked for.
    TooCoarse,
}

fn check(scene: &Scene, request: &SolveRequest) -> Result<(), SolveError> {
    if Emission::new(scene).is_none() {
        return Err(SolveError::NoLight);
    }
    let vertices = crate::elements::Subdivision::new(scene).vertex_count() as u64;
    if vertices == 0 {
        return Err(SolveError::NoReceiver);
    }
    let needed = vertices * BYTES_A_VERTEX;
    if needed > request.max_memory_bytes {
        return Err(SolveError::Memory { needed, allowed: request.max_memory_bytes });
    }
    Ok(())
}

struct Run<'s, 'r> {
    scene: &'s Scene,
    request: &'r SolveRequest,
    identity: RunIdentity,
    started: Instant,
    rays: u64,
    /// Stopped by the watcher or the clock before the mesh was complete.
    stopped: bool,
    /// Refinement ended before its goal, for lack of time.
    cut: bool,
    stage: u32,
    /// The stage that a saved run had come to; none is 0.
    saved_stage: u32,
}

impl<'s> Run<'s, '_> {
    fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn out_of_time(&self) -> bool {
        self.request.time_limit.is_some_and(|limit| self.started.elapsed() >= limit)
    }

    /// Whether what is left of the time is better spent on increments than on finer elements.
    fn refined_long_enough(&self) -> bool {
        let is_over = |limit: Duration| self.elapsed_s() >= PILOT_SHARE * limit.as_secs_f64();
        self.request.time_limit.is_some_and(is_over)
    }

    /// The accuracy that the elements of this stage are made for.
    fn mesh_for(&self) -> f64 {
        let target = self.request.accuracy.unwrap_or(DEFAULT_ACCURACY);
        target * libm::exp2(1.0 - f64::from(self.stage))
    }

    fn pilot(
        &mut self,
        lighting: &'s Lighting<'s>,
        watch: &mut dyn FnMut(&Progress) -> Watch,
    ) -> Plan<'s> {
        let request = PilotRequest {
            target: self.mesh_for(),
            mesh_target: self.request.mesh_accuracy,
            seed: self.request.seed,
            max_vertices: (self.request.max_memory_bytes / BYTES_A_VERTEX) as usize,
        };
        let before = self.rays;
        let scene = self.scene;
        let plan = pilot(scene, lighting, &request, &mut |receivers, rays| {
            self.rays = before + rays;
            let progress = self.progress(Stage::Pilot, 0, receivers as u64, None);
            // Who has said stop is not asked again.
            self.stopped = self.stopped || watch(&progress) == Watch::Stop || self.out_of_time();
            self.cut |= self.stage != self.saved_stage && self.refined_long_enough();
            // The elements of a saved run are made again, whole, or what it has would be lost.
            self.stage == self.saved_stage || !(self.stopped || self.cut)
        });
        self.rays = before + plan.rays;
        plan
    }

    fn progress(
        &self,
        stage: Stage,
        increments: u64,
        receivers: u64,
        accuracy: Option<Accuracy>,
    ) -> Progress {
        Progress {
            stage,
            increments,
            accuracy,
            target: self.request.accuracy,
            receivers,
            rays: self.rays,
            elapsed_s: self.elapsed_s(),
            prediction: None,
        }
    }

    /// Increments until the accuracy is reached, the time is up, or the watcher stops.
    fn increments(
        &mut self,
        plan: &Plan<'s>,
        saved: Option<&RunState>,
        watch: &mut dyn FnMut(&Progress) -> Watch,
    ) -> Result<Outcome, SolveError> {
        let mut work = Work::new(plan, self.request, self.mesh_for(), 0);
        if saved.is_none() {
            work = self.affordable(work);
        }
        if let Some(state) = saved {
            work.restore(state)?;
            self.rays = state.rays;
        }
        let pace = Pace { started_s: self.elapsed_s(), before: work.sums.increments };
        let whole_mesh = saved.is_some() || !(self.stopped || self.cut);
        loop {
            self.stopped |= !self.advance(&mut work);
            let accuracy = work.accuracy();
            let progress = self.report(&work, accuracy, pace);
            let count = work.sums.increments;
            let reached = count >= FEWEST_INCREMENTS
                && accuracy.zip(progress.target).is_some_and(|(a, goal)| a.reached <= goal);
            self.stopped |= watch(&progress) == Watch::Stop || self.out_of_time();
            let in_vain = work.is_vain(accuracy);
            let done = reached || in_vain || self.stopped || count >= MAX_INCREMENTS;
            // No number of increments helps where interpolation alone takes the whole error.
            let hopeless = self.is_hopeless(&work, accuracy);
            let finer = self.stage < MOST_STAGES && !self.refined_long_enough();
            if !done && hopeless && finer {
                return Ok(Outcome::TooCoarse);
            }
            if done || (hopeless && work.is_settled(accuracy)) {
                return Ok(Outcome::Done(Box::new(
                    self.solution(&work, accuracy, reached, whole_mesh),
                )));
            }
        }
    }

    /// The same with fewer rays an increment, if the time left is too short to know how good the map
    /// is: the mesh, too, is what the time allowed then.
    fn affordable<'p>(&mut self, work: Work<'p, 's>) -> Work<'p, 's> {
        let Some(limit) = self.request.time_limit else { return work };
        let Engine::Hybrid(hybrid) = &work.engine else { return work };
        let left_s = (limit.as_secs_f64() - self.elapsed_s()).max(0.0);
        let too_slow = hybrid.pace_s() * BELIEVED_INCREMENTS as f64 / left_s;
        if too_slow <= 1.0 {
            return work;
        }
        self.cut = true;
        let halvings = libm::log2(too_slow).ceil().min(f64::from(MOST_HALVINGS));
        Work::new(work.plan, self.request, self.mesh_for(), halvings as u32)
    }

    /// One more increment; false if the time is over before it is whole, and there is one already.
    fn advance(&mut self, work: &mut Work) -> bool {
        if self.stopped && work.sums.increments > 0 {
            return false;
        }
        let end = self.request.time_limit.and_then(|limit| self.started.checked_add(limit));
        let deadline = if work.sums.increments > 0 { Deadline(end) } else { Deadline::NEVER };
        let rays = work.increment(deadline);
        self.rays += rays.unwrap_or(0);
        rays.is_some()
    }

    fn report(&self, work: &Work, accuracy: Option<Accuracy>, pace: Pace) -> Progress {
        let count = work.sums.increments;
        let receivers = work.sums.sums.len() as u64;
        let progress = self.progress(Stage::Increments, count, receivers, accuracy);
        let needed = accuracy
            .zip(self.request.accuracy)
            .and_then(|(a, goal)| predict::increments_needed(&a, count, goal));
        let prediction = needed.map(|needed| {
            let needed = needed.max(FEWEST_INCREMENTS as f64);
            let each_s =
                (progress.elapsed_s - pace.started_s) / (count - pace.before).max(1) as f64;
            predict::finish(needed, count, each_s, progress.elapsed_s)
        });
        Progress { prediction, ..progress }
    }

    fn is_hopeless(&self, work: &Work, accuracy: Option<Accuracy>) -> bool {
        let count = work.sums.increments;
        let wanted = accuracy.zip(self.request.accuracy).filter(|_| count >= FEWEST_INCREMENTS);
        wanted.is_some_and(|(a, goal)| predict::increments_needed(&a, count, goal).is_none())
    }

    fn solution(
        &self,
        work: &Work,
        accuracy: Option<Accuracy>,
        reached: bool,
        whole_mesh: bool,
    ) -> Solution {
        let state = RunState {
            identity: self.identity.clone(),
            stage: self.stage,
            rays: self.rays,
            increments: if whole_mesh { work.sums.increments } else { 0 },
            receivers: if whole_mesh { work.sums.sums.clone() } else { Vec::new() },
            checks: if whole_mesh { work.checks.sums.sums.clone() } else { Vec::new() },
            given_up: if whole_mesh { work.given_up.sums.clone() } else { Vec::new() },
        };
        let time_s = self.elapsed_s();
        Solution { map: self.map(work, accuracy, reached), state, time_s }
    }

    fn map(&self, work: &Work, accuracy: Option<Accuracy>, reached: bool) -> IlluminationMap {
        let believed = work.sums.increments >= BELIEVED_INCREMENTS;
        let (values, filter) = work.values(self.request.filter && believed);
        IlluminationMap {
            elements: work.plan.elements.clone(),
            values,
            provenance: Provenance {
                scene: self.scene.name().to_owned(),
                scene_hash: self.identity.scene_hash.clone(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                method: self.request.method,
                seed: self.request.seed,
                increments: work.sums.increments,
                rays: self.rays,
                accuracy_target: self.request.accuracy,
                complete: reached || self.request.accuracy.is_none(),
                accuracy,
                filter,
            },
        }
    }
}

/// Since when, and since which increment, the pace of a run is taken.
#[derive(Clone, Copy)]
struct Pace {
    started_s: f64,
    before: u64,
}

/// The increments on one mesh.
struct Work<'p, 's> {
    plan: &'p Plan<'s>,
    engine: Engine<'p, 's>,
    sums: Accumulator,
    checks: Checks,
    /// What paths given up would bring in the mean.
    given_up: Accumulator,
    /// Gathering rays of the vertices in an increment.
    rays: Vec<u32>,
}

enum Engine<'p, 's> {
    Hybrid(Hybrid<'p, 's>),
    Forward(Forward<'p, 's>),
}

/// The points that the hybrid engine checks itself at.
struct Checks {
    points: Vec<Check>,
    sums: Accumulator,
}

impl<'p, 's> Work<'p, 's> {
    /// With the rays of an increment halved so many times.
    fn new(plan: &'p Plan<'s>, request: &SolveRequest, target: f64, halvings: u32) -> Self {
        let reference = plan.rms_lx;
        let most = gathering_rays(target, plan.indirect_vertices, request.max_memory_bytes);
        let most = (most >> halvings).max(1);
        let rays = plan.rays_of_vertices(most);
        let points = match request.method {
            Method::Hybrid => checks::draw(plan, most, Key::new(request.seed).with(3)),
            Method::Forward => Vec::new(),
        };
        let sums = Accumulator::new(plan.elements.vertices().len(), reference);
        let check_sums = Accumulator::new(points.len(), reference);
        let checks = Checks { points, sums: check_sums };
        let engine = match request.method {
            Method::Hybrid => {
                Engine::Hybrid(Hybrid::new(plan, &checks.points, &rays, request.seed))
            }
            Method::Forward => {
                let emission = Emission::new(plan.scene).expect("a scene without light is refused");
                Engine::Forward(Forward::new(plan, emission, request.seed))
            }
        };
        Self { plan, engine, sums, checks, given_up: Accumulator::new(1, reference), rays }
    }

    fn restore(&mut self, saved: &RunState) -> Result<(), SolveError> {
        restore(&mut self.sums, &saved.receivers, saved.increments)?;
        restore(&mut self.checks.sums, &saved.checks, saved.increments)?;
        restore(&mut self.given_up, &saved.given_up, saved.increments)
    }

    /// Adds one increment; returns the rays traced, or nothing if the deadline passes before.
    fn increment(&mut self, deadline: Deadline) -> Option<u64> {
        let index = self.sums.increments;
        let effort = match &self.engine {
            Engine::Hybrid(hybrid) => {
                let Checks { points, sums } = &mut self.checks;
                hybrid.increment(index, &mut self.sums, points, sums, deadline)?
            }
            Engine::Forward(forward) => forward.increment(index, &mut self.sums),
        };
        let direct = Rgb::grey(effort.given_up_lx);
        self.given_up.add(std::iter::once(Sample { direct, ..Sample::default() }));
        Some(effort.rays)
    }

    fn accuracy(&self) -> Option<Accuracy> {
        if self.sums.increments < BELIEVED_INCREMENTS {
            return None;
        }
        let interpolation = match self.engine {
            Engine::Hybrid(_) => checks::errors(&self.checks.sums, &self.checks.points),
            Engine::Forward(_) => tally::errors(self.plan, &self.sums),
        };
        let given_up_lx = self.given_up.estimate(0).mean.direct.luminance();
        let errors = InterpolationErrors { given_up_lx, ..interpolation };
        accuracy(self.plan, &self.sums, &errors)
    }

    /// Whether no number of increments will tell how good the map is: there is no light on it, or
    /// the light that was given up may be more than what is there.
    fn is_vain(&self, accuracy: Option<Accuracy>) -> bool {
        let dark = self.plan.rms_lx == 0.0;
        let given_up = self.given_up.sums != [Sums::default()];
        self.sums.increments >= FEWEST_INCREMENTS && accuracy.is_none() && (dark || given_up)
    }

    /// Whether more increments would change little: noise is a small part of the error.
    fn is_settled(&self, accuracy: Option<Accuracy>) -> bool {
        accuracy.is_some_and(|a| a.statistical <= 0.25 * libm::hypot(a.discretization, a.bias))
    }

    /// Samples of a vertex in an increment; finer vertices are interpolated from coarser ones.
    fn samples(&self, vertex: usize) -> u64 {
        u64::from(self.rays.get(vertex).copied().unwrap_or(FEWEST_RAYS))
    }

    /// The values of the map, and what the filter did to them.
    fn values(&self, filtered: bool) -> (Vec<Option<Illuminance>>, Option<FilterReport>) {
        let vertices = self.plan.known.len();
        let mut values: Vec<Option<Illuminance>> = (0..vertices).map(|k| self.value(k)).collect();
        let by_particles = matches!(self.engine, Engine::Forward(_));
        let report = filtered.then(|| self.filter(&mut values, by_particles));
        values.iter_mut().flatten().for_each(without_negative_light);
        (values, report)
    }

    /// Filters indirect light and caustics, and direct light where particles brought it.
    fn filter(&self, values: &mut [Option<Illuminance>], direct: bool) -> FilterReport {
        let coarse = self.plan.indirect_vertices;
        let part = |read: &dyn Fn(&Illuminance) -> Rgb| -> Vec<Rgb> {
            values[..coarse].iter().map(|v| v.as_ref().map_or(Rgb::BLACK, read)).collect()
        };
        let mut parts = vec![part(&|v| v.indirect_lx), part(&|v| v.caustic_lx)];
        if direct {
            parts.push(part(&|v| v.direct_lx - v.caustic_lx));
        }
        let variance: Vec<f64> = (0..coarse)
            .map(|k| self.sums.estimate(k))
            .map(|e| if direct { e.variance } else { e.indirect_variance })
            .collect();
        let filtered = filter(self.plan, &parts, &variance, self.plan.rms_lx);
        let fine: Vec<Vec<Rgb>> =
            filtered.values.iter().map(|part| self.plan.prolongate(part)).collect();
        for (k, value) in values.iter_mut().enumerate() {
            let Some(value) = value else { continue };
            let own_direct = value.direct_lx - value.caustic_lx;
            value.indirect_lx = fine[0][k];
            value.caustic_lx = fine[1][k];
            value.direct_lx = fine.get(2).map_or(own_direct, |part| part[k]) + value.caustic_lx;
        }
        filtered.report
    }

    fn value(&self, vertex: usize) -> Option<Illuminance> {
        if !self.plan.known[vertex] {
            return None;
        }
        let estimate = self.sums.estimate(vertex);
        let mean = estimate.mean;
        Some(Illuminance {
            direct_lx: mean.direct + mean.caustic,
            caustic_lx: mean.caustic,
            indirect_lx: mean.indirect,
            standard_error_lx: estimate.variance.sqrt(),
            indirect_standard_error_lx: estimate.indirect_variance.sqrt(),
            samples: self.sums.increments * self.samples(vertex),
        })
    }
}

/// Takes back what noise and overshooting deposits of particles have put below zero, so that the
/// total is not negative, with direct light afresh or without: it can only come nearer to the truth.
fn without_negative_light(value: &mut Illuminance) {
    let direct = value.direct_lx - value.caustic_lx;
    for k in 0..3 {
        let indirect = value.indirect_lx.0[k].max(0.0);
        let caustic = value.caustic_lx.0[k].max(-indirect);
        value.indirect_lx.0[k] = indirect;
        value.caustic_lx.0[k] = caustic;
        value.direct_lx.0[k] = direct.0[k].max(-(indirect + caustic)) + caustic;
    }
}

/// Gathering rays of a receiver and increment: so many that sixteen increments leave noise of about
/// a third of the accuracy in a plain room (where one ray spreads by a quarter of the light, and well
/// distributed ones do better), as far as memory allows; no more than a run can soon be stopped after.
fn gathering_rays(target: f64, vertices: usize, max_memory_bytes: u64) -> u32 {
    let wanted = ((0.32 / target.max(1e-6)) as u64).clamp(16, 256).next_power_of_two();
    // Half the memory may go to the operator, 40 bytes an entry, a fifth more for gloss.
    let most = (max_memory_bytes / 2 / 48 / vertices.max(1) as u64).max(8);
    let most = if most.is_power_of_two() { most } else { most.next_power_of_two() / 2 };
    wanted.min(most) as u32
}
