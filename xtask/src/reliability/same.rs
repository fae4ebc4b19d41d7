//! The same bytes on any number of threads, by any instructions, however the command was built.

use super::cases::{CASES, SMALL};
use super::runs::{Bench, Maps, ended};
use super::told::Told;
use crate::case::Case;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// Numbers of threads.
const THREADS: [&str; 4] = ["1", "2", "3", "7"];
/// A program that plays another processor.
const PLAYER: &str = "qemu-x86_64";
/// A program that plays 64-bit Arm.
const ARM_PLAYER: &str = "qemu-aarch64";
/// Processors that it plays, with what they have.
const PROCESSORS: [(&str, &str); 2] =
    [("Nehalem", "neither AVX nor AVX2"), ("max", "AVX2, no AVX-512")];

/// Compares maps of the same input.
pub(super) fn run(
    bench: &Bench,
    (other, arm): (Option<&Path>, Option<&Path>),
    told: &mut Told,
) -> Result<Value, String> {
    let mut rows = Vec::new();
    for case in &CASES {
        let (first, _) = bench.whole(case, THREADS[0])?;
        let mut fine = 0;
        for threads in THREADS {
            fine += u64::from(is_same(bench, case, &first, (&[], threads), told)?);
        }
        rows.push(json!({ "what": format!("1, 2, 3, 7 threads: {}", case.name), "runs": THREADS.len(), "same_bytes": fine }));
        if let Some(other) = other {
            let other = Bench { isolux: other.to_owned(), folder: bench.folder.clone(), ..*bench };
            let fine = is_same(&other, case, &first, (&[], "2"), told)?;
            rows.push(json!({ "what": format!("another build: {}", case.name), "runs": 1, "same_bytes": u64::from(fine) }));
        }
        told.step(case.name);
    }
    let can_play = Command::new(PLAYER).arg("--version").output().is_ok_and(|o| o.status.success());
    if !can_play {
        told.step("qemu-x86_64 is not installed: other processors are left out");
    }
    for (processor, has) in PROCESSORS.iter().filter(|_| can_play) {
        let mut fine = 0;
        for case in &SMALL {
            let (first, _) = bench.whole(case, "2")?;
            fine +=
                u64::from(is_same(bench, case, &first, (&[PLAYER, "-cpu", processor], "2"), told)?);
            told.step(&format!("{} on {processor}", case.name));
        }
        rows.push(json!({ "what": format!("{has}: all methods"), "runs": SMALL.len(), "same_bytes": fine }));
    }
    if let Some(arm) = arm {
        let arm = Bench { isolux: arm.to_owned(), folder: bench.folder.clone(), ..*bench };
        let mut fine = 0;
        for case in &SMALL {
            let (first, _) = bench.whole(case, "2")?;
            fine += u64::from(is_same(&arm, case, &first, (&[ARM_PLAYER], "2"), told)?);
            told.step(&format!("{} on 64-bit Arm", case.name));
        }
        rows.push(
            json!({ "what": "64-bit Arm: all methods", "runs": SMALL.len(), "same_bytes": fine }),
        );
    }
    Ok(Value::Array(rows))
}

/// Whether a run ends with these maps.
fn is_same(
    bench: &Bench,
    case: &Case,
    maps: &Maps,
    (before, threads): (&[&str], &str),
    told: &mut Told,
) -> Result<bool, String> {
    bench.clear()?;
    let ended = ended(bench.solve(case, before, &["--threads", threads]))?;
    let is_same = ended.code == Some(0) && bench.maps() == *maps;
    Ok(told.expect(is_same, || {
        format!("{}: other bytes on {threads} threads, {before:?}: {ended:?}", case.name)
    }))
}
