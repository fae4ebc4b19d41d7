//! The loop of a run: pilot and increments, on finer elements where the first ones turn out too coarse.

use super::super::increments::Work;
use super::super::request::{BYTES_A_VERTEX, SolveError, SolveRequest, Watch};
use super::super::state::{MOST_STAGES, RunIdentity, RunState};
use super::session::{End, FEWEST_STAGES, Pace, Run};
use super::so_far::{Elsewhere, SoFar, Solution, Watcher};
use crate::engine::judge::energy_bound;
use crate::engine::light::Emission;
use crate::engine::plan::Plan;
use crate::engine::ray::MAX_INCREMENTS;
use crate::map::Method;
use crate::scene::Scene;
use std::mem;
use std::sync::Arc;

/// Runs from the pilot or a saved state to the map, with increments made here or elsewhere.
pub(super) fn run_on(
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
    let mut run = Run::new(scene, request);
    let lighting = Arc::new(run.prepare_luminaires(resume.is_some()));
    run.lighting = Some(Arc::clone(&lighting));
    if let Some(state) = resume {
        run.audited = state.audited.clone();
        run.stayed_coarse = state.stayed_coarse;
        run.stage = state.stage.clamp(1, MOST_STAGES);
        run.saved_stage = run.stage;
        run.saved_pilot = match &state.pilot {
            Some(pilot) if pilot.stage == run.stage => {
                RunIdentity::of(scene, request).check(&pilot.identity)?;
                pilot.check(scene)?;
                state.pilot.clone()
            }
            _ => None,
        };
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

/// Checks that there is light, something that it falls on, and memory for a map.
pub(super) fn check(scene: &Scene, request: &SolveRequest) -> Result<(), SolveError> {
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
            let accuracy = work.accuracy();
            // A few rays may bring any light: before the error is known, nothing can be said.
            let beyond = accuracy.and_then(|_| work.beyond_energy(&allowed));
            if let Some([mean_lx, allowed_lx]) = beyond {
                return Err(SolveError::MoreThanEnergy { mean_lx, allowed_lx });
            }
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
            self.stayed_coarse |= self.lacks_time_for_finer(&work, accuracy);
        }
    }

    /// Adds the next increments, which are made elsewhere. Returns `false` if the run is stopped there. If it is
    /// stopped before the first increment, the map is that of the pilot.
    pub(super) fn take_from(
        &mut self,
        elsewhere: &mut Elsewhere<'_>,
        work: &mut Work,
    ) -> Result<bool, SolveError> {
        let count = work.sums.increments;
        if self.stopped && count > 0 {
            return Ok(false);
        }
        let part = match work.is_prepared() {
            true => elsewhere(&self.pilot_state(work.plan), count)?,
            false => None,
        };
        let Some(part) = part else {
            self.rest_on_pilot(work);
            return Ok(false);
        };
        self.identity.check(&part.identity)?;
        if part.stage != self.stage || !part.is_sound() {
            return Err(SolveError::Unsound("the part"));
        }
        let ranges = part.ranges();
        if ranges.len() != 1 || ranges[0].start != count {
            return Err(SolveError::Missing(count..count + 1));
        }
        for segment in &part.segments {
            work.add(segment)?;
            self.rays += segment.rays;
            self.note_noise_after(work);
        }
        Ok(true)
    }

    /// Notes the noise at a number of increments where it is kept.
    pub(super) fn note_noise_after(&mut self, work: &Work) {
        if work.sums.increments.is_power_of_two() {
            self.note_noise(work, work.accuracy());
        }
    }
}
