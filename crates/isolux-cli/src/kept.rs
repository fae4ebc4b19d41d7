//! A map is replaced by one of the same run only if that knows more, unless the user solves from the beginning.

use crate::failure::{Failure, Outcome};
use crate::map_file;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::quantity::show_share;
use crate::saved_run;
use crate::solving::{Run, Solved};
use isolux::engine::RunState;
use isolux::map::{IlluminationMap, Provenance};
use isolux::scene::Scene;
use isolux_formats::{counted, map_glb};
use serde::Serialize;

/// What is told of a map that was not kept.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct LessKnown {
    accuracy_reached: Option<f64>,
    increments: u64,
    rays: u64,
    receivers: usize,
}

impl LessKnown {
    fn of(map: &IlluminationMap) -> Self {
        let Provenance { accuracy, increments, rays, .. } = map.provenance;
        let accuracy_reached = accuracy.map(|accuracy| accuracy.reached);
        Self { accuracy_reached, increments, rays, receivers: map.values.len() }
    }

    fn text(&self) -> String {
        format!(
            "an error {}, {} of {} receivers",
            self.accuracy_reached.map_or("that is not known".to_owned(), |error| format!(
                "of {}",
                show_share(error)
            )),
            counted(self.increments, "increment", "increments"),
            self.receivers
        )
    }
}

/// Writes the map of a run, or keeps that of an earlier one which a resumed run has not come to; the solution then holds that,
/// and what the run has come to is told. Where a run was not resumed its map is written, and it is said what was better known before.
pub(crate) fn write(
    (scene, run): (&Scene, &Run),
    solved: &mut Solved,
    is_resumed: bool,
) -> Result<Option<LessKnown>, Failure> {
    let (found, output) = (&solved.solution.map, run.output);
    let better = better_known(run, found).map(|map| (LessKnown::of(found), map));
    let path = output.path().display();
    let less = match better {
        Some((less, map)) if is_resumed => {
            let text = format!(
                "{path}: kept, because the result of this run is less accurate ({}, for {}): allow more time",
                less.text(),
                LessKnown::of(&map).text()
            );
            note(Note::Warning, text);
            solved.solution.map = map;
            Some(less)
        }
        Some((less, map)) => {
            let text = format!(
                "{path}: was more accurate before ({}, for {}); with --resume a map is replaced only by a more accurate one",
                LessKnown::of(&map).text(),
                less.text()
            );
            note(Note::Warning, text);
            None
        }
        None => None,
    };
    map_file::write(output, scene, &solved.solution.map)?;
    Ok(less)
}

/// The map that is there, if it is of the same run and knows more than one that was stopped.
fn better_known(run: &Run, found: &IlluminationMap) -> Option<IlluminationMap> {
    let path = run.output.path();
    if found.provenance.complete || !path.exists() || !map_glb::is_map(path) {
        return None;
    }
    let (_, there) = map_glb::read(path).ok()?.value;
    let (from, of) = (&there.provenance, &found.provenance);
    // One that is not believed yet was not filtered, though it would be.
    let is_alike = is_of_same_run(from, of) && (run.request.filter || from.filter.is_none());
    (is_alike && there.knows_more_than(found)).then_some(there)
}

/// As far as maps tell of which run they are.
fn is_of_same_run(there: &Provenance, found: &Provenance) -> bool {
    let of = |p: &Provenance| (p.method, p.seed, p.accuracy_target, p.diffuse_only);
    there.scene_hash == found.scene_hash
        && there.version == found.version
        && of(there) == of(found)
        && there.mixed.is_empty()
}

/// Whether the state of a run is to be kept after its map was written or found no room: that of one that was stopped even then.
/// One that is done goes on from the state of before, to the same map.
pub(crate) fn with_map(written: &Result<Option<LessKnown>, Failure>, outcome: Outcome) -> bool {
    written.is_ok() || outcome != Outcome::Done
}

/// Keeps the state of a run. One with nothing to go on from replaces none of a resumed run that has.
pub(crate) fn keep_state(
    output: &OutputPath,
    (state, saved): (&RunState, Option<&RunState>),
    finished: bool,
) -> Result<(), Failure> {
    let has_less = state.increments == 0 && saved.is_some_and(|saved| saved.increments > 0);
    if has_less && !finished { Ok(()) } else { saved_run::keep(output, state, finished) }
}
