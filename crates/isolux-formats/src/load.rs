//! A scene file of any kind.

use crate::{Loaded, Problem, Problems, gltf, obj, scene_toml};
use isolux::scene::SceneParts;
use std::path::Path;

/// Reads a scene by the extension of its file.
pub fn load(path: &Path) -> Result<Loaded<SceneParts>, Problems> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("gltf" | "glb") => gltf::read(path),
        Some("obj") => obj::read(path),
        Some("toml") => scene_toml::read(path),
        _ => Err(Problem::new(
            path,
            "",
            "is not a scene by its extension",
            "name a .toml, .gltf, .glb or .obj file",
        )
        .into()),
    }
}
