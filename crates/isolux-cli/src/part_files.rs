//! Files of pilots and of parts of runs.

use crate::failure::Failure;
use crate::quantity::show_more_bytes;
use crate::source::bad_file;
use isolux::engine::PilotState;
use isolux_formats::checkpoint::{self, Checkpoint, Part};
use isolux_formats::{Problem, Problems};
use std::path::Path;

/// Reads the result of a pilot.
pub(crate) fn read_pilot(path: &Path, max_bytes: u64) -> Result<PilotState, Failure> {
    read(path, max_bytes, checkpoint::pilot, "leave it out: the same pilot is made again")
}

/// Reads the result of a pilot beside the state of its run.
pub(crate) fn read_kept_pilot(path: &Path, max_bytes: u64) -> Result<PilotState, Failure> {
    read(path, max_bytes, checkpoint::pilot, "remove it: the same pilot is made again")
}

/// Reads what is kept of a run, unless it takes more memory than a map may.
pub(crate) fn whole(path: &Path, max_bytes: u64, remedy: &str) -> Result<Checkpoint, Failure> {
    let bytes = std::fs::metadata(path).map_or(0, |known| known.len());
    if bytes > max_bytes {
        let [takes, may] = show_more_bytes(bytes, max_bytes);
        let path = path.display();
        let what = format!(
            "{path}: takes {takes} of memory, more than the {may} that a map may take; raise --max-memory, of which a map takes half"
        );
        return Err(Failure::Refused(what));
    }
    checkpoint::read(path, max_bytes).map_err(|problem| {
        bad_file(Problems::from(Problem { remedy: remedy.to_owned(), ..problem }))
    })
}

/// Writes the result of a pilot.
pub(crate) fn write_pilot(path: &Path, pilot: &PilotState) -> Result<(), Problem> {
    let checkpoint = checkpoint::of_pilot(pilot)
        .map_err(|what| Problem::new(path, "", what, "resume the run without it"))?;
    checkpoint::write(path, &checkpoint)
}

/// Reads a part of a run.
pub(crate) fn read_part(path: &Path, max_bytes: u64) -> Result<Part, Failure> {
    read(path, max_bytes, checkpoint::part, "leave it out, or make this part again")
}

/// Writes a part of a run.
pub(crate) fn write_part(path: &Path, part: &Part) -> Result<(), Failure> {
    let written = checkpoint::write(path, &checkpoint::of_part(part));
    written.map_err(|problem| Failure::Refused(problem.to_string()))
}

fn read<T>(
    path: &Path,
    max_bytes: u64,
    of: impl Fn(&Checkpoint) -> Result<T, String>,
    remedy: &str,
) -> Result<T, Failure> {
    let read = whole(path, max_bytes, remedy)?;
    of(&read).map_err(|what| bad_file(Problems::from(Problem::new(path, "", what, remedy))))
}
