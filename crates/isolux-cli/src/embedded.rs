//! The command in the process of another program, which holds scenes and maps itself: the same checks, figures, files and words.
//! Nothing is printed, no signal is caught, and the process is not ended. Calls may run on several threads at a time.

pub use crate::caller::{Caller, Given, Told, Wanted};
pub use crate::failure::Failure;
pub use crate::part_making::Make;
pub use crate::probe::Way;
pub use crate::trouble::Trouble;

use crate::caller::{Call, called};
use crate::flags::Flags;
use crate::reading::Reading;
use crate::{arguments, carry_out, map_file, part_making, probe, request, source};
use isolux::engine::ProbePoint;
use isolux::map::{Illuminance, IlluminationMap};
use isolux::scene::Scene;
use isolux_formats::map_glb;
use std::ffi::OsString;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// Carries out a subcommand with its flags, as if `isolux --json` stood before them, to its exit code. `--max-memory` bounds maps and
/// lightmaps alone.
pub fn run(words: &[OsString], caller: Caller) -> Result<u8, Failure> {
    let flags = flags(words)?;
    let threads = flags.command.threads();
    in_call(&flags, threads, caller, || carry_out(&flags).map(|outcome| outcome.exit_code()))
}

/// Reads a scene; `words` are those of `check`.
pub fn read_scene(words: &[OsString], caller: Caller) -> Result<Scene, Failure> {
    let flags = flags(words)?;
    in_call(&flags, None, caller, || match &flags.command {
        crate::flags::Command::Check(asked) => source::read_scene(&asked.scene),
        _ => Err(Failure::bad_input("a scene is read by the words of `check`")),
    })
}

/// Reads a map with its scene.
pub fn read_map(path: &Path, caller: Caller) -> Result<(Scene, IlluminationMap), Failure> {
    by_itself(caller, || map_file::read(path))
}

/// The file of a map, which is to have this name.
pub fn map_bytes(path: &Path, scene: &Scene, map: &IlluminationMap) -> Result<Vec<u8>, Failure> {
    map_file::bytes(path, scene, map)
}

/// The bytes of a scene, for another process of the same build.
pub fn scene_bytes(scene: &Scene) -> Result<Vec<u8>, Failure> {
    map_glb::scene_bytes(scene).map_err(|error| Failure::Refused(error.to_string()))
}

/// The scene of such bytes.
pub fn scene_of_bytes(bytes: &[u8]) -> Result<Scene, Failure> {
    map_glb::scene_of_bytes(bytes).map_err(|what| {
        Failure::bad_input(format!("a scene in bytes: {what}; send it again, by the same build"))
    })
}

/// Makes parts of the run that a pilot (a file `.pilot`) belongs to, on so many threads. What all increments share is computed once;
/// `serve` is then given what makes parts. `stops` ends one early: it then holds fewer increments, or none.
pub fn make_parts<T: Send>(
    scene: (&Scene, &Path),
    pilot: &[u8],
    (threads, stops): (Option<u16>, &AtomicBool),
    serve: impl FnOnce(&mut Make<'_>) -> T + Send,
) -> Result<T, Failure> {
    let pool = request::threads_of_call(threads)?;
    pool.install(|| part_making::make_parts(scene, pilot, stops, serve))
}

/// Readings of a map, one a point; `None` where nothing is known.
pub fn readings(
    (scene, map, name): (&Scene, &IlluminationMap, &Path),
    points: &[ProbePoint],
    way: Way,
    caller: Caller,
) -> Result<Vec<Option<Illuminance>>, Failure> {
    by_itself(caller, || {
        if way != Way::Interpolated {
            map_file::warn_of_unknown_error(name, map);
        }
        Ok(probe::readings((scene, map), points, way))
    })
}

/// The same of a scene without a map, by paths.
pub fn traced(
    (scene, name): (&Scene, &Path),
    points: &[ProbePoint],
    (paths, seed): (Option<u32>, Option<u64>),
    caller: Caller,
) -> Result<Vec<Option<Illuminance>>, Failure> {
    by_itself(caller, || probe::traced((scene, name), points, &probe::settings(paths, seed)))
}

fn flags(words: &[OsString]) -> Result<Flags, Failure> {
    let all: Vec<OsString> =
        ["isolux", "--json"].into_iter().map(OsString::from).chain(words.iter().cloned()).collect();
    arguments::of_call(&all).map_err(|wrong| Failure::BadInput(vec![wrong]))
}

fn in_call<T: Send>(
    flags: &Flags,
    threads: Option<u16>,
    caller: Caller,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let reading = source::reading_of(flags)?;
    let max_memory = flags.max_memory;
    let pool = request::threads_of_call(threads)?;
    pool.install(|| called(Call { caller, reading, max_memory }, work))
}

fn by_itself<T: Send>(
    caller: Caller,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = request::threads_of_call(None)?;
    let call = Call { caller, reading: Reading::default(), max_memory: None };
    pool.install(|| called(call, work))
}
