//! Scenes by path or by name.

use crate::failure::Failure;
use crate::notes::{Note, note};
use isolux::scene::{Scene, SceneProblem};
use isolux_compare::{BUILTIN_NAMES, BuiltinError, builtin};
use isolux_formats::{Loaded, Problem, Problems};
use std::path::Path;

/// What comes before the name of a scene that is built in.
const BUILTIN: &str = "builtin:";

/// Reads a scene and says on standard error what its reader left out or guessed.
pub(crate) fn read_scene(source: &Path) -> Result<Scene, Failure> {
    let Loaded { value, warnings } = read_scene_with_warnings(source)?;
    show_warnings(&warnings);
    Ok(value)
}

/// Reads a scene.
pub(crate) fn read_scene_with_warnings(source: &Path) -> Result<Loaded<Scene>, Failure> {
    match source.to_str().and_then(|name| name.strip_prefix(BUILTIN)) {
        Some(name) => built_in(name).map(|value| Loaded { value, warnings: Vec::new() }),
        None => from_file(source).map_err(bad_file),
    }
}

/// Warnings are for the user, whatever is printed.
pub(crate) fn show_warnings(warnings: &[Problem]) {
    for warning in warnings {
        note(Note::Warning, warning);
    }
}

/// Problems of a file are bad input.
pub(crate) fn bad_file(problems: Problems) -> Failure {
    Failure::BadInput(problems.0.iter().map(ToString::to_string).collect())
}

fn built_in(name: &str) -> Result<Scene, Failure> {
    let parts = builtin(name).map_err(|error| {
        let names = BUILTIN_NAMES.map(|known| format!("{BUILTIN}{known}")).join(", ");
        Failure::bad_input(match error {
            BuiltinError::Unknown => {
                format!("there is no scene `{BUILTIN}{name}`; choose one of {names}")
            }
            BuiltinError::Variant(error) => format!("{BUILTIN}{name}: {error}"),
        })
    })?;
    Scene::assemble(parts).map_err(|problems| {
        Failure::BadInput(problems.iter().map(|p| format!("{BUILTIN}{name}: {p}")).collect())
    })
}

/// By the extension of its name.
fn from_file(path: &Path) -> Result<Loaded<Scene>, Problems> {
    let Loaded { value, warnings } = isolux_formats::load(path)?;
    let value = Scene::assemble(value).map_err(|problems| {
        let problem = |p: SceneProblem| Problem::new(path, p.place.to_string(), p.what, p.remedy);
        Problems(problems.into_iter().map(problem).collect())
    })?;
    Ok(Loaded { value, warnings })
}
