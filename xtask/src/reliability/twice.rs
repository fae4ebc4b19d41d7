//! Two runs with one output: the second is refused, and the first is not disturbed.

use super::cases::{LONG, MEDIUM};
use super::dice::Dice;
use super::runs::{Bench, CHECKPOINT, Maps, ended, is_over, signal, start, wait};
use super::told::Told;
use super::watched::Watched;
use serde_json::{Value, json};
use std::thread::sleep;
use std::time::Duration;

/// What the second is told.
const REFUSED: &str = "another run is writing it";
/// How often it is looked for a state.
const GLANCE: Duration = Duration::from_millis(20);
/// A run has to last so long that another one, which waits a second for the output, still finds it taken.
const LEAST: Duration = Duration::from_secs(2);

/// Starts two runs at a time.
pub(super) fn run(
    bench: &Bench,
    (seed, count): (u64, u64),
    told: &mut Told,
) -> Result<Value, String> {
    let mut dice = Dice::new(seed, "twice");
    let count = count.div_ceil(10);
    let (whole, lasted) = bench.whole(&MEDIUM, "2")?;
    if lasted < LEAST {
        return Err(format!("two runs at once: one lasts {lasted:?}, too short to meet another"));
    }
    let mut fine = 0;
    for _ in 0..count {
        fine += u64::from(at_once(bench, &whole, told)?);
        told.step("two runs at once");
    }
    let (whole, _) = bench.whole(&LONG, "2")?;
    let after = later(bench, &whole, &mut dice, told)?;
    told.step("a second run, and one after the first was killed");
    Ok(json!([
        { "fault": "two runs started at once", "runs": count, "one_refused_same_bytes": fine },
        { "fault": "second run later, then a third after SIGKILL of the first", "runs": 1, "one_refused_same_bytes": u64::from(after) },
    ]))
}

/// Whether of two runs one is refused, and the other ends as if it were alone.
fn at_once(bench: &Bench, whole: &Maps, told: &mut Told) -> Result<bool, String> {
    bench.clear()?;
    let run = || start(bench.solve(&MEDIUM, &[], &["--threads", "1"]));
    let (a, b) = (run()?, run()?);
    let both = [wait(a)?, wait(b)?];
    let refused = both.iter().filter(|e| e.code == Some(2) && e.said.contains(REFUSED)).count();
    let done = both.iter().filter(|e| e.code == Some(0)).count();
    let is_right = refused == 1 && done == 1 && bench.maps() == *whole && bench.others().is_empty();
    Ok(told.expect(is_right, || format!("two runs at once: {both:?}, {:?}", bench.names())))
}

fn later(bench: &Bench, whole: &Maps, dice: &mut Dice, told: &mut Told) -> Result<bool, String> {
    bench.clear()?;
    let mut first = Watched::start(bench, &LONG, &[], &["--threads", "1"])?;
    if !first.says("\"increments\"") {
        return Err("a run says nothing of its increments".to_owned());
    }
    let flags: &[&str] = if dice.below(2) == 0 { &["--resume"] } else { &[] };
    let second = ended(bench.solve(&LONG, &[], flags))?;
    let is_refused = second.code == Some(2) && second.said.contains(REFUSED);
    let mut fine = told.expect(is_refused, || format!("a second run: {second:?}"));
    // Its state is kept on the way, so that there is something to go on with.
    while !is_over(&mut first.child) && bench.bytes(CHECKPOINT).is_empty() {
        sleep(GLANCE);
    }
    signal(&first.child, "KILL")?;
    first.rest();
    wait(first.child)?;
    let third = ended(bench.solve(&LONG, &[], &["--resume"]))?;
    let is_resumed = !third.said.contains("no such run to resume");
    let is_right = third.code == Some(0) && bench.maps() == *whole && bench.others().is_empty();
    fine &= told.expect(is_resumed, || format!("no state was kept on the way: {third:?}"));
    fine &= told.expect(is_right, || format!("a run after one that was killed: {third:?}"));
    Ok(fine)
}
