//! The command in the process of another program, which holds scenes and maps itself: the same checks, figures, files and words.
//! Nothing is printed, no signal is caught, and the process is not ended. Calls may run on several threads at a time.

pub use crate::caller::{Caller, Given, Told, Wanted};
pub use crate::failure::Failure;
pub use crate::part_making::Make;
pub use crate::probe::Way;
pub use crate::stop::Stop;
pub use crate::trouble::Trouble;

use crate::arguments::Asked;
use crate::caller::{Call, called};
use crate::flags::{Command, Flags};
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
/// lightmaps alone. What serves pages until it is stopped is refused.
pub fn run(words: &[OsString], caller: Caller) -> Result<u8, Failure> {
    let flags = match arguments::of_call(&with_json(words)).map_err(wrong)? {
        Asked::For(flags) => flags,
        Asked::Help(text) => {
            (caller.tell)(Told::Text(text));
            return Ok(0);
        }
    };
    refuse_servers(&flags.command)?;
    in_call((&flags, words), caller, || carry_out(&flags).map(|outcome| outcome.exit_code()))
}

/// Reads a scene; `words` are those of `check`.
pub fn read_scene(words: &[OsString], caller: Caller) -> Result<Scene, Failure> {
    let Asked::For(flags) = arguments::of_call(&with_json(words)).map_err(wrong)? else {
        return Err(not_check());
    };
    in_call((&flags, words), caller, || match &flags.command {
        Command::Check(asked) => source::read_scene(&asked.scene),
        _ => Err(not_check()),
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

fn with_json(words: &[OsString]) -> Vec<OsString> {
    ["isolux", "--json"].into_iter().map(OsString::from).chain(words.iter().cloned()).collect()
}

fn wrong(what: Trouble) -> Failure {
    Failure::BadInput(vec![what])
}

fn not_check() -> Failure {
    Failure::bad_input("a scene is read by the words of `check`")
}

/// Refuses what would not come back by itself.
fn refuse_servers(command: &Command) -> Result<(), Failure> {
    match command {
        Command::View(_) => Err(Failure::bad_input(
            "view serves pages until it is stopped, so that this call would not return; use m.view() in a notebook, \
             m.export(\"map.html\"), or the command in a terminal",
        )),
        Command::Solve(asked) if asked.live => Err(Failure::bad_input(
            "--live serves pages until they are closed, so that this call might not return; use the command in a terminal, or follow \
             the run by a callback",
        )),
        _ => Ok(()),
    }
}

fn in_call<T: Send>(
    (flags, words): (&Flags, &[OsString]),
    caller: Caller,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let reading = source::reading_of(flags)?;
    let max_memory = flags.max_memory;
    let pool = request::threads_of_call(flags.command.threads())?;
    let call = Call { caller, reading, max_memory, words: words.to_vec() };
    pool.install(|| called(call, work))
}

fn by_itself<T: Send>(
    caller: Caller,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = request::threads_of_call(None)?;
    let call = Call { caller, reading: Reading::default(), max_memory: None, words: Vec::new() };
    pool.install(|| called(call, work))
}
