//! Photometric files from disk.

use super::{IesFile, parse};
use crate::{Loaded, Problem, Problems};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Largest file read, bytes: a million intensities of sixty characters.
const MAX_FILE: u64 = 64 << 20;

/// Largest tilt file read, bytes.
const MAX_TILT_FILE: u64 = 1 << 20;

/// Reads a photometric file, and the tilt file beside it if it names one.
pub fn read(path: &Path) -> Result<Loaded<IesFile>, Problems> {
    let bytes = bounded(path, MAX_FILE)?;
    parse(&bytes, path, &mut |name| beside(path, name))
}

/// The bytes of a file that lies in the directory of another, links followed.
fn beside(path: &Path, name: &str) -> Result<Vec<u8>, Problem> {
    let tilt_file = path.with_file_name(name);
    let directory = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let (real, home) = match (tilt_file.canonicalize(), directory.canonicalize()) {
        (Ok(real), Ok(home)) => (real, home),
        (Err(error), _) | (_, Err(error)) => return Err(unreadable(&tilt_file, &error)),
    };
    if real.parent() != Some(&home) {
        return Err(Problem::new(
            &tilt_file,
            "",
            "is a link to another directory",
            "put the tilt file itself beside the photometric file",
        ));
    }
    bounded(&real, MAX_TILT_FILE)
}

fn bounded(path: &Path, most: u64) -> Result<Vec<u8>, Problem> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most + 1).read_to_end(&mut bytes))
        .map_err(|error| unreadable(path, &error))?;
    if bytes.len() as u64 > most {
        let what = format!("is larger than {} MiB", most >> 20);
        return Err(Problem::new(path, "", what, "give a photometric file"));
    }
    Ok(bytes)
}

fn unreadable(path: &Path, error: &std::io::Error) -> Problem {
    Problem::new(path, "", format!("cannot be read: {error}"), "check the path and its permissions")
}
