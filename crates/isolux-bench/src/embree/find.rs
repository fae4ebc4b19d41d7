//! Where the library is.

use std::path::{Path, PathBuf};

/// Names the file of the library.
const VARIABLE: &str = "ISOLUX_EMBREE";
/// Where `cargo xtask bench setup` puts it, from the root of the repository.
const FOLDER: &str = "target/embree";

/// The file that the variable names, or the one in the folder.
pub(super) fn library() -> Result<PathBuf, String> {
    if let Some(path) = std::env::var_os(VARIABLE) {
        return Ok(path.into());
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."));
    in_folder(&root.join(FOLDER)).ok_or_else(|| {
        format!("not in {FOLDER}: run `cargo xtask bench setup`, or name the library in {VARIABLE}")
    })
}

/// Wheels keep their libraries one folder down.
fn in_folder(folder: &Path) -> Option<PathBuf> {
    let below = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten();
    let folders = below(folder).map(|entry| entry.path()).filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| below(&folder)).map(|entry| entry.path());
    files.into_iter().find(|file| is_embree(file))
}

fn is_embree(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let is_library = [".so", ".dylib", ".dll"].iter().any(|ending| name.contains(ending));
    name.trim_start_matches("lib").starts_with("embree4") && is_library
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_known_by_its_name() {
        for (name, expected) in [
            ("libembree4-4aef3270.so.4", true),
            ("libembree4.4.dylib", true),
            ("embree4.dll", true),
            ("libtbb.so.12", false),
            ("embree4.lib", false),
        ] {
            assert_eq!(is_embree(Path::new(name)), expected, "{name}");
        }
    }
}
