//! `isolux info`: what a file holds.

mod cache;
mod map;
mod run;
mod scene;
mod weather;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::InfoFlags;
use crate::lamp::Contents;
use crate::source::{bad_file, show_warnings};
use crate::{map_file, source};
use isolux_formats::photometric_file::PhotometricFile;
use isolux_formats::{cache_file, checkpoint};
use std::path::Path;

/// Runs the subcommand.
pub(crate) fn run(flags: &InfoFlags, json: bool) -> Result<Outcome, Failure> {
    let path = flags.file.as_path();
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("ies" | "ldt") => show_lamp(path, json)?,
        Some("epw") => weather::show(path, json)?,
        _ if cache_file::is_cache(path) => cache::show(path, json)?,
        _ if checkpoint::is_checkpoint(path) => run::show(path, json)?,
        _ if map_file::is_map(path) => {
            let (scene, map) = map_file::read(path)?;
            map::show(&scene, &map, json)?;
        }
        _ => scene::show(&source::read_scene(path)?, json)?,
    }
    Ok(Outcome::Done)
}

/// Prints a photometric file.
fn show_lamp(path: &Path, json: bool) -> Result<(), Failure> {
    let loaded = PhotometricFile::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    let distribution = loaded.value.resolve().map_err(Failure::bad_input)?;
    let contents = Contents::of(&loaded.value, &distribution);
    if json { print_json(&contents) } else { print(&contents.text()) }
}
