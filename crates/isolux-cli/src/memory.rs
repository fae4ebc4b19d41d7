//! How much memory the command may take, and its end where that does not do.

use crate::caller;
use crate::ending;
use crate::failure::Failure;
use crate::quantity::{show_bytes, show_more_bytes};
use isolux_memory::{Counted, Lack};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

#[global_allocator]
static MEMORY: Counted = Counted;

/// Memory that a map or a lightmap may take without a word, bytes.
const USUAL: u64 = 8 << 30;
/// What the program takes beside scenes and light.
const PROGRAM: u64 = 64 << 20;

/// What was asked for, bytes.
static ASKED: OnceLock<u64> = OnceLock::new();
static IS_JSON: AtomicBool = AtomicBool::new(false);

/// Bounds the memory of the command, if that is asked for, and ends it in words where it lacks memory.
pub(crate) fn bound(asked: Option<u64>, json: bool) {
    IS_JSON.store(json, Ordering::Relaxed);
    isolux_memory::end_by(end);
    if let Some(bytes) = asked {
        let _ = ASKED.set(bytes);
        isolux_memory::allow(bytes.saturating_add(PROGRAM));
    }
}

/// What was asked for of the command, or in a call.
fn asked() -> Option<u64> {
    caller::here().map_or_else(|| ASKED.get().copied(), |call| call.max_memory)
}

/// Memory for the elements and the rays of a map, bytes. Of what was asked for the scene, readers and what is written take the other half.
pub(crate) fn of_map() -> u64 {
    asked().map_or(USUAL, |bytes| bytes / 2)
}

/// What a map of a scene lacks whose triangles alone need more than it may take, and how to mend that.
pub(crate) fn of_triangles(needed: u64, allowed: u64) -> (String, String) {
    let [needs, may] = show_more_bytes(needed, allowed);
    let what = format!(
        "for its triangles alone the map needs about {needs}, more than the {may} that it may take"
    );
    let (unit, bytes) = if needed < 1 << 30 { ("MiB", 1 << 20) } else { ("GiB", 1 << 30) };
    let enough = (2 * needed).div_ceil(bytes);
    (
        what,
        format!("give --max-memory {enough}{unit}, of which a map takes half, or a simpler scene"),
    )
}

/// Memory for a lightmap, bytes.
pub(crate) fn of_lightmap() -> u64 {
    asked().unwrap_or(USUAL)
}

fn end(lack: Lack) -> ! {
    let all = (lack.used.saturating_add(lack.wanted) as u64).saturating_sub(PROGRAM);
    let (bound, remedy) = match lack.allowed.and(ASKED.get()) {
        Some(asked) => (format!("the {} of --max-memory", show_bytes(*asked)), "raise it"),
        None => ("this machine gives".to_owned(), "use a machine with more"),
    };
    let what = format!(
        "at least {} of memory are needed, more than {bound}; {remedy}, or ask for less: a smaller picture, fewer texels, a \
         larger --accuracy, a simpler scene",
        show_bytes(all)
    );
    let code = ending::tell(&Err(Failure::Refused(what)), IS_JSON.load(Ordering::Relaxed));
    std::process::exit(code.into())
}
