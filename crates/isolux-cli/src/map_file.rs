//! Map files.

use crate::caller::{self, Told};
use crate::failure::Failure;
use crate::notes::{Note, note};
use crate::output::OutputPath;
use crate::source::{bad_file, check_place, is_builtin, show_warnings, warn_of_sky};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux_formats::map_glb::{self, MapFile, Preview};
use std::path::Path;

/// Whether a file is a map and not a scene.
pub(crate) fn is_map(path: &Path) -> bool {
    caller::here().is_some_and(|call| call.map(path).is_some()) || map_glb::is_map(path)
}

/// Reads a map with the scene in it, which is not refused by [`check_place`].
pub(crate) fn read(path: &Path) -> Result<(Scene, IlluminationMap), Failure> {
    if let Some(given) = given(path) {
        return Ok(given);
    }
    refuse_builtin(path)?;
    warn_of_sky(path);
    let loaded = map_glb::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    check_place(path, &loaded.value.0)?;
    Ok(loaded.value)
}

/// Reads a map that is read for its figures: it is solved, and takes no accuracy.
pub(crate) fn read_solved(
    path: &Path,
    accuracy: Option<f64>,
) -> Result<(Scene, IlluminationMap), Failure> {
    if accuracy.is_some() {
        return Err(Failure::bad_input(format!(
            "--accuracy: {} is a map, which is solved; leave it out or give a scene",
            path.display()
        )));
    }
    read(path)
}

/// The same with the texels that the file holds.
pub(crate) fn read_with_texels(path: &Path) -> Result<MapFile, Failure> {
    if let Some((scene, map)) = given(path) {
        return Ok(MapFile { scene, map, lightmap: None });
    }
    refuse_builtin(path)?;
    warn_of_sky(path);
    let loaded = map_glb::read_with_texels(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    check_place(path, &loaded.value.scene)?;
    Ok(loaded.value)
}

/// What a caller has in memory.
fn given(path: &Path) -> Option<(Scene, IlluminationMap)> {
    caller::here()?.map(path).cloned()
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
    let bytes = bytes(output.path(), scene, map)?;
    if let Some(call) = caller::here() {
        call.tell(Told::Map(output.path().to_owned(), Box::new((scene.clone(), map.clone()))));
    }
    output.write(&bytes)
}

/// A map with its scene as a file.
pub(crate) fn bytes(path: &Path, scene: &Scene, map: &IlluminationMap) -> Result<Vec<u8>, Failure> {
    let preview = Preview::automatic(scene, map);
    map_glb::write(scene, map, &preview)
        .map_err(|e| Failure::Refused(format!("{}: {e}", path.display())))
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
