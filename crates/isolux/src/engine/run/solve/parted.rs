//! Runs in parts: increments made apart, and maps from increments made elsewhere.

use super::super::increments::Work;
use super::super::part::RunPart;
use super::super::request::{SolveError, SolveRequest, Stage, Watch};
use super::super::state::{PilotState, RunIdentity, RunState};
use super::session::{End, Run};
use super::so_far::{Elsewhere, SoFar, Solution, Watcher};
use super::stages::{check, run_on};
use crate::engine::judge::energy_bound;
use crate::engine::light::Lighting;
use crate::engine::plan::Plan;
use crate::engine::ray::MAX_INCREMENTS;
use crate::map::Method;
use crate::scene::Scene;
use std::ops::Range;
use std::sync::Arc;

/// Computes a map as [`super::solve_looked_at`] does, from increments that are made elsewhere. The pilot and the audit
/// are made here.
pub fn solve_elsewhere(
    scene: &Scene,
    request: &SolveRequest,
    resume: Option<&RunState>,
    elsewhere: &mut Elsewhere<'_>,
    watch: &mut Watcher<'_>,
) -> Result<Solution, SolveError> {
    check_parts(scene, request)?;
    run_on(scene, request, resume, Some(elsewhere), watch)
}

/// The pilot of a run; `None` if it was stopped before its end.
pub fn make_pilot(
    scene: &Scene,
    request: &SolveRequest,
    watch: &mut Watcher<'_>,
) -> Result<Option<PilotState>, SolveError> {
    check_parts(scene, request)?;
    let lighting = Lighting::new(scene);
    let mut run = Run::new(scene, request);
    let plan = run.plan(&lighting, watch);
    Ok(plan.is_whole.then(|| run.pilot_state(&plan)))
}

/// Increments of a run, made apart from the others.
pub struct PartMaker<'w, 'p, 's> {
    work: Work<'p, 's>,
    run: Run<'s, 'w>,
}

/// Makes parts of a run on the mesh of a pilot. What all increments share is computed once, and given to `make`.
pub fn with_parts<T>(
    scene: &Scene,
    request: &SolveRequest,
    pilot: &PilotState,
    make: impl FnOnce(&mut PartMaker<'_, '_, '_>) -> T,
) -> Result<T, SolveError> {
    check_parts(scene, request)?;
    let lighting = Lighting::new(scene);
    let mut run = begun(scene, request, pilot)?;
    let plan = run.plan(&lighting, &mut |_, _| Watch::Continue);
    let work = Work::new(&plan, request, run.mesh_for(), 0);
    Ok(make(&mut PartMaker { work, run }))
}

/// The map of a run from all its increments so far, which are the first ones without a gap. It is audited like that of
/// a run that ends there. Without a pilot, the same one is made again.
pub fn solve_merged(
    scene: &Scene,
    request: &SolveRequest,
    pilot: Option<&PilotState>,
    part: &RunPart,
    watch: &mut Watcher<'_>,
) -> Result<Solution, SolveError> {
    check_parts(scene, request)?;
    RunIdentity::of(scene, request).check(&part.identity)?;
    if !part.is_sound() {
        return Err(SolveError::Unsound("the part"));
    }
    if part.complete_until().is_none() {
        return Err(SolveError::Missing(first_missing(part)));
    }
    let lighting = Arc::new(Lighting::new(scene));
    let mut run = match pilot {
        Some(pilot) => begun(scene, request, pilot)?,
        None => Run::new(scene, request),
    };
    if pilot.is_some_and(|pilot| pilot.stage != part.stage) {
        return Err(SolveError::OtherRun("the number of its mesh"));
    }
    (run.stage, run.saved_stage) = (part.stage, part.stage);
    run.lighting = Some(Arc::clone(&lighting));
    let plan = run.plan(&lighting, watch);
    run.merged(&plan, part)
}

/// The increments before the end of a part that it does not contain.
fn first_missing(part: &RunPart) -> Range<u64> {
    let ranges = part.ranges();
    let end = ranges.first().filter(|first| first.start == 0).map_or(0, |first| first.end);
    let next = ranges.iter().find(|range| range.start > end).map_or(end, |range| range.start);
    end..next
}

fn check_parts(scene: &Scene, request: &SolveRequest) -> Result<(), SolveError> {
    if request.method == Method::Radiosity {
        return Err(SolveError::Indivisible);
    }
    if !request.cache.samples.is_empty() {
        return Err(SolveError::StartsFromCache);
    }
    check(scene, request)
}

/// A run that begins with a pilot.
fn begun<'s, 'r>(
    scene: &'s Scene,
    request: &'r SolveRequest,
    pilot: &PilotState,
) -> Result<Run<'s, 'r>, SolveError> {
    let run = Run::new(scene, request);
    run.identity.check(&pilot.identity)?;
    pilot.check(scene)?;
    let (stage, saved_pilot) = (pilot.stage, Some(pilot.clone()));
    Ok(Run { stage, saved_pilot, saved_stage: stage, rays: pilot.rays, ..run })
}

impl PartMaker<'_, '_, '_> {
    /// Makes the increments of a range. If the watcher or the time limit stops the run, there are fewer, or none.
    pub fn make(&mut self, range: Range<u64>, watch: &mut Watcher<'_>) -> RunPart {
        let (run, work) = (&mut self.run, &mut self.work);
        let end = range.end.min(MAX_INCREMENTS);
        work.begin_at(range.start, end);
        let (identity, stage) = (run.identity.clone(), run.stage);
        let mut part = RunPart { identity, stage, segments: Vec::new() };
        let deadline = run.deadline(false);
        let mut next = range.start;
        let mut rays = 0;
        while next < end {
            let Some(traced) = work.increment(&deadline) else { break };
            (rays, next) = (rays + traced, next + 1);
            run.rays += traced;
            if next == end || next.is_power_of_two() {
                part.segments.push(work.take(rays));
                rays = 0;
            }
            let progress = run.progress(Stage::Increments, next, work.receivers(), None);
            let answer = watch(&progress, &SoFar::NOTHING);
            if run.heed(answer) == Watch::Stop || run.out_of_time() {
                break;
            }
        }
        if work.sums.increments > 0 {
            part.segments.push(work.take(rays));
        }
        part
    }
}

impl<'s> Run<'s, '_> {
    fn merged(mut self, plan: &Plan<'s>, part: &RunPart) -> Result<Solution, SolveError> {
        let mut work = Work::new(plan, self.request, self.mesh_for(), 0);
        for segment in &part.segments {
            work.add(segment)?;
            self.rays += segment.rays;
            self.note_noise_after(&work);
        }
        if let Some([mean_lx, allowed_lx]) = work.beyond_energy(&energy_bound::Allowed::of(plan)) {
            return Err(SolveError::MoreThanEnergy { mean_lx, allowed_lx });
        }
        let accuracy = work.accuracy();
        let end = self.audited_end(&work, accuracy);
        Ok(self.solution(&mut work, accuracy, end == Some(End::Reached), true))
    }
}
