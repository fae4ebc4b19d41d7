//! Map files.

use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::source::{bad_file, check_place, is_builtin, show_warnings};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::map_glb::{self, MapFile, Preview};
use std::path::Path;

/// Whether a file is a map and not a scene.
pub(crate) fn is_map(path: &Path) -> bool {
    map_glb::is_map(path)
}

/// Reads a map with the scene in it, which is not refused by [`check_place`].
pub(crate) fn read(path: &Path) -> Result<(Scene, IlluminationMap), Failure> {
    refuse_builtin(path)?;
    let loaded = map_glb::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    check_place(path, &loaded.value.0)?;
    Ok(loaded.value)
}

/// The same with the texels that the file holds.
pub(crate) fn read_with_texels(path: &Path) -> Result<MapFile, Failure> {
    refuse_builtin(path)?;
    let loaded = map_glb::read_with_texels(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    check_place(path, &loaded.value.scene)?;
    Ok(loaded.value)
}

/// Scenes that are built in are no maps.
fn refuse_builtin(path: &Path) -> Result<(), Failure> {
    if !is_builtin(path) {
        return Ok(());
    }
    let scene = path.display();
    Err(Failure::bad_input(format!(
        "{scene}: is a scene and no map; solve it first: isolux solve {scene} -o map.glb"
    )))
}

/// Writes a map with its scene.
pub(crate) fn write(
    output: &OutputPath,
    scene: &Scene,
    map: &IlluminationMap,
) -> Result<(), Failure> {
    let preview = Preview::automatic(scene, map);
    let bytes = map_glb::write(scene, map, &preview)
        .map_err(|e| Failure::Refused(format!("{}: {e}", output.path().display())))?;
    output.write(&bytes)
}

/// Says so where standard errors of readings are infinite, as the map does not know its own.
pub(crate) fn warn_of_unknown_error(path: &Path, map: &IlluminationMap) {
    if map.provenance.accuracy.is_none() {
        let text = format!(
            "{}: how wrong this map is is not known, as its run ended too early to tell, so that standard errors are infinite; \
             give it more time, or read a scene by paths",
            path.display()
        );
        note(Note::Warning, text);
    }
}
