//! `--cache FILE`: samples of indirect light that runs share.

use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::source::{bad_file, show_warnings};
use isolux::engine::{CacheError, IrradianceCache};
use isolux::scene::Scene;
use isolux_formats::cache_file::{self, CacheFile, CacheHead, Found};
use isolux_formats::{Problem, Problems};
use std::path::Path;

/// Largest cache that is read where no limit is given, bytes: four million samples.
pub(crate) const MAX_CACHE_BYTES: u64 = 1 << 30;

/// Opens a cache and reads the samples of a scene.
pub(crate) fn open(
    path: &Path,
    scene: &Scene,
    max_bytes: u64,
) -> Result<(CacheFile, IrradianceCache), Failure> {
    let of = (scene.name(), &*scene.hash());
    let opened = CacheFile::open(path, of, max_bytes).map_err(|p| bad_file(Problems::from(p)))?;
    let (file, Found { cache, warning }) = opened;
    show_warnings(warning.as_slice());
    cache.check(scene).map_err(|error| impossible(path, &error))?;
    Ok((file, cache))
}

/// Reads a cache of whatever scene.
pub(crate) fn read(path: &Path) -> Result<(CacheHead, IrradianceCache), Failure> {
    let read = cache_file::read(path, MAX_CACHE_BYTES);
    let (head, Found { cache, warning }) = read.map_err(|p| bad_file(Problems::from(p)))?;
    show_warnings(warning.as_slice());
    Ok((head, cache))
}

/// Samples that are whole and yet none of this scene.
pub(crate) fn impossible(path: &Path, error: &CacheError) -> Failure {
    let remedy = "remove the file, or choose another one";
    bad_file(Problems::from(Problem::new(path, "", error.to_string(), remedy)))
}

/// Keeps new samples for later runs. The result is there already: where they cannot be kept, it is said
/// and no more.
pub(crate) fn keep(file: &mut CacheFile, made: &IrradianceCache) {
    if made.samples.is_empty() {
        return;
    }
    if let Err(problem) = file.append(&made.samples) {
        note(Note::Warning, problem);
    }
}
