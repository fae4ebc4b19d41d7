//! Scenes of Mitsuba 3 (`.xml`).
//!
//! What becomes of each plugin, with formulas, is in the `README.md` of this folder. Radiances are in
//! W/(m2 sr); lumens come of them by 179 lm/W, as in the reader of Radiance's scenes, unless a `scene.toml` chooses
//! otherwise. Files are taken as hostile: no DTD and no entity is read, sizes and nesting are
//! bounded, and only files in the scene's directory tree are opened.

mod bsdf;
mod emitter;
mod fresnel;
mod geometry;
mod limits;
mod palette;
mod parse;
mod property;
mod reader;
mod record;
mod scope;
mod sensor;
mod spectral;
mod spectrum;
mod spectrum_file;
mod substances;
mod surroundings;
mod texture;

use crate::extent::{IMPLAUSIBLE_EXTENT_M, largest_side_m};
use crate::lines::Notes;
use crate::{Loaded, Problems, Reach};
use isolux::scene::SceneParts;
use std::path::Path;

pub(crate) use reader::Reading;

/// Reads a scene and the files it names, which must lie in its directory tree.
pub fn read(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    read_with(path, Reach::Inside)
}

/// Reads a scene and the files that it may name.
pub fn read_with(path: &Path, reach: Reach) -> Result<Loaded<SceneParts>, Problems> {
    let reading =
        Reading { unit_is_known: false, is_replaced: &|_| false, efficacy_lm_w: None, reach };
    read_as(path, &reading)
}

/// Reads a scene of which something is known.
pub(crate) fn read_as(path: &Path, reading: &Reading) -> Result<Loaded<SceneParts>, Problems> {
    let mut notes = Notes::new(path);
    let Some(root) = parse::parse(path, reading.reach, &mut notes) else {
        return notes.finish(SceneParts::default());
    };
    let parts = reader::read(&root, path, reading, &mut notes);
    let findings = notes.findings();
    if parts.shapes.is_empty() && !findings.has_problems() {
        findings.problem("", "there are no surfaces", "give it a <shape>");
    }
    let largest_m = largest_side_m(&parts.shapes);
    if largest_m > IMPLAUSIBLE_EXTENT_M && !reading.unit_is_known {
        findings.warning(
            "",
            format!("Mitsuba names no unit; read as metres, it is {largest_m:.0} m large"),
            "if it was written in another unit, refer to it from a scene.toml with `units`",
        );
    }
    notes.finish(parts)
}
