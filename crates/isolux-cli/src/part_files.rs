//! Files of pilots and of parts of runs.

use crate::failure::Failure;
use crate::source::bad_file;
use isolux::engine::PilotState;
use isolux_formats::checkpoint::{self, Checkpoint, Part};
use isolux_formats::{Problem, Problems};
use std::path::Path;

/// Reads the result of a pilot.
pub(crate) fn read_pilot(path: &Path, max_bytes: u64) -> Result<PilotState, Failure> {
    let remedy = "leave it out: the same pilot is made again";
    read(path, max_bytes, checkpoint::pilot, remedy)
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
    let read = checkpoint::read(path, max_bytes).map_err(|p| bad_file(Problems::from(p)))?;
    of(&read).map_err(|what| bad_file(Problems::from(Problem::new(path, "", what, remedy))))
}
