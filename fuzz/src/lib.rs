//! What the fuzz targets call: the same entries as the test `hostile` of isolux-formats, and the server of walk-throughs.

#[path = "../../crates/isolux-formats/tests/hostile/entry.rs"]
mod entry;
#[path = "../../crates/isolux-formats/tests/map_glb/example.rs"]
mod example;
#[path = "../../crates/isolux-formats/tests/hostile/kept.rs"]
mod kept;
mod requests;
#[path = "../../crates/isolux-formats/tests/hostile/seal.rs"]
mod seal;
#[path = "../../crates/isolux-formats/tests/hostile/seeds.rs"]
#[allow(dead_code, reason = "what did harm before is read by the test")]
mod seeds;

use entry::{ENTRIES, Home};
pub use libfuzzer_sys;
pub use requests::ask;
use std::path::Path;

/// The folder of the crate that is fuzzed.
const FORMATS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/isolux-formats");

thread_local! {
    static HOME: Home = Home::new();
}

/// Makes a fuzz target of the entry of a name.
#[macro_export]
macro_rules! target {
    ($name:literal) => {
        $crate::libfuzzer_sys::fuzz_target!(
            init: $crate::begin($name),
            |bytes: &[u8]| $crate::read($name, bytes)
        );
    };
}

/// Reads good files, so that what is made once is made before the time of hostile files counts.
pub fn begin(name: &str) {
    seeds::of(name).iter().for_each(|seed| read(name, seed));
}

/// Gives bytes to a reader as they are and, where that is something else, with their checksums repaired.
pub fn read(name: &str, bytes: &[u8]) {
    let entry = ENTRIES.iter().find(|entry| entry.name == name).expect("a target of an entry");
    HOME.with(|home| (entry.read)(home, &(entry.seal)(bytes)));
}

/// Writes the seeds of every target below a folder.
pub fn write_seeds(corpus: &Path) -> std::io::Result<()> {
    let of_readers = ENTRIES.iter().map(|entry| (entry.name, seeds::of(entry.name)));
    for (name, seeds) in of_readers.chain([("requests", requests::seeds())]) {
        let folder = corpus.join(name);
        std::fs::create_dir_all(&folder)?;
        for (number, seed) in seeds.iter().enumerate() {
            std::fs::write(folder.join(format!("seed-{number:02}")), seed)?;
        }
    }
    Ok(())
}
