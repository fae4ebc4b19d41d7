//! A run: pilot, increments, end, map.

mod audited;
mod parted;
mod session;
mod so_far;
mod stages;

use super::request::{Foreseen, Progress, SolveError, SolveRequest, Watch};
use super::state::RunState;
use crate::engine::light::Lighting;
use crate::engine::pilot::{self, PilotRequest};
use crate::engine::ray::Deadline;
use crate::scene::Scene;
pub use parted::{PartMaker, make_pilot, solve_elsewhere, solve_merged, with_parts};
use session::Run;
pub use so_far::{Elsewhere, SoFar, Solution, Watcher};
use stages::{check, run_on};
use std::mem;
use std::time::{Duration, Instant};

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
/// `patience`, but not before its first survey, unless that takes longer than `at_most`.
pub fn foresee(
    scene: &Scene,
    request: &SolveRequest,
    patience: Duration,
    at_most: Option<Duration>,
) -> Result<Foreseen, SolveError> {
    check(scene, request)?;
    let run = Run::new(scene, request);
    let mut pilot_request = run.pilot_request();
    if let Some(at_most) = at_most {
        let end = Deadline::at(Instant::now().checked_add(at_most));
        pilot_request = PilotRequest { deadline: end.clone(), end, ..pilot_request };
    }
    let lighting = Lighting::prepared_until(scene, &pilot_request.end);
    let (mut then, mut finish, mut last_s) = (None, None, 0.0);
    let receivers_so_far = pilot::foresee(scene, &lighting, &pilot_request, &mut |round| {
        then = Some(round.receivers_then.ceil() as u64);
        finish = run.foreseen(round);
        let round_s = run.elapsed_s() - mem::replace(&mut last_s, run.elapsed_s());
        last_s + NEXT_ROUND_RATIO * round_s < patience.as_secs_f64()
    });
    Ok(Foreseen { receivers: then, receivers_so_far: receivers_so_far as u64, finish })
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
