//! Files written: checked before anything is computed, and never seen half-written.

use crate::caller;
use crate::failure::Failure;
use isolux_formats::atomic;
use std::path::{Path, PathBuf};

/// Makes a folder and those above it, unless they are there.
pub(crate) fn create_folder(folder: &Path) -> Result<(), Failure> {
    if let Some(file) = folder.ancestors().find(|above| above.is_file()) {
        let file = file.display();
        return Err(Failure::bad_input(format!(
            "{file}: is a file, where a folder is to be; choose another name"
        )));
    }
    std::fs::create_dir_all(folder).map_err(|e| {
        let folder = folder.display();
        Failure::bad_input(format!("{folder}: cannot be created ({e}); choose another folder"))
    })
}

/// A path that could be written when it was checked.
#[derive(Clone, Debug)]
pub(crate) struct OutputPath(PathBuf);

impl OutputPath {
    /// Checks the extension, and that a file can be written there.
    pub(crate) fn check(path: &Path, extension: &str) -> Result<Self, Failure> {
        Self::check_any(path, &[extension])
    }

    /// The same for a kind of file of several.
    pub(crate) fn check_any(path: &Path, extensions: &[&str]) -> Result<Self, Failure> {
        let found = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if !found.is_some_and(|found| extensions.contains(&found.as_str())) {
            return Err(Failure::bad_input(format!(
                "{}: cannot write this kind of file; end its name in .{}",
                path.display(),
                extensions.join(" or .")
            )));
        }
        atomic::check_writable(path).map_err(Failure::bad_input)?;
        Ok(Self(path.to_owned()))
    }

    /// The path as given.
    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Refuses to replace one of the files read.
    pub(crate) fn differs_from(&self, input: &Path) -> Result<(), Failure> {
        match (self.0.canonicalize(), input.canonicalize()) {
            (Ok(output), Ok(input)) if output == input => Err(Failure::bad_input(format!(
                "{}: is the input, too; choose another name for the output",
                self.0.display()
            ))),
            _ => Ok(()),
        }
    }

    /// Refuses to replace a `.glb` or `.ply` that no export wrote: it may be somebody's scene, or the map of hours.
    pub(crate) fn replaces_exports_alone(&self) -> Result<(), Failure> {
        let holds_something = std::fs::metadata(&self.0).is_ok_and(|known| known.len() > 0);
        if !holds_something || isolux_formats::export::may_be_replaced(&self.0) {
            return Ok(());
        }
        Err(Failure::bad_input(format!(
            "{}: is there already, and no export has written it: it may be a scene or a map; choose another name for \
             the output, or remove it first",
            self.0.display()
        )))
    }

    /// Writes the file whole or not at all; not for a caller that has left.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        caller::look();
        // It could be written when it was checked: what keeps it from it now is the machine.
        atomic::write(&self.0, bytes).map_err(|problem| Failure::Refused(problem.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_checked() {
        let home = tempfile::tempdir().unwrap();
        let check = |name: &str| OutputPath::check(&home.path().join(name), "glb");
        assert!(check("map.glb").is_ok());
        assert!(check("map.GLB").is_ok());
        std::fs::create_dir(home.path().join("folder.glb")).unwrap();
        for name in ["map", "map.png", "missing/map.glb", "folder.glb", ""] {
            assert!(matches!(check(name), Err(Failure::BadInput(_))), "{name}");
        }
    }

    #[test]
    fn the_input_is_not_replaced() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("map.glb");
        std::fs::write(&path, "old").unwrap();
        let output = OutputPath::check(&path, "glb").unwrap();
        assert!(output.differs_from(&path).is_err());
        assert!(output.differs_from(&home.path().join("other.glb")).is_ok());
        assert!(output.replaces_exports_alone().is_err());
        std::fs::write(&path, "").unwrap();
        assert!(output.replaces_exports_alone().is_ok());
        std::fs::remove_file(&path).unwrap();
        assert!(output.replaces_exports_alone().is_ok());
    }
}
