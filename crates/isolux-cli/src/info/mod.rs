//! `isolux info`: what a file holds.

mod lamp;
mod map;
mod scene;

use crate::failure::{Failure, Outcome};
use crate::flags::InfoFlags;
use crate::{map_file, source};

/// Runs the subcommand.
pub(crate) fn run(flags: &InfoFlags, json: bool) -> Result<Outcome, Failure> {
    let path = flags.file.as_path();
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("ies") => lamp::show_ies(path, json)?,
        Some("ldt") => lamp::show_ldt(path, json)?,
        _ if map_file::is_map(path) => {
            let (scene, map) = map_file::read(path)?;
            map::show(&scene, &map, json)?;
        }
        _ => scene::show(&source::read_scene(path)?, json)?,
    }
    Ok(Outcome::Done)
}
