//! Photometric files from disk.

use super::{IesFile, parse};
use crate::plain_text::read_bounded;
use crate::{Loaded, Problem, Problems};
use std::io::ErrorKind;
use std::path::Path;

/// Largest file read, bytes: a million intensities of sixty characters.
const MAX_FILE: u64 = 64 << 20;

/// Largest tilt file read, bytes.
const MAX_TILT_FILE: u64 = 1 << 20;

/// Reads a photometric file, and the tilt file beside it if it names one.
pub fn read(path: &Path) -> Result<Loaded<IesFile>, Problems> {
    let bytes = read_bounded(path, MAX_FILE)?;
    parse(&bytes, path, &mut |name| beside(path, name))
}

/// The bytes of a file that lies in the directory of another, links followed; `None` if there is no such file.
fn beside(path: &Path, name: &str) -> Result<Option<Vec<u8>>, Problem> {
    let tilt_file = path.with_file_name(name);
    let directory = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let (real, home) = match (tilt_file.canonicalize(), directory.canonicalize()) {
        (Ok(real), Ok(home)) => (real, home),
        (Err(error), _) if error.kind() == ErrorKind::NotFound => return Ok(None),
        (Err(error), _) | (_, Err(error)) => return Err(Problem::unreadable(&tilt_file, &error)),
    };
    if real.parent() != Some(&home) {
        return Err(Problem::new(
            &tilt_file,
            "",
            "is a link to another directory",
            "put the tilt file itself beside the photometric file",
        ));
    }
    read_bounded(&real, MAX_TILT_FILE).map(Some)
}
