//! Where files lie that a scene names.

use crate::reach::{Root, Unreachable};
use std::path::{Path, PathBuf};

/// A file named in another that lies in `base`: relative to that, or to one of the folders of the scene.
pub(super) fn named_file(roots: &[Root], base: &Path, name: &str) -> Result<PathBuf, Unreachable> {
    let mut refused = Unreachable::Missing;
    for root in roots.iter().rev() {
        match root.file_beside(base, name).or_else(|_| root.file(name)) {
            Ok(path) => return Ok(path),
            Err(why) => refused = why,
        }
    }
    Err(refused)
}
