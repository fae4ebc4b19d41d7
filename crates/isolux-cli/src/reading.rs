//! How scenes are read.

use isolux_formats::scene_toml::SkyAsked;
use std::path::PathBuf;

/// How scenes are read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reading {
    /// Whether materials of other formats are read by their letter.
    pub(crate) as_written: bool,
    /// Whether scenes may name files anywhere on this machine.
    pub(crate) allow_outside: bool,
    /// The sky that stands in place of that of scenes.
    pub(crate) sky: Option<SkyAsked>,
    /// Files that make up one scene with the one that a command reads.
    pub(crate) further: Vec<PathBuf>,
}
