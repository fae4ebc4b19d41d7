//! The files of the repository.

use super::code;
use std::path::Path;
use std::process::Command;

/// All files that are tracked, or would be.
#[derive(Default)]
pub(super) struct Tree {
    /// In the order of their paths.
    pub files: Vec<File>,
}

/// One file of text.
pub(super) struct File {
    /// Path from the root of the repository, with slashes.
    pub path: String,
    /// Contents; empty for anything that is not UTF-8.
    pub text: String,
    /// Contents of a Rust file without its comments and literals, else empty.
    pub code: String,
}

impl Tree {
    /// Reads what git tracks and what it does not ignore.
    pub(super) fn read(root: &Path) -> Result<Self, String> {
        let listing = Command::new("git")
            .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
            .current_dir(root)
            .output()
            .map_err(|e| format!("cannot run git: {e}; tidy lists files with it"))?;
        if !listing.status.success() {
            return Err(format!("git ls-files: {}", String::from_utf8_lossy(&listing.stderr)));
        }
        let paths = String::from_utf8_lossy(&listing.stdout);
        let mut paths: Vec<&str> = paths.split('\0').filter(|p| !p.is_empty()).collect();
        paths.sort_unstable();
        paths.dedup();
        let files = paths.into_iter().filter_map(|path| {
            // A file deleted but still in the index is no longer ours to check.
            let bytes = std::fs::read(root.join(path)).ok()?;
            Some(File::new(path, String::from_utf8(bytes).unwrap_or_default()))
        });
        Ok(Self { files: files.collect() })
    }

    /// The file at a path.
    pub(super) fn file(&self, path: &str) -> Option<&File> {
        self.files.iter().find(|f| f.path == path)
    }

    /// Rust files under a folder, which ends in a slash.
    pub(super) fn rust_under<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = &'a File> {
        self.files.iter().filter(move |f| f.path.starts_with(folder) && f.path.ends_with(".rs"))
    }

    /// Names of the folders directly under `crates/`.
    pub(super) fn crates(&self) -> Vec<&str> {
        let mut names: Vec<&str> = self
            .files
            .iter()
            .filter_map(|f| f.path.strip_prefix("crates/")?.strip_suffix("/Cargo.toml"))
            .filter(|name| !name.contains('/'))
            .collect();
        names.dedup();
        names
    }

    #[cfg(test)]
    pub(super) fn of(files: &[(&str, &str)]) -> Self {
        Self { files: files.iter().map(|(p, t)| File::new(p, (*t).to_owned())).collect() }
    }
}

impl File {
    fn new(path: &str, text: String) -> Self {
        let code = if path.ends_with(".rs") { code::mask(&text) } else { String::new() };
        Self { path: path.to_owned(), text, code }
    }
}
