//! A run: pilot, increments, end, map.

mod audited;
mod parted;
mod session;
mod so_far;

use super::increments::Work;
use super::request::{BYTES_A_VERTEX, Foreseen, Progress, SolveError, SolveRequest, Watch};
use super::state::{RunIdentity, RunState};
use crate::engine::judge::energy_bound;
use crate::engine::light::{Emission, Lighting};
use crate::engine::pilot;
use crate::engine::plan::Plan;
use crate::engine::ray::MAX_INCREMENTS;
use crate::map::Method;
use crate::scene::Scene;
pub use parted::{Elsewhere, PartMaker, make_pilot, solve_elsewhere, solve_merged, with_parts};
use session::{End, FEWEST_STAGES, MOST_STAGES, Pace, Run};
pub use so_far::{SoFar, Solution, Watcher};
use std::mem;
use std::sync::Arc;
use std::time::Duration;

/// The time of a round of refinement, in that of the one before it, at most: each has more elements.
const NEXT_ROUND_RATIO: f64 = 2.0;

/// Computes the illumination map of a scene, or continues from a saved state.
///
/// `watch` is called after every round of the pilot and every increment. It may stop the run; the map is valid then,
/// too. Everything but the moment of stopping depends only on the scene and the request. A run that ends at its
/// accuracy gives the same bits on any number of threads, stopped and resumed or not.
pub fn solve(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    watch: &mut dyn FnMut(&Progress) -> Watch,
) -> Result<Solution, SolveError> {
    solve_looked_at(scene, request, resume, &mut |progress, _| watch(progress))
}

/// Predicts the size and time of a run from its pilot. The pilot ends before a round that would not be over after
/// `patience`, but not before its first survey.
pub fn foresee(
    scene: &Scene,
    request: &SolveRequest,
    patience: Duration,
) -> Result<Foreseen, SolveError> {
    check(scene, request)?;
    let run = Run::new(scene, request);
    let lighting = Lighting::new(scene);
    let mut seen = Foreseen { receivers: 0, finish: None };
    let mut last_s = 0.0;
    pilot::foresee(scene, &lighting, &run.pilot_request(), &mut |round| {
        seen =
            Foreseen { receivers: round.receivers_then.ceil() as u64, finish: run.foreseen(round) };
        let round_s = run.elapsed_s() - mem::replace(&mut last_s, run.elapsed_s());
        last_s + NEXT_ROUND_RATIO * round_s < patience.as_secs_f64()
    });
    Ok(seen)
}

/// Computes a map as [`solve`] does. The watcher may also ask for the map and the state so far.
pub fn solve_looked_at(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    watch: &mut Watcher<'_>,
) -> Result<Solution, SolveError> {
    check(scene, request)?;
    run_on(scene, request, resume, None, watch)
}

/// Runs from the pilot or a saved state to the map, with increments made here or elsewhere.
fn run_on(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    mut elsewhere: Option<&mut Elsewhere<'_>>,
    watch: &mut Watcher<'_>,
) -> Result<Solution, SolveError> {
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
        run.saved_pilot = state.pilot.clone();
    }
    let mut tried = None;
    // A run that is stopped while it makes finer elements returns its earlier map.
    let mut best: Option<Solution> = None;
    loop {
        let plan = run.plan(&lighting, watch);
        let saved = resume.filter(|state| state.stage == run.stage);
        // The same elements would be too coarse again. Samples of a cache, however, lie closer at every stage.
        if tried.replace(plan.size()) == Some(plan.size())
            && request.method != Method::Cache
            && run.stage < MOST_STAGES
            && plan.is_whole
        {
            run.stage = (run.stage + FEWEST_STAGES).min(MOST_STAGES);
            continue;
        }
        match run.increments(&plan, saved, elsewhere.as_deref_mut(), watch)? {
            Outcome::Done(solution) => return Ok(solution.or_better(best)),
            Outcome::TooCoarse(stages, solution) => {
                best = Some(solution.or_better(best));
                run.stage = (run.stage + stages).min(MOST_STAGES);
            }
        }
    }
}

/// The outcome of the increments on one mesh.
enum Outcome {
    /// The increments have ended with this solution.
    Done(Box<Solution>),
    /// The elements are too coarse for the accuracy goal: the number of stages to advance, and the solution so far.
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

impl<'s> Run<'s, '_> {
    /// Adds increments until the accuracy is reached, more would not help, the time is over, or the watcher stops.
    fn increments(
        &mut self,
        plan: &Plan<'s>,
        saved: Option<&RunState>,
        mut elsewhere: Option<&mut Elsewhere<'_>>,
        watch: &mut Watcher<'_>,
    ) -> Result<Outcome, SolveError> {
        let mut work = Work::new(plan, self.request, self.mesh_for(), 0);
        if saved.is_none() && elsewhere.is_none() {
            work = self.affordable(work);
        }
        if let Some(state) = saved {
            work.restore(state)?;
            self.earlier_rays = state.rays.saturating_sub(self.rays);
            self.rays = state.rays;
        }
        let pace = Pace { started_s: self.elapsed_s(), before: work.sums.increments };
        let allowed = energy_bound::Allowed::of(plan);
        // A saved run may have stopped where its increments end: that is judged before another increment is added.
        let mut is_judged = saved.is_none();
        loop {
            if mem::replace(&mut is_judged, true) {
                self.stopped |= !match &mut elsewhere {
                    Some(elsewhere) => self.take_from(elsewhere, &mut work)?,
                    None => self.advance(&mut work),
                };
            }
            let whole_mesh = saved.is_some() || !self.cut;
            if let Some([mean_lx, allowed_lx]) = work.beyond_energy(&allowed) {
                return Err(SolveError::MoreThanEnergy { mean_lx, allowed_lx });
            }
            let accuracy = work.accuracy();
            let end = self.audited_end(&work, accuracy);
            let progress = self.report(&work, accuracy, pace, end);
            let reached = end == Some(End::Reached);
            let so_far = SoFar {
                map: &|| Some(self.map(&work, accuracy, reached)),
                state: &|| (whole_mesh && !progress.ends).then(|| self.state(Some(&work))),
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
}
