//! A run of an engine as a user sees it: progress, interruption, and who can mend what went wrong.

use crate::elsewhere::Increments;
use crate::estimate::{Estimate, Survey};
use crate::failure::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::memory;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::progress::Reporter;
use crate::quantity::{show_seconds, show_share, significant};
use crate::reach;
use crate::saved_run::{self, Keeper};
use crate::serving::Live;
use crate::shown;
use crate::source;
use isolux::engine::{self, Progress, RunState, SoFar, Solution, SolveError, SolveRequest, Watch};
use isolux::map::{HotSpots, IlluminationMap, KnownSurface, Method};
use isolux::scene::Scene;
use std::path::Path;
use std::time::Duration;

/// A time limit passed by this factor is told.
const MUCH_LONGER: f64 = 1.25;

/// The lit share of the surface up to which the rest is told of.
const MOSTLY_DARK: f64 = 0.1;

/// What a run would need.
pub(crate) fn estimate(
    scene: &Scene,
    source: &Path,
    request: &SolveRequest,
) -> Result<Estimate, Failure> {
    Estimate::of(scene, request, Survey::Whole).map_err(|error| unsolvable(error, (scene, source)))
}

/// A solution and how its computation ended.
pub(crate) struct Solved {
    /// The map and the state of the run.
    pub solution: Solution,
    /// Done, stopped by a limit, or interrupted.
    pub outcome: Outcome,
    /// Why it was stopped, if its accuracy would have taken more than a day.
    pub beyond: Option<String>,
}

/// What is computed from what, and where it goes.
pub(crate) struct Run<'a> {
    /// The scene as the user named it.
    pub source: &'a Path,
    /// The map.
    pub output: &'a OutputPath,
    /// What is asked of the engine.
    pub request: &'a SolveRequest,
}

/// Computes a map, reports progress, and ends early at a signal.
pub(crate) fn solve(
    scene: &Scene,
    run: &Run,
    saved: Option<&RunState>,
    (reporter, mut live): (&mut Reporter, Option<&mut Live>),
) -> Result<Solved, Failure> {
    let mut keeper = Keeper::beside(run.output);
    let follower = Follower { reporter, keeper: Some(&mut keeper), live: live.as_deref_mut() };
    let solved = follow(scene, run.request, saved, follower, |error| failure(error, (scene, run)))?;
    // Nobody asks any more how a run ended that begins anew.
    if live.is_some_and(|live| live.begins_anew()) {
        return Ok(solved);
    }
    if let Some(why) = &solved.beyond {
        note(Note::Warning, why);
    }
    tell_of_bare_map(&solved.solution.map, run.request.mesh_accuracy);
    tell_of_hot_spots(&solved.solution.map);
    tell_of_dark_surface(&solved.solution.map);
    tell_of_time(&solved.solution, run.request.time_limit);
    tell_of_audit(&solved.solution.map);
    tell_of_end(&solved, run.request);
    Ok(solved)
}

/// Why a run has ended before its accuracy, unless somebody or the clock has stopped it; or reached it on a map without light.
pub(crate) fn tell_of_end(solved: &Solved, request: &SolveRequest) {
    let map = &solved.solution.map;
    let limit_s = request.time_limit.map_or(f64::INFINITY, |limit| limit.as_secs_f64());
    let is_dark = || map.values.iter().flatten().all(|value| value.illuminance_lx() == 0.0);
    let ends_itself = matches!(solved.outcome, Outcome::StoppedEarly)
        && request.radiosity.unshot.is_none()
        && solved.beyond.is_none()
        && solved.solution.time_s < limit_s
        && !map.provenance.audit.as_ref().is_some_and(|audit| audit.contradicts);
    let what = match (map.provenance.accuracy, request.accuracy) {
        (Some(_), _) if map.provenance.complete && is_dark() => {
            let what = "no light reaches any surface; `isolux check` names luminaires that light nothing";
            return note(Note::Warning, what);
        }
        (None, _) if ends_itself => {
            "the error of the map is not known: paths between mirrors, or surfaces that absorb almost nothing, were cut off, \
             and may have carried more light than all that reached a surface; `isolux check` names luminaires that \
             light nothing, and materials whose reflectance should be lower"
                .to_owned()
        }
        (Some(accuracy), Some(asked)) if ends_itself && accuracy.of_elements() > asked => format!(
            "stopped because more rays would not help: with {} receivers the error of interpolation alone is {}{}, \
             and {}{}",
            map.values.len(),
            show_share(accuracy.of_elements()),
            if 2.0 * accuracy.caustics.powi(2) > accuracy.of_elements().powi(2) {
                ", most of it in light that comes over glossy, mirroring or transparent surfaces"
            } else {
                ""
            },
            if 2 * map.values.len() > request.most_receivers() {
                "finer elements would need more than --max-memory: raise it, or ask for an accuracy no finer than that"
            } else if solved.solution.lacked_time {
                "finer elements would take longer than is left of --time-limit: allow more"
            } else {
                "finer elements did not reduce it; ask for an accuracy no finer than that"
            },
            if request.method == Method::Hybrid { "" } else { ", or use --method hybrid" }
        ),
        _ => return,
    };
    note(Note::Info, what);
}

/// A claim that was withdrawn.
fn tell_of_audit(map: &IlluminationMap) {
    let audit = map.provenance.audit.as_ref().filter(|audit| audit.contradicts);
    let Some(audit) = audit else { return };
    let [told, found] = [audit.told, audit.error.value].map(show_share);
    let surfaces = shown::names(audit.surfaces.iter().map(|of| of.shape.as_str()));
    let where_ = match audit.surfaces.is_empty() {
        true => String::new(),
        false => format!(", most of it on {surfaces}"),
    };
    note(
        Note::Warning,
        format!(
            "the error of the map is larger than reported: the audit finds {found} where {told} was \
             reported{where_}; `isolux audit` shows more"
        ),
    );
}

/// The least that makes a map may take longer than allowed.
fn tell_of_time(solution: &Solution, limit: Option<Duration>) {
    // The last of several groups may have had no time at all.
    let Some(limit_s) = limit.map(|limit| limit.as_secs_f64()).filter(|s| *s > 0.0) else {
        return;
    };
    if solution.time_s > MUCH_LONGER * limit_s && solution.map.provenance.increments <= 1 {
        note(
            Note::Info,
            format!(
                "the time limit of {} was exceeded: to prepare a map of {} receivers and estimate its light takes {} here",
                show_seconds(limit_s),
                solution.map.elements.vertices().len(),
                show_seconds(solution.time_s)
            ),
        );
    }
}

/// A map that reaches its accuracy may still show less than was hoped for in a viewer.
fn tell_of_bare_map(map: &IlluminationMap, hoped: f64) {
    let Some(accuracy) = map.provenance.accuracy.filter(|a| a.interpolated > hoped) else { return };
    let (found, hoped) = (show_share(accuracy.interpolated), show_share(hoped));
    note(
        Note::Info,
        format!(
            "the interpolated map, as viewers of the file see it, errs by {found}, more than the {hoped} of --mesh-accuracy: \
             shadows are finer than its elements; probe, grid and render evaluate direct light afresh"
        ),
    );
}

/// Errors are relative to the light of the whole scene, which may be on very little of it.
fn tell_of_hot_spots(map: &IlluminationMap) {
    let accuracy = map.provenance.accuracy;
    let Some(spots) = accuracy.and_then(|_| map.hot_spots()) else { return };
    let HotSpots { share, others_lx, others_m2, brightest: (at, lx) } = spots;
    note(
        Note::Info,
        format!(
            "{} of all light lies on a hundredth of the lit surface, up to {} lx at ({:.3}, {:.3}, {:.3}), and the error of \
             the scene is relative to that, too; on the other {} m2 that are lit the mean is {} lx, and errors are larger \
             relative to that; every reading has a standard error of its own: ask for a finer accuracy if those are too large",
            show_share(share),
            significant(lx, 3),
            at.x,
            at.y,
            at.z,
            significant(others_m2, 3),
            significant(others_lx, 3)
        ),
    );
}

/// Errors are relative to the root mean square over all of the surface, which wide ground without light makes small.
fn tell_of_dark_surface(map: &IlluminationMap) {
    let KnownSurface { all_m2, lit_m2 } = map.known_surface();
    if map.provenance.accuracy.is_none() || lit_m2 <= 0.0 || lit_m2 > MOSTLY_DARK * all_m2 {
        return;
    }
    let [lit, all] = [lit_m2, all_m2].map(|m2| significant(m2, 3));
    note(
        Note::Info,
        format!(
            "{lit} of {all} m2 of surface are lit: the error of the scene is relative to {} lx, the root mean square over \
             all of it, and is smaller relative to the light on the lit surface; leave out surfaces that get no light, or ask for less",
            significant(engine::reference_lx(map), 3)
        ),
    );
}

/// The same where the map goes nowhere: whoever ends what follows loses nothing.
pub(crate) fn solve_here(
    (scene, source): (&Scene, &Path),
    request: &SolveRequest,
) -> Result<Solved, Failure> {
    let follower = Follower { reporter: &mut Reporter::new(None), keeper: None, live: None };
    let solved = follow(scene, request, None, follower, |error| unsolvable(error, (scene, source)));
    Interrupt::install()?.has_nothing_more_to_keep();
    solved
}

/// Who is told of a run on the way.
struct Follower<'a, 'k> {
    reporter: &'a mut Reporter,
    keeper: Option<&'a mut Keeper<'k>>,
    live: Option<&'a mut Live>,
}

fn follow(
    scene: &Scene,
    request: &SolveRequest,
    saved: Option<&RunState>,
    Follower { reporter, mut keeper, mut live }: Follower<'_, '_>,
    failure: impl Fn(SolveError) -> Failure,
) -> Result<Solved, Failure> {
    let interrupt = Interrupt::install()?;
    let request = &SolveRequest { stop: interrupt.flag(), ..request.clone() };
    // Whoever gives a time limit, or watches, decides himself.
    let is_open = request.time_limit.is_none() && live.is_none();
    let mut beyond = None;
    let mut watch = |progress: &Progress, so_far: &SoFar<'_>| {
        reporter.show(progress);
        if let Some(keeper) = &mut keeper {
            keeper.look(so_far);
        }
        if is_open && beyond.is_none() {
            beyond = reach::beyond(progress);
        }
        let is_interrupted = || interrupt.is_requested();
        let wanted = live.as_mut().map(|live| live.look(progress, so_far, &is_interrupted));
        if is_interrupted() || beyond.is_some() {
            Watch::Stop
        } else {
            wanted.unwrap_or(Watch::Continue)
        }
    };
    let solved = match Increments::of_caller() {
        Some(mut increments) => engine::solve_elsewhere(
            scene,
            request,
            saved,
            &mut |pilot, increment| increments.next(scene, pilot, increment),
            &mut watch,
        ),
        None => engine::solve_looked_at(scene, request, saved, &mut watch),
    };
    reporter.finish();
    let solution = solved.map_err(failure)?;
    let is_stopped = interrupt.is_requested() || live.is_some_and(|live| live.is_stopped());
    let outcome = match (solution.map.provenance.complete, is_stopped) {
        (true, _) => Outcome::Done,
        (false, true) => Outcome::Interrupted,
        (false, false) => Outcome::StoppedEarly,
    };
    Ok(Solved { solution, outcome, beyond: beyond.filter(|_| outcome == Outcome::StoppedEarly) })
}

/// Sorted by who can mend it.
fn failure(error: SolveError, (scene, run): (&Scene, &Run)) -> Failure {
    match error {
        SolveError::OtherRun(what) => Failure::bad_input(format!(
            "{}: the saved run differs in {what}; repeat its flags, or solve without --resume",
            saved_run::path_beside(run.output.path()).display()
        )),
        other => unsolvable(other, (scene, run.source)),
    }
}

/// Why a scene cannot be solved.
pub(crate) fn unsolvable(error: SolveError, (scene, path): (&Scene, &Path)) -> Failure {
    let source = path.display();
    match error {
        SolveError::Memory { needed, allowed } => {
            let (what, remedy) = memory::of_triangles(needed, allowed);
            Failure::Refused(format!("{source}: {what}; {remedy}"))
        }
        SolveError::NoLight => source::no_light(path, scene),
        SolveError::NoReceiver => {
            let (what, remedy) = source::NO_MAP;
            Failure::bad_input(format!("{source}: {what}; {remedy}"))
        }
        other => Failure::bad_input(format!("{source}: {other}")),
    }
}
