//! `--resume`: the state of a run beside its map.

use crate::failure::Failure;
use crate::map_file;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::part_files;
use crate::source::bad_file;
use isolux::engine::{RunIdentity, RunState, SoFar, SolveRequest};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::checkpoint;
use isolux_formats::{Problem, Problems, atomic};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A run is kept as often as this, unless that took more than one part in so many of its time.
const KEPT_AFTER: Duration = Duration::from_secs(2);
const KEEPING: u32 = 100;

/// Where the state of a map's run is kept.
pub(crate) fn path_beside(map: &Path) -> PathBuf {
    map.with_extension("checkpoint")
}

/// Where the result of its pilot is kept, once for all states on the same mesh. `MAP.pilot` may be one that was asked for.
fn pilot_beside(map: &Path) -> PathBuf {
    map.with_extension("checkpoint.pilot")
}

/// Keeps the state of an unfinished run, and removes that of a finished one.
pub(crate) fn keep(output: &OutputPath, state: &RunState, finished: bool) -> Result<(), Failure> {
    if finished {
        remove(&path_beside(output.path()))?;
        remove(&pilot_beside(output.path()))
    } else {
        // It could be written when it was checked: what keeps it from it now is the machine.
        write(output, state).map_err(|problem| Failure::Refused(problem.to_string()))?;
        if let Some(pilot) = &state.pilot {
            part_files::write_pilot(&pilot_beside(output.path()), pilot)
                .map_err(|problem| Failure::Refused(problem.to_string()))?;
        }
        Ok(())
    }
}

/// Removes a file; there may be none.
fn remove(path: &Path) -> Result<(), Failure> {
    std::fs::remove_file(path).or_else(|e| match e.kind() {
        std::io::ErrorKind::NotFound => Ok(()),
        _ => Err(Failure::Refused(format!("{}: cannot be removed ({e})", path.display()))),
    })
}

fn write(output: &OutputPath, state: &RunState) -> Result<(), Problem> {
    checkpoint::write(&path_beside(output.path()), &checkpoint::of_state(state))
}

/// Keeps the state of a run on the way, so that hours of work do not end with the machine.
pub(crate) struct Keeper<'a> {
    output: &'a OutputPath,
    due: Instant,
    /// The number of the mesh whose pilot is kept, zero for none.
    stage: u32,
}

impl<'a> Keeper<'a> {
    /// Beside a map.
    pub(crate) fn beside(output: &'a OutputPath) -> Self {
        Self { output, due: Instant::now() + KEPT_AFTER, stage: 0 }
    }

    /// Keeps what a run has come to, if it is time for it. Who cannot be kept goes on.
    pub(crate) fn look(&mut self, so_far: &SoFar) {
        let started = Instant::now();
        let Some(state) = (started >= self.due).then(|| so_far.state()).flatten() else { return };
        let mut written = write(self.output, &state);
        if let (Some(pilot), Ok(())) =
            (state.pilot.filter(|pilot| pilot.stage != self.stage), &written)
        {
            self.stage = pilot.stage;
            written = part_files::write_pilot(&pilot_beside(self.output.path()), &pilot);
        }
        if let Err(problem) = written {
            note(Note::Warning, problem);
        }
        self.due = Instant::now() + KEPT_AFTER.max(KEEPING * started.elapsed());
    }
}

/// The map that the saved run came to, if it is complete: what followed, as the baking of a lightmap, was not.
pub(crate) fn complete_map(
    saved: &RunState,
    output: &OutputPath,
    (scene, request): (&Scene, &SolveRequest),
) -> Option<IlluminationMap> {
    if !saved.is_of(scene, request) || !output.path().exists() {
        return None;
    }
    let (_, map) = map_file::read(output.path()).ok()?;
    let RunIdentity { scene_hash, version, method, seed, accuracy, .. } = &saved.identity;
    let from = &map.provenance;
    // An older map with other flags may still be there.
    let is_of_run = from.scene_hash == *scene_hash
        && from.version == *version
        && from.method == *method
        && from.seed == *seed
        && from.accuracy_target == *accuracy
        && (from.increments, from.rays) == (saved.increments, saved.rays)
        && (request.filter || from.filter.is_none());
    (from.complete && is_of_run).then_some(map)
}

/// Reads the state of an unfinished run; `None` where there is none.
pub(crate) fn read(output: &OutputPath, max_bytes: u64) -> Result<Option<RunState>, Failure> {
    let path = path_beside(output.path());
    if !path.exists() {
        let text = format!("{}: no such run to resume; solving from the beginning", path.display());
        note(Note::Info, text);
        return Ok(None);
    }
    let remedy = "remove it and solve from the beginning";
    let checkpoint = part_files::whole(&path, max_bytes, remedy)?;
    let state = checkpoint::state(&checkpoint)
        .map_err(|what| bad_file(Problems::from(Problem::new(&path, "", what, remedy))))?;
    if state.stayed_coarse {
        let what = "for lack of time this run went on with coarser elements, so its map will differ within its error \
                    from that of a run without --time-limit; for the same bytes solve without --resume";
        note(Note::Info, format!("{}: {what}", path.display()));
    }
    let path = pilot_beside(output.path());
    let pilot = match path.exists() {
        true => Some(part_files::read_kept_pilot(&path, max_bytes)?),
        false => None,
    };
    // One of an earlier mesh was not replaced yet: the pilot is made again.
    let pilot = pilot.filter(|of| of.stage == state.stage && of.identity == state.identity);
    Ok(Some(RunState { pilot, ..state }))
}

/// Fails before computing where the state could not be written.
pub(crate) fn check_writable(output: &OutputPath) -> Result<(), Failure> {
    atomic::check_writable(&path_beside(output.path())).map_err(|p| bad_file(Problems::from(p)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::engine::{SolveRequest, Watch, solve, solve_looked_at};

    #[test]
    fn a_run_is_kept_on_the_way_once_it_is_due() {
        let home = tempfile::tempdir().unwrap();
        let output = OutputPath::check(&home.path().join("map.glb"), "glb").unwrap();
        let scene = crate::source::read_scene(Path::new("builtin:cube")).unwrap();
        let request = SolveRequest { accuracy: Some(0.05), ..SolveRequest::default() };
        let mut keeper = Keeper { output: &output, due: Instant::now(), stage: 0 };
        let whole = solve_looked_at(&scene, &request, None, &mut |_, so_far| {
            keeper.look(so_far);
            Watch::Continue
        });
        // The first increment was due, and the last one leaves nothing to go on from.
        let kept = read(&output, u64::MAX).unwrap().unwrap();
        let whole = whole.unwrap();
        assert!((1..whole.map.provenance.increments).contains(&kept.increments));
        let resumed = solve(&scene, &request, Some(&kept), &mut |_| Watch::Continue);
        assert_eq!(resumed.unwrap().map, whole.map);
    }
}
