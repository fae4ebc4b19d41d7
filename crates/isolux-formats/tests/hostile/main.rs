//! Every reader with files made hostile: no panic, no long run, no memory on the word of a count. `fuzz/` calls the same entries.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod bend;
mod entry;
#[path = "../map_glb/example.rs"]
mod example;
mod kept;
mod seal;
mod seeds;
#[path = "../spoil/mod.rs"]
mod spoil;

use bend::bend;
use entry::{ENTRIES, Entry, Home};
use isolux_formats::map_glb;
use spoil::Dice;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The folder of the crate.
const FORMATS: &str = env!("CARGO_MANIFEST_DIR");

/// Hostile files of each entry, unless `HOSTILE_CASES` says another number; `HOSTILE_SEED` makes others.
const CASES: u64 = 1000;
/// No file of some kilobytes takes longer, on a busy machine and with little optimization.
const MOST_TIME: Duration = Duration::from_secs(10);
/// Nor does it take more memory: all that is taken while it is read, given back or not.
const MOST_BYTES: usize = 1 << 30;

/// A number that the environment may choose.
fn chosen(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

/// Whether a file is read, or else what its reading did that none may do.
fn outcome(entry: &Entry, home: &Home, bytes: &[u8]) -> Result<bool, String> {
    let before = Region::new(ALLOCATOR);
    let begun = Instant::now();
    let ended = catch_unwind(AssertUnwindSafe(|| (entry.read)(home, bytes)));
    let (taken, elapsed) = (before.change().bytes_allocated, begun.elapsed());
    match ended {
        Err(_) => Err("panics".into()),
        Ok(_) if taken > MOST_BYTES => Err(format!("takes {} MiB", taken >> 20)),
        Ok(_) if elapsed > MOST_TIME => Err(format!("takes {elapsed:?}")),
        Ok(is_read) => Ok(is_read),
    }
}

/// Whether a file is read. Keeps one that does harm, and says where.
fn is_read(entry: &Entry, home: &Home, bytes: &[u8]) -> bool {
    outcome(entry, home, bytes).unwrap_or_else(|harm| {
        let path = std::env::temp_dir().join(format!("isolux-hostile-{}", entry.name));
        std::fs::write(&path, bytes).unwrap();
        panic!("{} {harm} with {}", entry.name, path.display());
    })
}

/// One after the other: the allocator counts for all threads.
#[test]
fn hostile_files_do_no_harm() {
    let home = Home::new();
    for entry in &ENTRIES {
        let seeds = seeds::of(entry.name);
        for (number, seed) in seeds.iter().enumerate() {
            assert!(is_read(entry, &home, seed), "seed {number} of {} is refused", entry.name);
        }
        let (mut read, cases) = (0, chosen("HOSTILE_CASES", CASES));
        let mut dice = Dice(chosen("HOSTILE_SEED", 1));
        for _ in 0..cases {
            let mut bytes = seeds[dice.below(seeds.len())].clone();
            for _ in 0..=dice.below(4) {
                bend(&mut bytes, &seeds[dice.below(seeds.len())], &mut dice);
            }
            read += u64::from(is_read(entry, &home, &(entry.seal)(&bytes)));
        }
        println!("{}: {read} of {cases} are read", entry.name);
        let others = seeds::long(entry.name).into_iter().chain(seeds::found(entry.name));
        others.for_each(|bytes| {
            is_read(entry, &home, &bytes);
        });
    }
}

fn map_is_read(bytes: &[u8]) -> bool {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("map.glb");
    std::fs::write(&path, bytes).unwrap();
    map_glb::read(&path).is_ok()
}

#[test]
fn good_files_stay_as_they_are_when_sealed() {
    for entry in &ENTRIES {
        for seed in seeds::of(entry.name) {
            let sealed = (entry.seal)(&seed);
            // The JSON of a map is written anew, its members in another order and without its checksum.
            let is_same = match entry.name {
                "map" => map_is_read(&sealed),
                _ => sealed == seed,
            };
            assert!(is_same, "{}", entry.name);
        }
    }
}
