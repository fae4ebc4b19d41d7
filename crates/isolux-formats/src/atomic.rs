//! Output files: checked before anything is computed, replaced whole or not at all.

use crate::Problem;
use std::fs::{self, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Whether a file can be written there, found out before hours are spent on its contents.
///
/// Creates and removes a temporary file beside it; the file itself is left alone.
pub fn check_writable(path: &Path) -> Result<(), Problem> {
    if path.file_name().is_none() {
        return Err(problem(path, "the path names no file", "add a file name"));
    }
    let directory = directory_of(&followed(path));
    if let Some(file) = directory.ancestors().find(|above| above.is_file()) {
        let what = format!("`{}` is a file, not a directory", file.display());
        return Err(problem(path, what, "choose another place"));
    }
    if !directory.is_dir() {
        let what = format!("there is no directory `{}`", directory.display());
        return Err(problem(path, what, "create it or choose another place"));
    }
    match fs::metadata(path) {
        Ok(known) => check_replaceable(path, &known)?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        // Too long a name, say: a temporary file beside it has a shorter one.
        Err(error) => return Err(unwritable(path, &error)),
    }
    temporary_beside(&followed(path)).map(drop).map_err(|error| unwritable(path, &error))
}

fn check_replaceable(path: &Path, known: &fs::Metadata) -> Result<(), Problem> {
    if known.is_dir() {
        return Err(problem(path, "is a directory", "add a file name"));
    }
    if !known.is_file() {
        return Err(problem(path, "is not a regular file", "choose another place"));
    }
    if known.permissions().readonly() {
        return Err(problem(path, "is read-only", "choose another name or allow writing"));
    }
    Ok(())
}

/// Writes a file so that at any moment, power failures included, its name stands for the old
/// contents or for the new, whole.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), Problem> {
    write_with(path, &|to| to.write_all(bytes))
}

/// Writes a file as [`write()`] does, by a function that need not hold all of it at once.
pub fn write_with(path: &Path, contents: &WriteTo<'_>) -> Result<(), Problem> {
    check_writable(path)?;
    replace(path, contents).map_err(|error| unwritable(path, &error))
}

/// A function that writes the contents of a file.
pub type WriteTo<'a> = dyn Fn(&mut dyn Write) -> io::Result<()> + 'a;

fn replace(path: &Path, contents: &WriteTo<'_>) -> io::Result<()> {
    let target = followed(path);
    let mut file = temporary_beside(&target)?;
    contents(&mut file)?;
    file.as_file().sync_all()?;
    file.persist(&target).map_err(|error| error.error)?;
    sync_directory(&directory_of(&target))
}

/// A link is kept, and what it points to is replaced.
fn followed(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".isolux-").suffix(".part");
    if let Some(permissions) = wanted_permissions(path) {
        builder.permissions(permissions);
    }
    builder.tempfile_in(directory_of(path))
}

/// Those of the file that is replaced; else what any new file gets, not the private ones of a
/// temporary file.
fn wanted_permissions(path: &Path) -> Option<Permissions> {
    fs::metadata(path).ok().map(|known| known.permissions()).or_else(new_file_permissions)
}

#[cfg(unix)]
fn new_file_permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    // Read and write for all, less the mask of the process.
    Some(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn new_file_permissions() -> Option<Permissions> {
    None
}

/// The new name survives a power failure only when its directory is on the disk, too.
#[cfg(unix)]
fn sync_directory(directory: &Path) -> io::Result<()> {
    fs::File::open(directory)?.sync_all()
}

#[cfg(not(unix))]
fn sync_directory(_directory: &Path) -> io::Result<()> {
    Ok(())
}

fn directory_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn problem(path: &Path, what: impl Into<String>, remedy: &str) -> Problem {
    Problem::new(path, "", what, remedy)
}

fn unwritable(path: &Path, error: &io::Error) -> Problem {
    let remedy = match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space",
        io::ErrorKind::InvalidFilename => "choose a shorter name",
        io::ErrorKind::PermissionDenied => "choose a place where you may write",
        _ => "choose another place",
    };
    problem(path, format!("cannot be written: {}", cause_of(error)), remedy)
}

/// A failure wrapped by `tempfile` names the temporary file, which nobody asked for: of that one
/// only the kind is told.
fn cause_of(error: &io::Error) -> String {
    match error.get_ref() {
        Some(_) => io::Error::from(error.kind()).to_string(),
        None => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_are_replaced_whole_and_nothing_is_left_behind() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("map.glb");
        for bytes in [b"first".as_slice(), b"second, longer", b""] {
            write(&path, bytes).unwrap();
            assert_eq!(fs::read(&path).unwrap(), bytes);
        }
        check_writable(&path).unwrap();
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    fn places_where_no_file_can_be_are_refused_with_a_reason() {
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::write(at("file"), "").unwrap();
        for (path, what) in [
            (at("missing/map.glb"), "there is no directory"),
            (at("file/map.glb"), "file` is a file, not a directory"),
            (at("file/maps/map.glb"), "file` is a file, not a directory"),
            (directory.path().to_owned(), "is a directory"),
            (PathBuf::from("/"), "the path names no file"),
            (PathBuf::new(), "the path names no file"),
        ] {
            let found = check_writable(&path).unwrap_err();
            assert!(found.what.contains(what), "{path:?}: {found}");
            assert!(!found.remedy.is_empty());
            assert_eq!(write(&path, b"x").unwrap_err(), found);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_and_the_permissions_behind_it_are_kept() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let directory = tempfile::tempdir().unwrap();
        let (file, link) = (directory.path().join("file"), directory.path().join("link"));
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, Permissions::from_mode(0o640)).unwrap();
        symlink(&file, &link).unwrap();
        write(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_name_of_a_temporary_file_is_not_told() {
        let found = check_writable(Path::new("/proc/map.glb")).unwrap_err();
        assert!(found.what.starts_with("cannot be written: "), "{found}");
        assert!(!found.to_string().contains(".part"), "{found}");
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_too_long_is_found_before_anything_is_written() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("m".repeat(300));
        let found = check_writable(&path).unwrap_err();
        assert_eq!(found.remedy, "choose a shorter name", "{found}");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_not_replaced() {
        let found = check_writable(Path::new("/dev/null")).unwrap_err();
        assert!(found.what.contains("not a regular file"), "{found}");
    }
}
