//! A run in progress: its stages, its clock, and the end of its increments.

use super::super::increments::Work;
use super::super::prediction;
use super::super::request::{Prediction, Progress, SolveRequest, Stage, Watch};
use super::super::state::{
    Audited, MOST_STAGES, PilotState, RunIdentity, RunState, STAGES_TO_HALF,
};
use super::so_far::{SoFar, Solution, Watcher};
use crate::ablation::without;
use crate::engine::gather::Unlit;
use crate::engine::judge::BELIEVED_INCREMENTS;
use crate::engine::light::Lighting;
use crate::engine::method::IrradianceCache;
use crate::engine::pilot::{PilotRequest, Round, pilot};
use crate::engine::plan::Plan;
use crate::engine::ray::{Deadline, NEVER, Sums};
use crate::map::{Accuracy, Audit, IlluminationMap, Method, Provenance};
use crate::scene::Scene;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The share of the time limit after which elements are not refined further.
const PILOT_SHARE: f64 = 0.4;
/// The time that the first increment may take beyond the time limit, or beyond a request to stop, as a share of the time.
const GRACE_SHARE: f64 = 0.05;
/// The largest number of halvings of the rays of an increment, where time is short.
const MOST_HALVINGS: u32 = 8;
/// The least number of stages to advance, since the error of the elements is known with some noise.
pub(super) const FEWEST_STAGES: u32 = 2;
/// The error that finer elements are to have after too coarse ones, as a share of the accuracy goal. Noise needs the
/// rest.
const LEFT_TO_ELEMENTS: f64 = 0.8;
/// The relative accuracy that elements are made for if there is no goal.
const DEFAULT_ACCURACY: f64 = 0.01;

/// The error of elements after a number of further stages, as a share of the present error.
fn finer(stages: u32) -> f64 {
    libm::exp2(-f64::from(stages) / f64::from(STAGES_TO_HALF))
}

/// A run in progress.
pub(super) struct Run<'s, 'r> {
    pub(super) scene: &'s Scene,
    pub(super) request: &'r SolveRequest,
    pub(super) identity: RunIdentity,
    pub(super) started: Instant,
    pub(super) rays: u64,
    /// The part of `rays` that was traced before the first increment on the present elements.
    pub(super) rays_of_pilots: u64,
    /// The part of `rays` that an earlier run has traced.
    pub(super) earlier_rays: u64,
    /// Whether the watcher or the time limit has stopped the run.
    pub(super) stopped: bool,
    /// Whether elements, or the rays of an increment, were cut short for lack of time.
    pub(super) cut: bool,
    pub(super) stage: u32,
    /// The duration of the last pilot, s.
    pub(super) pilot_s: f64,
    /// The places that pilots have found unlit.
    pub(super) unlit: Arc<Unlit>,
    /// The stage of the saved run that this one continues; zero if there is none.
    pub(super) saved_stage: u32,
    /// The pilot of a saved run, in place of one of the same stage.
    pub(super) saved_pilot: Option<PilotState>,
    /// The luminaires, for audits; `None` if no map is made.
    pub(super) lighting: Option<Arc<Lighting<'s>>>,
    /// The results of the audits so far.
    pub(super) audited: Audited,
    /// Whether increments were added to elements that only the time limit has kept from being made finer.
    pub(super) stayed_coarse: bool,
    /// The audit of the present map.
    pub(super) audit: Option<Audit>,
}

impl<'s, 'r> Run<'s, 'r> {
    pub(super) fn new(scene: &'s Scene, request: &'r SolveRequest) -> Self {
        Self {
            scene,
            request,
            identity: RunIdentity::of(scene, request),
            started: Instant::now(),
            rays: 0,
            rays_of_pilots: 0,
            earlier_rays: 0,
            saved_pilot: None,
            stopped: false,
            cut: false,
            stage: 1,
            pilot_s: 0.0,
            unlit: Arc::default(),
            saved_stage: 0,
            lighting: None,
            audited: Audited::default(),
            stayed_coarse: false,
            audit: None,
        }
    }

    pub(super) fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// Subtracts the time for which the watcher has held up the run. Returns the watcher's answer.
    pub(super) fn heed(&mut self, answer: Watch) -> Watch {
        if let Watch::After(pause) = answer {
            self.started += pause;
        }
        answer
    }

    /// Whether the time limit is over, or somebody has asked to stop.
    pub(super) fn out_of_time(&self) -> bool {
        self.request.stop.is_raised()
            || self.request.time_limit.is_some_and(|limit| self.started.elapsed() >= limit)
    }

    /// The end of the time limit, or of a share of it. A request to stop ends the time, too.
    fn deadline_at(&self, share: f64) -> Deadline {
        // What no clock can count is no limit.
        let limit = self.request.time_limit.map(|limit| limit.as_secs_f64() * share);
        let limit = limit.and_then(|s| Duration::try_from_secs_f64(s).ok());
        let end = limit.and_then(|limit| self.started.checked_add(limit));
        Deadline { stop: Some(self.request.stop.clone()), ..Deadline::at(end) }
    }

    /// Prepares the luminaires: in time, or, for a run that goes on, as that run has.
    pub(super) fn prepare_luminaires(&mut self, goes_on: bool) -> Lighting<'s> {
        let end = if goes_on { NEVER.clone() } else { self.deadline_at(1.0) };
        let lighting = Lighting::prepared_until(self.scene, &end);
        // Another run would prepare them better.
        self.cut |= end.has_passed();
        lighting
    }

    /// The end of the time for an increment. The first one may go on for a while after the end: without it there is only
    /// the light of the pilot.
    pub(super) fn deadline(&self, is_first: bool) -> Deadline {
        let end = self.deadline_at(1.0);
        let grace = self.started.elapsed().mul_f64(GRACE_SHARE);
        if is_first { end.with_grace(grace) } else { end }
    }

    /// The end of the time for a pilot, or of a share of it. The elements of a saved run are always completed; otherwise
    /// its sums would be lost.
    fn end_of_pilot(&self, share: f64) -> Deadline {
        if self.stage == self.saved_stage { NEVER.clone() } else { self.deadline_at(share) }
    }

    /// Whether the time left is better spent on increments than on finer elements, the next of which take `step_s`.
    fn refined_long_enough(&self, step_s: f64) -> bool {
        let is_over =
            |limit: Duration| self.elapsed_s() + step_s >= PILOT_SHARE * limit.as_secs_f64();
        self.request.time_limit.is_some_and(is_over)
    }

    /// Whether finer elements would be complete within [`PILOT_SHARE`] of the time limit. The pilot's time grows with
    /// the number of elements, and their error falls with its inverse. Elements that are cut short are worse than the
    /// present ones.
    pub(super) fn has_time_for_finer(&self, work: &Work) -> bool {
        let Some(limit) = self.request.time_limit else { return true };
        let stages = self.stages_missing(work.error_of_elements());
        let pilot_s = self.pilot_s / finer(stages);
        self.elapsed_s() + pilot_s < PILOT_SHARE * limit.as_secs_f64()
    }

    /// The relative accuracy that the elements of this stage are made for.
    pub(super) fn mesh_for(&self) -> f64 {
        let target = self.request.accuracy.unwrap_or(DEFAULT_ACCURACY);
        target * finer(self.stage - 1)
    }

    pub(super) fn pilot_request(&self) -> PilotRequest {
        let by_hand = self.request.radiosity;
        PilotRequest {
            target: self.mesh_for(),
            goal: self.request.accuracy.unwrap_or(DEFAULT_ACCURACY),
            mesh_target: self.request.mesh_accuracy,
            seed: self.request.seed,
            is_fitted: self.request.method != Method::Forward,
            is_hybrid: self.request.method == Method::Hybrid,
            refines_caustics: self.request.method != Method::Radiosity
                && !without("caustic-refinement"),
            max_vertices: self.request.most_receivers(),
            most_for_indirect_light: by_hand.max_receivers.map(|most| most as usize),
            least_edge_m: by_hand.min_element_m,
            deadline: self.end_of_pilot(PILOT_SHARE),
            end: self.end_of_pilot(1.0),
        }
    }

    /// The result of a pilot, for other runs.
    pub(super) fn pilot_state(&self, plan: &Plan) -> PilotState {
        PilotState {
            identity: self.identity.clone(),
            stage: self.stage,
            rays: self.rays_of_pilots,
            result: plan.result.clone(),
        }
    }

    /// The plan of the present stage: a saved one, or that of a pilot.
    pub(super) fn plan(&mut self, lighting: &'s Lighting<'s>, watch: &mut Watcher<'_>) -> Plan<'s> {
        match self.saved_pilot.take_if(|saved| saved.stage == self.stage) {
            Some(PilotState { rays, result, .. }) => {
                self.rays_of_pilots = rays;
                self.unlit = Arc::clone(&result.unlit);
                Plan { scene: self.scene, lighting, result, end: self.end_of_pilot(1.0) }
            }
            None => self.pilot(lighting, watch),
        }
    }

    fn pilot(&mut self, lighting: &'s Lighting<'s>, watch: &mut Watcher<'_>) -> Plan<'s> {
        let request = self.pilot_request();
        let (before, started_s) = (self.rays, self.elapsed_s());
        let scene = self.scene;
        let unlit = Arc::clone(&self.unlit);
        let plan = pilot(scene, lighting, &request, &unlit, &mut |round| {
            self.rays = before + round.rays;
            let progress = self.progress(Stage::Pilot, 0, round.receivers as u64, None);
            let progress = Progress { prediction: self.foreseen(round), ..progress };
            // A watcher that has stopped the run is not called again.
            self.stopped = self.stopped
                || self.heed(watch(&progress, &SoFar::NOTHING)) == Watch::Stop
                || self.out_of_time();
            // The elements of a saved run are always completed; otherwise its sums would be lost.
            self.stage == self.saved_stage
                || !(self.stopped || self.refined_long_enough(round.step_s))
        });
        self.unlit = Arc::clone(&plan.unlit);
        self.cut |= !plan.is_whole;
        self.rays = before + plan.rays;
        self.rays_of_pilots = self.rays;
        self.pilot_s = self.elapsed_s() - started_s;
        plan
    }

    /// The finishing time predicted by the pilot, for a gathered map with an accuracy goal.
    pub(super) fn foreseen(&self, round: &Round) -> Option<Prediction> {
        let by_gathering = self.request.method == Method::Hybrid;
        self.request.accuracy.filter(|_| by_gathering)?;
        Some(prediction::foreseen(round.left, self.elapsed_s()))
    }

    pub(super) fn progress(
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
            unshot: None,
            target: self.request.accuracy,
            receivers,
            rays: self.rays,
            earlier_rays: self.earlier_rays,
            elapsed_s: self.elapsed_s(),
            prediction: None,
            ends: false,
        }
    }

    /// The reported error that is small enough: the accuracy goal, or less once an audit has found reported errors too
    /// small.
    pub(super) fn goal(&self) -> Option<f64> {
        self.request.accuracy.map(|goal| goal / self.audited.true_over_told)
    }

    /// The reported accuracy, with the error that audits have found where they contradict it. The excess counts as an
    /// error common to the whole map.
    pub(super) fn without_false_claims(&self, told: Accuracy) -> Accuracy {
        let found = match &self.audit {
            Some(audit) if audit.contradicts => audit.error.value,
            _ => told.reached * self.audited.true_over_told,
        };
        let beyond = (found * found - told.reached * told.reached).max(0.0);
        Accuracy {
            reached: found.max(told.reached),
            bias: (told.bias * told.bias + beyond).sqrt(),
            interpolated: (told.interpolated * told.interpolated + beyond).sqrt(),
            ..told
        }
    }

    /// Whether and why the increments end here.
    pub(super) fn end(&self, work: &Work, accuracy: Option<Accuracy>) -> Option<End> {
        let goal = self.goal();
        if work.may_end() && accuracy.zip(goal).is_some_and(|(a, goal)| a.reached <= goal) {
            return Some(End::Reached);
        }
        if work.is_vain(accuracy) {
            return Some(End::InVain);
        }
        if self.too_coarse(work, accuracy) && self.has_time_for_finer(work) {
            return Some(End::TooCoarse);
        }
        // More increments do not help where interpolation alone takes up the whole error.
        let vain = work.is_hopeless(accuracy, goal) && work.is_settled(accuracy);
        vain.then_some(End::InVain)
    }

    /// Whether finer elements will reach the goal, and the present ones will not.
    fn too_coarse(&self, work: &Work, accuracy: Option<Accuracy>) -> bool {
        let is_finest = self.stage == MOST_STAGES || work.plan.is_finest || without("finer-stages");
        let goal = self.goal().filter(|_| !is_finest);
        goal.is_some_and(|goal| work.is_too_coarse(accuracy, goal))
    }

    /// Whether only the time limit keeps the elements from being made finer.
    pub(super) fn lacks_time_for_finer(&self, work: &Work, accuracy: Option<Accuracy>) -> bool {
        self.too_coarse(work, accuracy) && !self.has_time_for_finer(work)
    }

    /// The number of further stages after which elements are fine enough, if their error falls in proportion.
    pub(super) fn stages_missing(&self, errs: Option<f64>) -> u32 {
        let missed = errs.zip(self.goal()).map_or(1.0, |(errs, goal)| errs / goal);
        let halvings = libm::log2(missed.max(LEFT_TO_ELEMENTS) / LEFT_TO_ELEMENTS);
        ((f64::from(STAGES_TO_HALF) * halvings).ceil() as u32).max(FEWEST_STAGES)
    }

    /// The increments with fewer rays each, if the time left is too short to know the error of the map. The run then
    /// counts as cut short, like one whose mesh is.
    pub(super) fn affordable<'p>(&mut self, mut work: Work<'p, 's>) -> Work<'p, 's> {
        let Some(limit) = self.request.time_limit.filter(|_| !self.out_of_time()) else {
            return work;
        };
        let Some(pace_s) = work.pace_s() else { return work };
        let left_s = (limit.as_secs_f64() - self.elapsed_s()).max(0.0);
        let too_slow = pace_s * BELIEVED_INCREMENTS as f64 / left_s;
        if too_slow <= 1.0 {
            return work;
        }
        self.cut = true;
        let halvings = libm::log2(too_slow).ceil().min(f64::from(MOST_HALVINGS));
        Work::new(work.plan, self.request, self.mesh_for(), halvings as u32)
    }

    /// Adds one increment. Returns `false` if the run is stopped or its time is over before. If it is over before the
    /// first increment, the map is that of the pilot, which no other run can continue.
    pub(super) fn advance(&mut self, work: &mut Work) -> bool {
        if self.stopped && work.sums.increments > 0 {
            return false;
        }
        let rays = work.increment(&self.deadline(work.sums.increments == 0));
        self.rays += rays.unwrap_or(0);
        if rays.is_none() {
            self.rest_on_pilot(work);
        }
        rays.is_some()
    }

    /// Takes the light of the pilot where there is no increment and no time for one. No other run continues from it.
    pub(super) fn rest_on_pilot(&mut self, work: &mut Work) {
        if work.sums.increments == 0 {
            self.cut = true;
            work.take_light_of_pilot();
        }
    }

    pub(super) fn report(
        &self,
        work: &Work,
        accuracy: Option<Accuracy>,
        pace: Pace,
        end: Option<End>,
    ) -> Progress {
        let count = work.sums.increments;
        let receivers = work.receivers();
        let progress = self.progress(Stage::Increments, count, receivers, accuracy);
        let goal = self.goal();
        let needed = goal.and_then(|goal| work.increments_needed(accuracy, goal));
        let made = count + work.ahead();
        // A run that has made no increment itself has not measured how long one takes.
        let prediction = needed.filter(|_| made > pace.before).map(|needed| {
            let each_s = (progress.elapsed_s - pace.started_s) / (made - pace.before) as f64;
            prediction::finish(needed, made, each_s, progress.elapsed_s)
        });
        let ends = end.is_some_and(|end| end != End::TooCoarse);
        let unshot = work.unshot().map(|unshot| unshot.share);
        Progress { prediction, ends, unshot, ..progress }
    }

    pub(super) fn solution(
        &self,
        work: &mut Work,
        accuracy: Option<Accuracy>,
        reached: bool,
        whole_mesh: bool,
    ) -> Solution {
        let state = self.state(whole_mesh.then_some(work));
        let time_s = self.elapsed_s();
        let cache = IrradianceCache { samples: work.made() };
        let lacked_time = self.lacks_time_for_finer(work, accuracy);
        Solution { map: self.map(work, accuracy, reached), state, cache, time_s, lacked_time }
    }

    /// The state with these sums, or without any. Sums over elements that were cut short are of no use to another run.
    pub(super) fn state(&self, sums: Option<&Work>) -> RunState {
        let some = |of: &dyn Fn(&Work) -> Vec<Sums>| sums.map_or(Vec::new(), of);
        RunState {
            identity: self.identity.clone(),
            stage: self.stage,
            rays: self.rays,
            increments: sums.map_or(0, |work| work.sums.increments),
            audited: self.audited.clone(),
            stayed_coarse: self.stayed_coarse,
            receivers: some(&|work| work.sums.sums.clone()),
            checks: some(&|work| work.checks.all()),
            given_up: some(&|work| work.given_up.sums.clone()),
            pilot: sums.map(|work| self.pilot_state(work.plan)),
        }
    }

    pub(super) fn map(
        &self,
        work: &Work,
        accuracy: Option<Accuracy>,
        reached: bool,
    ) -> IlluminationMap {
        let (values, filter) = work.values(self.request.filter && work.is_believed());
        let accuracy = accuracy.map(|told| self.without_false_claims(told));
        IlluminationMap {
            elements: work.plan.mesh.elements.clone(),
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
                fresh: work.fresh(),
                filter,
                unshot: work.unshot(),
                diffuse_only: self.request.radiosity.diffuse_only,
                audit: self.audit.clone(),
                mixed: Vec::new(),
            },
        }
    }
}

/// The reason why increments end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The accuracy goal is reached.
    Reached,
    /// Neither more increments nor finer elements would help.
    InVain,
    /// The elements are too coarse for the accuracy goal.
    TooCoarse,
    /// An audit has found the error larger than reported, and more increments would not correct this.
    Contradicted,
}

/// The start of the measurement of a run's pace: its time, and the number of increments before it.
#[derive(Clone, Copy)]
pub(super) struct Pace {
    pub(super) started_s: f64,
    pub(super) before: u64,
}
