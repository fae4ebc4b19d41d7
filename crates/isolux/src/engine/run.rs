//! A run: pilot, increments, stop, map.

mod audited;

use super::accumulate::{MAX_INCREMENTS, Sums};
use super::accuracy::BELIEVED_INCREMENTS;
use super::cache::IrradianceCache;
use super::deadline::Deadline;
use super::direct::Lighting;
use super::emission::Emission;
use super::energy;
use super::forecast::Round;
use super::hidden::Unlit;
use super::pilot::{self, PilotRequest, pilot};
use super::plan::Plan;
use super::predict;
use super::request::{
    BYTES_A_VERTEX, Foreseen, Prediction, Progress, SolveError, SolveRequest, Stage, Watch,
};
use super::state::{Audited, RunIdentity, RunState};
use super::work::Work;
use crate::map::{Accuracy, Audit, IlluminationMap, Method, Provenance};
use crate::scene::Scene;
use std::mem;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Share of the time limit after which elements are refined no further.
const PILOT_SHARE: f64 = 0.4;
/// Halvings of the rays of an increment at most, where time is short.
const MOST_HALVINGS: u32 = 8;
/// Stages to a factor of two in what their elements are made to err by.
const STAGES_TO_HALF: u32 = 4;
/// Stages at most, then a run settles for what it has: elements for an eighth of the error asked for.
const MOST_STAGES: u32 = 3 * STAGES_TO_HALF + 1;
/// Stages that elements are made finer by at least: what they err by is known with some noise.
const FEWEST_STAGES: u32 = 2;
/// What elements too coarse at first are to err by, as a share of the error asked for: noise needs the rest.
const LEFT_TO_ELEMENTS: f64 = 0.8;
/// Accuracy that elements are made for where none is asked.
const DEFAULT_ACCURACY: f64 = 0.01;

/// A map, and what it takes to go on with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The map.
    pub map: IlluminationMap,
    /// The run as it was when the map was made.
    pub state: RunState,
    /// The samples that the `cache` method has made, those that it started from left out; none if the run was
    /// stopped before they had all their replicates.
    pub cache: IrradianceCache,
    /// Wall-clock time it took, s. Not part of the map, whose bits do not depend on the machine.
    pub time_s: f64,
    /// Whether it was the time allowed that kept it from elements fine enough.
    pub lacked_time: bool,
}

impl Solution {
    /// Itself, unless it has not reached its goal and an earlier one is known to be nearer to the truth.
    fn or_better(self, before: Option<Self>) -> Self {
        let is_better = |before: &Self| before.map.knows_more_than(&self.map);
        let before = before.filter(|before| !self.map.provenance.complete && is_better(before));
        // The clock went on.
        let Self { time_s, lacked_time, .. } = self;
        before.map_or(self, |before| Self { time_s, lacked_time, ..before })
    }
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
    solve_looked_at(scene, request, resume, &mut |progress, _| watch(progress))
}

/// What a run would need, from as much of its pilot as there is patience for; one look at least.
pub fn foresee(
    scene: &Scene,
    request: &SolveRequest,
    patience: Duration,
) -> Result<Foreseen, SolveError> {
    check(scene, request)?;
    let run = Run::new(scene, request);
    let lighting = Lighting::new(scene);
    let mut seen = Foreseen { receivers: 0, finish: None };
    pilot::foresee(scene, &lighting, &run.pilot_request(), &mut |round| {
        seen =
            Foreseen { receivers: round.receivers_then.ceil() as u64, finish: run.foreseen(round) };
        run.elapsed_s() < patience.as_secs_f64()
    });
    Ok(seen)
}

/// What a run has come to, made for who asks.
pub struct SoFar<'a> {
    map: &'a dyn Fn() -> Option<IlluminationMap>,
    state: &'a dyn Fn() -> Option<RunState>,
}

impl SoFar<'_> {
    const NOTHING: Self = Self { map: &|| None, state: &|| None };

    /// The map as it is now; none while elements are being made.
    pub fn map(&self) -> Option<IlluminationMap> {
        (self.map)()
    }

    /// What it takes to go on from here, with the same flags to the same bits; none while there is nothing to go on from.
    pub fn state(&self) -> Option<RunState> {
        (self.state)()
    }
}

/// Who watches a run: sees its progress, may have what it has come to, and says how to go on.
pub type Watcher<'w> = dyn FnMut(&Progress, &SoFar<'_>) -> Watch + 'w;

/// As [`solve`], for a watcher that looks at maps on the way, or keeps states.
pub fn solve_looked_at(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    watch: &mut Watcher<'_>,
) -> Result<Solution, SolveError> {
    check(scene, request)?;
    if let Some(state) = resume {
        RunIdentity::of(scene, request).check(&state.identity)?;
    }
    let resume = resume.filter(|state| state.increments > 0);
    let lighting = Arc::new(Lighting::new(scene));
    let mut run = Run { lighting: Some(Arc::clone(&lighting)), ..Run::new(scene, request) };
    if let Some(state) = resume {
        run.audited = state.audited.clone();
        run.stage = state.stage.clamp(1, MOST_STAGES);
        run.saved_stage = run.stage;
    }
    let mut tried = None;
    // Who stops a run while finer elements are made has what was known before.
    let mut best: Option<Solution> = None;
    loop {
        let plan = run.pilot(&lighting, watch);
        let saved = resume.filter(|state| state.stage == run.stage);
        // Elements that were too coarse still are, if these are the same; samples of a cache lie closer at every stage.
        if tried.replace(plan.size()) == Some(plan.size())
            && request.method != Method::Cache
            && run.stage < MOST_STAGES
            && plan.is_whole
        {
            run.stage = (run.stage + FEWEST_STAGES).min(MOST_STAGES);
            continue;
        }
        match run.increments(&plan, saved, watch)? {
            Outcome::Done(solution) => return Ok(solution.or_better(best)),
            Outcome::TooCoarse(stages, solution) => {
                best = Some(solution.or_better(best));
                run.stage = (run.stage + stages).min(MOST_STAGES);
            }
        }
    }
}

/// What elements so many stages on err by, as a share.
fn finer(stages: u32) -> f64 {
    libm::exp2(-f64::from(stages) / f64::from(STAGES_TO_HALF))
}

/// What came of the increments on one mesh.
enum Outcome {
    Done(Box<Solution>),
    /// The elements are too coarse for the accuracy asked for: so many stages on they will do. What they have come to.
    TooCoarse(u32, Box<Solution>),
}

fn check(scene: &Scene, request: &SolveRequest) -> Result<(), SolveError> {
    if Emission::new(scene).is_none() {
        return Err(SolveError::NoLight);
    }
    let corners = crate::elements::first_corner_count(scene) as u64;
    if corners == 0 {
        return Err(SolveError::NoReceiver);
    }
    let allowed = request.max_memory_bytes;
    if corners * BYTES_A_VERTEX > allowed {
        let needed = crate::elements::first_vertex_count(scene) as u64 * BYTES_A_VERTEX;
        if needed > allowed {
            return Err(SolveError::Memory { needed, allowed });
        }
    }
    Ok(())
}

struct Run<'s, 'r> {
    scene: &'s Scene,
    request: &'r SolveRequest,
    identity: RunIdentity,
    started: Instant,
    rays: u64,
    /// Those of them that an earlier run has traced.
    earlier_rays: u64,
    /// Stopped by the watcher or the clock before the mesh was complete.
    stopped: bool,
    /// Refinement ended before its goal, for lack of time.
    cut: bool,
    stage: u32,
    /// What the last pilot has taken, s.
    pilot_s: f64,
    /// What pilots have found unlit.
    unlit: Unlit,
    /// The stage that a saved run had come to; none is 0.
    saved_stage: u32,
    /// For audits; none where there is no map to be made.
    lighting: Option<Arc<Lighting<'s>>>,
    /// What audits have come to.
    audited: Audited,
    /// The audit of the map as it is now.
    audit: Option<Audit>,
}

impl<'s, 'r> Run<'s, 'r> {
    fn new(scene: &'s Scene, request: &'r SolveRequest) -> Self {
        Self {
            scene,
            request,
            identity: RunIdentity::of(scene, request),
            started: Instant::now(),
            rays: 0,
            earlier_rays: 0,
            stopped: false,
            cut: false,
            stage: 1,
            pilot_s: 0.0,
            unlit: Unlit::default(),
            saved_stage: 0,
            lighting: None,
            audited: Audited::default(),
            audit: None,
        }
    }

    fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// Takes off what a watcher has held it up.
    fn heed(&mut self, answer: Watch) -> Watch {
        if let Watch::After(pause) = answer {
            self.started += pause;
        }
        answer
    }

    fn out_of_time(&self) -> bool {
        self.request.time_limit.is_some_and(|limit| self.started.elapsed() >= limit)
    }

    /// Whether what is left of the time is better spent on increments than on finer elements, the next of which take so long.
    fn refined_long_enough(&self, step_s: f64) -> bool {
        let is_over =
            |limit: Duration| self.elapsed_s() + step_s >= PILOT_SHARE * limit.as_secs_f64();
        self.request.time_limit.is_some_and(is_over)
    }

    /// Whether finer elements would be made before that: what the pilot had taken grows as the number of elements does, which fall in
    /// error like one over it. Elements that are cut short are worse than those there are.
    fn has_time_for_finer(&self, work: &Work) -> bool {
        let Some(limit) = self.request.time_limit else { return true };
        let stages = self.stages_missing(work.error_of_elements());
        let pilot_s = self.pilot_s / finer(stages);
        self.elapsed_s() + pilot_s < PILOT_SHARE * limit.as_secs_f64()
    }

    /// The accuracy that the elements of this stage are made for.
    fn mesh_for(&self) -> f64 {
        let target = self.request.accuracy.unwrap_or(DEFAULT_ACCURACY);
        target * finer(self.stage - 1)
    }

    fn pilot_request(&self) -> PilotRequest {
        let by_hand = self.request.radiosity;
        PilotRequest {
            target: self.mesh_for(),
            goal: self.request.accuracy.unwrap_or(DEFAULT_ACCURACY),
            mesh_target: self.request.mesh_accuracy,
            seed: self.request.seed,
            is_fitted: self.request.method != Method::Forward,
            has_means: self.request.method == Method::Hybrid,
            refines_caustics: self.request.method != Method::Radiosity,
            max_vertices: self.request.most_receivers(),
            most_for_indirect_light: by_hand.max_receivers.map(|most| most as usize),
            least_edge_m: by_hand.min_element_m,
        }
    }

    fn pilot(&mut self, lighting: &'s Lighting<'s>, watch: &mut Watcher<'_>) -> Plan<'s> {
        let request = self.pilot_request();
        let (before, started_s) = (self.rays, self.elapsed_s());
        let scene = self.scene;
        let mut unlit = mem::take(&mut self.unlit);
        let plan = pilot(scene, lighting, &request, &mut unlit, &mut |round| {
            self.rays = before + round.rays;
            let progress = self.progress(Stage::Pilot, 0, round.receivers as u64, None);
            let progress = Progress { prediction: self.foreseen(round), ..progress };
            // Who has said stop is not asked again.
            self.stopped = self.stopped
                || self.heed(watch(&progress, &SoFar::NOTHING)) == Watch::Stop
                || self.out_of_time();
            // The elements of a saved run are made again, whole, or what it has would be lost.
            self.stage == self.saved_stage
                || !(self.stopped || self.refined_long_enough(round.step_s))
        });
        self.unlit = unlit;
        self.cut |= !plan.is_whole;
        self.rays = before + plan.rays;
        self.pilot_s = self.elapsed_s() - started_s;
        plan
    }

    /// When the run will be done, seen from the pilot, if it has a goal.
    fn foreseen(&self, round: &Round) -> Option<Prediction> {
        let by_gathering = self.request.method == Method::Hybrid;
        self.request.accuracy.filter(|_| by_gathering)?;
        Some(predict::foreseen(round.left, self.elapsed_s()))
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

    /// Increments until the accuracy is reached, the time is up, or the watcher stops.
    fn increments(
        &mut self,
        plan: &Plan<'s>,
        saved: Option<&RunState>,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, SolveError> {
        let mut work = Work::new(plan, self.request, self.mesh_for(), 0);
        if saved.is_none() {
            work = self.affordable(work);
        }
        if let Some(state) = saved {
            work.restore(state)?;
            self.earlier_rays = state.rays.saturating_sub(self.rays);
            self.rays = state.rays;
        }
        let pace = Pace { started_s: self.elapsed_s(), before: work.sums.increments };
        let whole_mesh = saved.is_some() || !self.cut;
        let allowed = energy::Allowed::of(plan);
        loop {
            self.stopped |= !self.advance(&mut work);
            if let Some([mean_lx, allowed_lx]) = work.beyond_energy(&allowed) {
                return Err(SolveError::MoreThanEnergy { mean_lx, allowed_lx });
            }
            let accuracy = work.accuracy();
            let end = self.audited_end(&work, accuracy);
            let progress = self.report(&work, accuracy, pace, end);
            let reached = end == Some(End::Reached);
            let so_far = SoFar {
                map: &|| Some(self.map(&work, accuracy, reached)),
                state: &|| whole_mesh.then(|| self.state(Some(&work))),
            };
            let answer = watch(&progress, &so_far);
            self.heed(answer);
            self.stopped |= answer == Watch::Stop || self.out_of_time();
            let done = end.is_some_and(|end| end != End::TooCoarse && answer != Watch::Insist)
                || work.sums.increments >= MAX_INCREMENTS;
            if done || self.stopped {
                return Ok(Outcome::Done(Box::new(
                    self.solution(&mut work, accuracy, reached, whole_mesh),
                )));
            }
            if end == Some(End::TooCoarse) && answer != Watch::Insist {
                let stages = self.stages_missing(work.error_of_elements());
                let solution = self.solution(&mut work, accuracy, reached, whole_mesh);
                return Ok(Outcome::TooCoarse(stages, Box::new(solution)));
            }
        }
    }

    /// Whether and why these increments should end here.
    fn end(&self, work: &Work, accuracy: Option<Accuracy>) -> Option<End> {
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
        // No number of increments helps where interpolation alone takes the whole error.
        let vain = work.is_hopeless(accuracy, goal) && work.is_settled(accuracy);
        vain.then_some(End::InVain)
    }

    /// Whether finer elements will reach the goal, but these will not.
    fn too_coarse(&self, work: &Work, accuracy: Option<Accuracy>) -> bool {
        let is_finest = self.stage == MOST_STAGES || work.plan.is_finest;
        let goal = self.goal().filter(|_| !is_finest);
        goal.is_some_and(|goal| work.is_too_coarse(accuracy, goal))
    }

    /// How many stages on elements are fine enough, if they keep what they err by in proportion.
    fn stages_missing(&self, errs: Option<f64>) -> u32 {
        let missed = errs.zip(self.goal()).map_or(1.0, |(errs, goal)| errs / goal);
        let halvings = libm::log2(missed.max(LEFT_TO_ELEMENTS) / LEFT_TO_ELEMENTS);
        ((f64::from(STAGES_TO_HALF) * halvings).ceil() as u32).max(FEWEST_STAGES)
    }

    /// The same with fewer rays an increment, if the time left is too short to know how good the map
    /// is: the mesh, too, is what the time allowed then.
    fn affordable<'p>(&mut self, mut work: Work<'p, 's>) -> Work<'p, 's> {
        let Some(limit) = self.request.time_limit else { return work };
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

    /// One more increment; false if the time is over before it is whole, and there is one already.
    fn advance(&mut self, work: &mut Work) -> bool {
        if self.stopped && work.sums.increments > 0 {
            return false;
        }
        let end = self.request.time_limit.and_then(|limit| self.started.checked_add(limit));
        let rays = work.increment(Deadline(end));
        self.rays += rays.unwrap_or(0);
        rays.is_some()
    }

    fn report(
        &self,
        work: &Work,
        accuracy: Option<Accuracy>,
        pace: Pace,
        end: Option<End>,
    ) -> Progress {
        let count = work.sums.increments;
        let receivers = work.sums.sums.len() as u64;
        let progress = self.progress(Stage::Increments, count, receivers, accuracy);
        let goal = self.goal();
        let needed = goal.and_then(|goal| work.increments_needed(accuracy, goal));
        let made = count + work.ahead();
        // Who has made none here does not know what one takes.
        let prediction = needed.filter(|_| made > pace.before).map(|needed| {
            let each_s = (progress.elapsed_s - pace.started_s) / (made - pace.before) as f64;
            predict::finish(needed, made, each_s, progress.elapsed_s)
        });
        let ends = end.is_some_and(|end| end != End::TooCoarse);
        let unshot = work.unshot().map(|unshot| unshot.share);
        Progress { prediction, ends, unshot, ..progress }
    }

    fn solution(
        &self,
        work: &mut Work,
        accuracy: Option<Accuracy>,
        reached: bool,
        whole_mesh: bool,
    ) -> Solution {
        let state = self.state(whole_mesh.then_some(work));
        let time_s = self.elapsed_s();
        let cache = IrradianceCache { samples: work.made() };
        let lacked_time = self.too_coarse(work, accuracy) && !self.has_time_for_finer(work);
        Solution { map: self.map(work, accuracy, reached), state, cache, time_s, lacked_time }
    }

    /// With sums, or none: those of elements that were cut short are of no use to another run.
    fn state(&self, sums: Option<&Work>) -> RunState {
        let some = |of: &dyn Fn(&Work) -> Vec<Sums>| sums.map_or(Vec::new(), of);
        RunState {
            identity: self.identity.clone(),
            stage: self.stage,
            rays: self.rays,
            increments: sums.map_or(0, |work| work.sums.increments),
            audited: self.audited.clone(),
            receivers: some(&|work| work.sums.sums.clone()),
            checks: some(&|work| work.checks.all()),
            given_up: some(&|work| work.given_up.sums.clone()),
        }
    }

    fn map(&self, work: &Work, accuracy: Option<Accuracy>, reached: bool) -> IlluminationMap {
        let (values, filter) = work.values(self.request.filter && work.is_believed());
        let accuracy = accuracy.map(|told| self.without_false_claims(told));
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

/// Why increments end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// The accuracy asked for is reached.
    Reached,
    /// More of them would not help, and neither would finer elements.
    InVain,
    /// The elements are too coarse for the accuracy asked for.
    TooCoarse,
    /// An audit has found the error larger than it was told, and more of the same would not mend it.
    Contradicted,
}

/// Since when, and since which increment, the pace of a run is taken.
#[derive(Clone, Copy)]
struct Pace {
    started_s: f64,
    before: u64,
}
