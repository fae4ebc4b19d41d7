//! Copies of the repository: what the command takes from one besides itself.

use std::path::PathBuf;

/// Where a copy may be: the current folder, and those above the program (as in `target/release`).
pub(crate) fn folders() -> impl Iterator<Item = PathBuf> {
    let program = std::env::current_exe().unwrap_or_default();
    let above: Vec<PathBuf> = program.ancestors().skip(1).map(PathBuf::from).collect();
    std::iter::once(PathBuf::new()).chain(above)
}
