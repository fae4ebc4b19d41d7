//! Programs that show light, run on what isolux writes for them: Blender, from the package index, Bevy, from its crates, and
//! Godot, if installed. By hand: Blender weighs a gigabyte, Bevy takes minutes to build, and the lightmap of a room takes one.

mod bench;
mod bevy;
mod blender;
mod godot;

use crate::peers::build;
use crate::smoke::card_scene;
use bench::{Bench, text};
use std::path::Path;

/// Shows the card to all, a room to Blender. What is not installed is left out, and said.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let folder = root.join("target").join("consumers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let bench = Bench { root, isolux: build(root)?, folder };
    let card = bench.folder.join("card-map.glb");
    let scene = card_scene(&bench.folder)?;
    bench.isolux(&["solve", &text(&scene), "-o", &text(&card), "--quality", "draft"])?;
    let shown = [blender::show, godot::show, bevy::show].map(|show| show(&bench, &card));
    Ok(shown.into_iter().collect::<Result<Vec<String>, String>>()?.join("\n"))
}
