//! Radiance scenes (`.rad`).
//!
//! Files are read in the order and with the meaning of the Radiance manual, and commands among
//! those that are understood are resolved without a shell. What becomes of each material and
//! surface, with formulas, is in the `README.md` of this folder. Files are taken as hostile: arrays,
//! nesting and sizes are bounded, and only files in the scene's directory tree are opened.

mod argument_files;
mod build;
mod command;
mod frame;
mod genbox;
mod irradiance;
mod light;
mod limits;
mod look;
mod luminaires;
mod material;
mod mixture;
mod modifiers;
mod named_files;
mod parse;
mod reader;
mod record;
mod seams;
mod skies;
mod sky_commands;
mod sky_function;
mod solar;
mod table;
mod tables;
mod tessellate;
mod words;
mod xform;

use crate::extent::{IMPLAUSIBLE_EXTENT_M, largest_side_m};
use crate::{Loaded, Problems, Reach};
pub use irradiance::irradiance_lines;
use isolux::scene::SceneParts;
use reader::Reader;
use std::path::Path;

/// What is known of a file from elsewhere.
pub(crate) struct Reading<'a> {
    /// Whether its unit of length is known, so that its size surprises nobody.
    pub(crate) unit_is_known: bool,
    /// Whether a material is replaced by another: then it is not looked at, and comes out black.
    pub(crate) is_replaced: &'a dyn Fn(&str) -> bool,
    /// Which files it may name.
    pub(crate) reach: Reach,
}

/// Reads a scene and the files it names, which must lie in its directory tree.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_with(path, Reach::Inside)
}

/// Reads a scene and the files that it may name.
pub fn read_with(path: &Path, reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    read_as(path, &Reading { unit_is_known: false, is_replaced: &|_| false, reach })
}

/// Reads a scene that several files make up, in their order, as `oconv` does: materials of one hold in those after it.
pub fn read_several(paths: &[&Path], reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    read_all(paths, &Reading { unit_is_known: false, is_replaced: &|_| false, reach })
}

/// Reads a scene of which something is known.
pub(crate) fn read_as(path: &Path, reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    read_all(&[path], reading)
}

fn read_all(paths: &[&Path], reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    let first = paths.first().copied().unwrap_or(Path::new(""));
    let reader = Reader::new(first, reading.is_replaced);
    let (parts, mut notes) = reader.read(paths, reading.reach);
    let findings = notes.findings();
    let is_empty = parts.shapes.is_empty() && parts.luminaires.is_empty();
    if is_empty && !findings.has_problems() {
        findings.problem(
            "",
            "there are no surfaces",
            "name the files that hold them by `!xform FILE`",
        );
    }
    let largest_m = largest_side_m(&parts.shapes);
    if largest_m > IMPLAUSIBLE_EXTENT_M && !reading.unit_is_known {
        findings.warning(
            "",
            format!("Radiance names no unit; read as metres, it is {largest_m:.0} m large"),
            "if it was written in another unit, refer to it from a scene.toml with `units`",
        );
    }
    notes.finish(parts)
}
