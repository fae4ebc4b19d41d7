//! A full disk: the run says so, ends with exit code 4, and what was there before is kept.

use super::cases::{CASES, LONG};
use super::dice::Dice;
use super::runs::{Bench, CHECKPOINT, Ended, MAP, ended, signal, start, wait};
use super::told::Told;
use super::watched::Watched;
use crate::case::Case;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A block of `ulimit -f`, bytes.
const BLOCK: usize = 512;
/// A page of memory, of which a file system in memory consists, bytes.
const PAGE: usize = 4096;
/// A map that was there before.
const EARLIER: Case = Case { accuracy: "5%", ..CASES[0] };

/// Runs a command with files of so many blocks at most.
const LIMITED: &str = "ulimit -f $0; exec \"$@\"";

/// Fills the disk under maps and checkpoints.
pub(super) fn run(
    bench: &Bench,
    (seed, count): (u64, u64),
    told: &mut Told,
) -> Result<Value, String> {
    let mut dice = Dice::new(seed, "disk");
    let (whole, _) = bench.whole(&CASES[0], "2")?;
    let new = bench.bytes(MAP).len();
    bench.whole(&EARLIER, "2")?;
    let earlier = bench.bytes(MAP);
    let count = count.div_ceil(10);
    let limits: Vec<usize> = (0..count).map(|_| (dice.share() * new as f64) as usize).collect();
    let mut rows = Vec::new();
    let mut kept = 0;
    for &limit in &limits {
        bench.clear()?;
        bench.write(MAP, &earlier)?;
        let blocks = (limit / BLOCK).to_string();
        let ended = ended(bench.solve(&CASES[0], &["sh", "-c", LIMITED, &blocks], &[]))?;
        kept += u64::from(is_kept(
            bench,
            &earlier,
            &ended,
            &format!("files of {limit} bytes at most"),
            told,
        ));
        told.step(&format!("a map of {new} bytes, files of {limit} at most"));
    }
    rows.push(json!({ "fault": "map larger than a file may be", "runs": count, "kept": kept }));
    rows.extend(on_small_disks(bench, (&earlier, new), &limits, told)?);
    rows.push(checkpoints(bench, told)?);
    drop(whole);
    Ok(Value::Array(rows))
}

/// Whether the earlier map is there and nothing else, and the run says why.
fn is_kept(bench: &Bench, earlier: &[u8], ended: &Ended, what: &str, told: &mut Told) -> bool {
    let says = ended.said.contains("m.glb: cannot be written");
    told.expect(ended.code == Some(4) && says, || format!("{what}: {ended:?}"))
        && told
            .expect(bench.bytes(MAP) == earlier, || format!("{what}: the earlier map is not kept"))
        && told.expect(bench.names() == [MAP], || format!("{what}: {:?} are there", bench.names()))
}

/// The same on a file system that is full, where one can be made.
fn on_small_disks(
    bench: &Bench,
    (earlier, new): (&[u8], usize),
    limits: &[usize],
    told: &mut Told,
) -> Result<Option<Value>, String> {
    let mut kept = 0;
    for &limit in limits {
        bench.clear()?;
        // Room for the earlier map and a part of the new one.
        let size = (earlier.len().div_ceil(PAGE) + 1) * PAGE + limit.min(new - new.min(2 * PAGE));
        let Some(_disk) = Disk::mount(&bench.folder, size) else {
            told.step("no file system can be mounted here: full ones are left out");
            return Ok(None);
        };
        bench.write(MAP, earlier)?;
        let ended = ended(bench.solve(&CASES[0], &[], &[]))?;
        let what = format!("a disk of {size} bytes");
        let says =
            told.expect(ended.said.contains("free some space"), || format!("{what}: {ended:?}"));
        kept += u64::from(is_kept(bench, earlier, &ended, &what, told) && says);
        told.step(&what);
    }
    Ok(Some(json!({ "fault": "map on a full file system", "runs": limits.len(), "kept": kept })))
}

/// A file system in memory, which goes with this value.
struct Disk<'a>(&'a Path);

impl<'a> Disk<'a> {
    /// Nothing where the user may not mount any.
    fn mount(folder: &'a Path, bytes: usize) -> Option<Self> {
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &format!("size={bytes}"), "none"]).arg(folder);
        let output = mount.output().ok()?;
        output.status.success().then_some(Self(folder))
    }
}

impl Drop for Disk<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0).status();
    }
}

/// No room for the next checkpoint: that of before is kept, and the run goes on until it is stopped. With room again it ends well.
fn checkpoints(bench: &Bench, told: &mut Told) -> Result<Value, String> {
    let (whole, _) = bench.whole(&LONG, "2")?;
    bench.clear()?;
    let checkpoint = Watched::start(bench, &LONG, &[], &[])?.stop_in_increments(bench)?;
    let blocks = (checkpoint.len() / 2 / BLOCK).to_string();
    let flags = ["--resume", "--progress", "json"];
    let limited = bench.solve(&LONG, &["sh", "-c", LIMITED, &blocks], &flags);
    let mut watched = Watched::of(start(limited)?)?;
    let is_warned = watched.says("m.checkpoint: cannot be written");
    let is_kept = fs::read(bench.path(CHECKPOINT)).is_ok_and(|bytes| bytes == checkpoint);
    signal(&watched.child, "TERM")?;
    let said = watched.rest();
    let ended = Ended { said, ..wait(watched.child)? };
    let what = "no room for a checkpoint";
    let mut fine = told.expect(is_warned, || format!("{what}: it is not said: {ended:?}"));
    fine &= told.expect(is_kept, || format!("{what}: that of before is not kept on the way"));
    fine &= told.expect(ended.code == Some(4), || format!("{what}: {ended:?}"));
    let is_kept = bench.bytes(CHECKPOINT) == checkpoint;
    fine &= told.expect(is_kept, || format!("{what}: that of before is not kept at the end"));
    let resumed = super::runs::ended(bench.solve(&LONG, &[], &["--resume"]))?;
    let is_same = resumed.code == Some(0) && bench.maps() == whole;
    fine &= told.expect(is_same, || format!("{what}: other bytes: {resumed:?}"));
    told.step(what);
    Ok(
        json!({ "fault": "checkpoint larger than a file may be", "runs": 1, "kept": u64::from(fine) }),
    )
}
