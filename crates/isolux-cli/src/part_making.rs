//! Parts of runs for a caller, as bytes.

use crate::failure::Failure;
use crate::request;
use crate::solving::unsolvable;
use isolux::engine::{Progress, SoFar, SolveError, Watch, with_parts};
use isolux::scene::Scene;
use isolux_formats::checkpoint::{self, Part};
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Makes the parts (as files `.part`) with the increments of ranges.
pub type Make<'m> = dyn FnMut(Range<u64>) -> Vec<u8> + 'm;

/// Makes parts of the run that a pilot (a file `.pilot`) belongs to. What all increments share is computed once, and given to `serve`.
/// `stops` ends a part early: it then holds fewer increments, or none.
pub(crate) fn make_parts<T>(
    (scene, name): (&Scene, &Path),
    pilot: &[u8],
    stops: &AtomicBool,
    serve: impl FnOnce(&mut Make<'_>) -> T,
) -> Result<T, Failure> {
    let wrong = |what: String| Failure::bad_input(format!("the pilot: {what}; make it again"));
    let read = checkpoint::from_bytes(pilot).and_then(|read| checkpoint::pilot(&read));
    let pilot = read.map_err(wrong)?;
    let request = request::of_run(&pilot.identity, true);
    let served = with_parts(scene, &request, &pilot, |maker| {
        let mut watch = |_: &Progress, _: &SoFar<'_>| match stops.load(Ordering::Relaxed) {
            true => Watch::Stop,
            false => Watch::Continue,
        };
        serve(&mut |range| {
            let part =
                Part { scene: name.display().to_string(), part: maker.make(range, &mut watch) };
            // Its header is short.
            checkpoint::to_bytes(&checkpoint::of_part(&part)).unwrap_or_default()
        })
    });
    served.map_err(|error| match error {
        SolveError::OtherRun("the scene") => Failure::bad_input(format!(
            "the pilot: is of another scene than {}, or that has changed since; give the scene that it was made of, or make it again",
            name.display()
        )),
        SolveError::OtherRun(what) => {
            wrong(format!("it is not of this build: they differ in {what}"))
        }
        other => unsolvable(other, (scene, name)),
    })
}
