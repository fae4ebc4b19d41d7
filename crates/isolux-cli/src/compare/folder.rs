//! The folder that a comparison is kept in: its maps, points, pictures and reports.

use crate::failure::Failure;
use crate::output::{OutputPath, create_folder};
use isolux_formats::atomic;
use std::path::{Path, PathBuf};

/// Where everything is.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// Makes it, unless it is there.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        ["maps", "pictures", "graphs"]
            .iter()
            .try_for_each(|name| create_folder(&path.join(name)))?;
        let folder = Self(path.to_owned());
        atomic::check_writable(&folder.path("report.html")).map_err(Failure::bad_input)?;
        Ok(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    /// Where a file of some kind goes.
    pub(crate) fn output(&self, name: &str, extension: &str) -> Result<OutputPath, Failure> {
        OutputPath::check(&self.path(name), extension)
    }

    /// Writes a file whole or not at all.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        atomic::write(&self.path(name), bytes)
            .map_err(|problem| Failure::Refused(problem.to_string()))
    }

    /// A picture, if it is there.
    pub(crate) fn picture(&self, name: &str) -> Option<Vec<u8>> {
        std::fs::read(self.path(name)).ok()
    }
}
