//! Two runs with one output would replace each other's maps and states: the second is refused.

use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A run that was killed holds its lock until the system has taken its memory back: so long a claim waits for it.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often it looks.
const PAUSE: Duration = Duration::from_millis(20);

/// An output that no other run may write until this goes. A lock of the system stands behind it, which ends with the process,
/// however that ends; the file that is locked may then stay and does no harm.
#[derive(Debug)]
pub(crate) struct Claim {
    path: PathBuf,
    /// Nothing where the file system knows no locks.
    locked: Option<File>,
}

impl Claim {
    /// Claims an output, or says that another run has.
    pub(crate) fn of(output: &OutputPath) -> Result<Self, Failure> {
        let path = path_beside(output.path());
        let begun = Instant::now();
        let locked = loop {
            match lock(&path) {
                // Whoever had claimed it before has removed the file since it was opened: there may be a new one.
                Ok(file) if !is_named(&file, &path) => {}
                Ok(file) => break Some(file),
                Err(TryLockError::WouldBlock) if begun.elapsed() < PATIENCE => {
                    std::thread::sleep(PAUSE)
                }
                Err(TryLockError::WouldBlock) => return Err(taken(output)),
                Err(TryLockError::Error(error)) => {
                    tell_of_missing_lock(output, &error);
                    break None;
                }
            }
        };
        Ok(Self { path, locked })
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // It is removed before it is unlocked, so that nobody takes it for a claim. Where that fails it stays, as after a crash.
        if self.locked.is_some() {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// The file that is locked: it is not the output itself, which is replaced.
fn path_beside(output: &Path) -> PathBuf {
    // Runs that reach one file by different ways are to meet.
    let output = output.canonicalize().unwrap_or_else(|_| output.to_owned());
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!(".{name}.lock"))
}

fn lock(path: &Path) -> Result<File, TryLockError> {
    let opened = File::options().write(true).create(true).truncate(false).open(path);
    let file = opened.map_err(TryLockError::Error)?;
    file.try_lock()?;
    Ok(file)
}

/// Whether an open file is the one of that name.
#[cfg(unix)]
fn is_named(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let of = |known: io::Result<std::fs::Metadata>| known.map(|known| (known.dev(), known.ino()));
    match (of(file.metadata()), of(std::fs::metadata(path))) {
        (Ok(open), Ok(named)) => open == named,
        _ => false,
    }
}

/// Elsewhere a file that is open is not removed.
#[cfg(not(unix))]
fn is_named(_file: &File, _path: &Path) -> bool {
    true
}

fn taken(output: &OutputPath) -> Failure {
    Failure::bad_input(format!(
        "{}: another run is writing it; wait for its end, or choose another name",
        output.path().display()
    ))
}

fn tell_of_missing_lock(output: &OutputPath, error: &io::Error) {
    let path = output.path().display();
    let text =
        format!("{path}: cannot be claimed ({error}); do not start a second run with this output");
    note(Note::Warning, text);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_is_claimed_once_and_again_when_it_is_free() {
        let home = tempfile::tempdir().unwrap();
        let output = |name: &str| OutputPath::check(&home.path().join(name), "glb").unwrap();
        let (map, other) = (output("map.glb"), output("other.glb"));
        // What a run that was killed has left is in nobody's way.
        std::fs::write(path_beside(map.path()), "").unwrap();
        let claim = Claim::of(&map).unwrap();
        let refused = Claim::of(&map).unwrap_err();
        assert!(
            matches!(&refused, Failure::BadInput(said) if said[0].message.contains("another run"))
        );
        let beside = Claim::of(&other).unwrap();
        drop((claim, beside));
        assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
        assert!(Claim::of(&map).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn an_output_is_claimed_by_whichever_name() {
        let home = tempfile::tempdir().unwrap();
        let at = |name: &str| OutputPath::check(&home.path().join(name), "glb").unwrap();
        std::fs::write(home.path().join("map.glb"), "").unwrap();
        std::os::unix::fs::symlink("map.glb", home.path().join("link.glb")).unwrap();
        let _claim = Claim::of(&at("map.glb")).unwrap();
        assert!(Claim::of(&at("link.glb")).is_err());
        assert!(Claim::of(&at("./map.glb")).is_err());
    }
}
