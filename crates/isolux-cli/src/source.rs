//! Scenes by path or by name.

use crate::caller;
use crate::failure::Failure;
use crate::flags::{Flags, MaterialsName};
use crate::notes::{Note, note};
use crate::origin::{Extent, Remoteness};
use crate::reading::Reading;
use crate::trouble::Trouble;
use isolux::scene::{Scene, SceneParts, SceneProblem};
use isolux_compare::{BUILTIN_NAMES, BuiltinError, builtin};
use isolux_formats::obj::Materials;
use isolux_formats::scene_toml::{SkyAsked, put_sky};
use isolux_formats::{Loaded, Problem, Problems, Reach};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// What comes before the name of a scene that is built in.
const BUILTIN: &str = "builtin:";

/// How flags ask for it, if all files that are to be read together are of the kind that can be.
pub(crate) fn reading_of(flags: &Flags) -> Result<Reading, Failure> {
    let mut reading = Reading {
        as_written: flags.materials == MaterialsName::AsWritten,
        allow_outside: flags.allow_outside,
        sky: flags.sky.as_deref().map(SkyAsked::parse),
        further: Vec::new(),
    };
    if let Some((first, further)) = flags.command.read_together() {
        isolux_formats::check_together(&together(first, further)).map_err(bad_file)?;
        reading.further = further.to_owned();
    }
    Ok(reading)
}

/// What the command was asked for.
static ASKED: OnceLock<Reading> = OnceLock::new();

/// Whether something was read that a sky is for, or that it was said of that it is not.
static SKY_HAD_A_PLACE: AtomicBool = AtomicBool::new(false);

/// From now on scenes are read like this.
pub(crate) fn read_as(reading: Reading) {
    // It is said once, before anything is read.
    let _ = ASKED.set(reading);
}

fn reading() -> Reading {
    let asked = caller::here().map(|call| call.reading.clone()).or_else(|| ASKED.get().cloned());
    asked.unwrap_or_default()
}

/// Which files a scene may name.
pub(crate) fn reach() -> Reach {
    if reading().allow_outside { Reach::Anywhere } else { Reach::Inside }
}

fn together<'a>(first: &'a Path, further: &'a [PathBuf]) -> Vec<&'a Path> {
    std::iter::once(first).chain(further.iter().map(PathBuf::as_path)).collect()
}

/// Reads a scene to compute light in it, and says on standard error what its reader left out or guessed.
pub(crate) fn read_scene(source: &Path) -> Result<Scene, Failure> {
    let Loaded { value, warnings } = read_scene_with_warnings(source)?;
    show_warnings(&warnings);
    check_place(source, &value)?;
    Ok(value)
}

/// Refuses a scene that lies so far off that results would be wrong, and warns of one that lies far off.
pub(crate) fn check_place(source: &Path, scene: &Scene) -> Result<(), Failure> {
    match Extent::of(scene).remoteness(source) {
        Remoteness::Near => Ok(()),
        Remoteness::Far(warning) => {
            show_warnings(&[warning]);
            Ok(())
        }
        Remoteness::TooFar(problem) => Err(bad_file(problem.into())),
    }
}

/// Reads a scene.
pub(crate) fn read_scene_with_warnings(source: &Path) -> Result<Loaded<Scene>, Failure> {
    if let Some(scene) = caller::here().and_then(|call| call.scene(source)) {
        if reading().sky.is_some() {
            return Err(Failure::bad_input(
                "`--sky` beside a scene in memory; read the scene with it",
            ));
        }
        return Ok(Loaded { value: scene, warnings: Vec::new() });
    }
    let Loaded { value, warnings } = read_parts(source)?;
    let value = Scene::assemble(value).map_err(|problems| bad_scene(source, problems))?;
    Ok(Loaded { value, warnings })
}

/// The same scene without specular transport.
pub(crate) fn diffuse(source: &Path, scene: &Scene) -> Result<Scene, Failure> {
    scene.diffuse_only().map_err(|problems| bad_scene(source, problems))
}

fn bad_scene(file: &Path, problems: Vec<SceneProblem>) -> Failure {
    let problem = |p: SceneProblem| Problem::new(file, p.place.to_string(), p.what, p.remedy);
    bad_file(Problems(problems.into_iter().map(problem).collect()))
}

/// Whether a scene was handed in by this name.
pub(crate) fn is_handed_in(source: &Path) -> bool {
    caller::here().is_some_and(|call| call.has_scene(source))
}

/// Whether this names a scene that is built in, or should.
pub(crate) fn is_builtin(source: &Path) -> bool {
    source.to_str().is_some_and(|name| name.starts_with(BUILTIN))
}

/// Reads what a scene is made of, below the sky that is asked for.
pub(crate) fn read_parts(source: &Path) -> Result<Loaded<SceneParts>, Failure> {
    let mut loaded = read_parts_alone(source)?;
    SKY_HAD_A_PLACE.store(true, Ordering::Relaxed);
    if let Some(sky) = reading().sky {
        let told = put_sky(&mut loaded.value, &sky, reach()).map_err(bad_file)?;
        loaded.warnings.extend(told);
    }
    Ok(loaded)
}

/// Says that a map, whose light is known, takes no sky.
pub(crate) fn warn_of_sky(map: &Path) {
    SKY_HAD_A_PLACE.store(true, Ordering::Relaxed);
    if reading().sky.is_some() {
        let what =
            format!("{}: is a map, whose light stays as it is: `--sky` is left out", map.display());
        note(Note::Warning, what);
    }
}

/// Says that a sky was asked for where nothing was read that could be below one.
pub(crate) fn warn_of_idle_sky() {
    if reading().sky.is_some() && !SKY_HAD_A_PLACE.load(Ordering::Relaxed) {
        note(Note::Warning, "--sky: no scene was read, so that it is left out");
    }
}

fn read_parts_alone(source: &Path) -> Result<Loaded<SceneParts>, Failure> {
    let Reading { as_written, further, .. } = reading();
    if !further.is_empty() {
        return isolux_formats::load_several(&together(source, &further), reach())
            .map_err(bad_file);
    }
    let materials = if as_written { Materials::AsWritten } else { Materials::AsMeant };
    match source.to_str().and_then(|name| name.strip_prefix(BUILTIN)) {
        Some(name) => built_in(name).map(|value| Loaded { value, warnings: Vec::new() }),
        None => isolux_formats::load_with(source, materials, reach()).map_err(bad_file),
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
    Failure::BadInput(problems.0.iter().map(Trouble::of_file).collect())
}

/// A scene without luminaires is bad input. Materials that emit are none where no surface has an area.
pub(crate) fn no_light(source: &Path, scene: &Scene) -> Failure {
    let (what, remedy) = match scene.triangle_count() {
        0 if !scene.shape_names().is_empty() => NO_AREA,
        _ => ("the scene has no light", add_light(source)),
    };
    Failure::bad_input(format!("{}: {what}; {remedy}", source.display()))
}

/// What is wrong with a scene of nothing but needles and points, and how to mend it.
pub(crate) const NO_AREA: (&str, &str) =
    ("no triangle of the scene has an area", "check coordinates and scales where it was made");

/// What is wrong with a scene none of whose surfaces carries a map, and how to mend it.
pub(crate) const NO_MAP: (&str, &str) = (
    "no surface can carry a map: all are mirrors, glass, lamps that reflect nothing or without area",
    "give one a diffuse reflectance, and check the scales",
);

/// How to, in this kind of file.
fn add_light(source: &Path) -> &'static str {
    if source.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
        "add a [[luminaire]], a [sky], or a material with `luminance_cd_m2`"
    } else {
        "give it a sky by --sky, or name the file in a scene.toml, as [[geometry]] with `file`, and add a [[luminaire]] there"
    }
}

fn built_in(name: &str) -> Result<SceneParts, Failure> {
    builtin(name).map_err(|error| {
        let names = BUILTIN_NAMES.map(|known| format!("{BUILTIN}{known}")).join(", ");
        Failure::bad_input(match error {
            BuiltinError::Unknown => {
                format!("there is no scene `{BUILTIN}{name}`; choose one of {names}, or {BUILTIN}truth-00 to {BUILTIN}truth-59")
            }
            BuiltinError::Variant(error) => format!("{BUILTIN}{name}: {error}"),
        })
    })
}
