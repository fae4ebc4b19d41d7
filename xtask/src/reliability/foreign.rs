//! States that are damaged, of another run or of another build: each is refused by its name, and nothing is overwritten.

use super::cases::LONG;
use super::dice::Dice;
use super::runs::{Bench, CHECKPOINT, MAP, ended};
use super::sealed::{damaged, in_format, with};
use super::told::{Told, line};
use super::watched::Watched;
use crate::case::Case;
use serde_json::{Value, json};
use std::path::Path;

/// States damaged for every run that is disturbed.
const DAMAGED: u64 = 3;
/// Runs that differ in one thing, and what that is called.
const OTHERS: [(&str, Case, &[&str]); 6] = [
    ("the scene", Case { scene: "builtin:sphere", ..LONG }, &[]),
    ("the method", Case { method: "forward", ..LONG }, &[]),
    ("the accuracy", Case { accuracy: "0.16%", ..LONG }, &[]),
    ("the seed", LONG, &["--seed", "2"]),
    ("the memory allowed", LONG, &["--max-memory", "4GiB"]),
    ("whether it is audited", LONG, &["--no-audit"]),
];
/// Numbers of a state that somebody has changed, with the checksum that it should have.
const NUMBERS: [&str; 3] = ["increments", "rays", "stage"];

/// Shows such states to a run.
pub(super) fn run(
    bench: &Bench,
    other: Option<&Path>,
    (seed, count): (u64, u64),
    told: &mut Told,
) -> Result<Value, String> {
    let mut dice = Dice::new(seed, "foreign");
    bench.clear()?;
    let state = Watched::start(bench, &LONG, &[], &[])?.stop_in_increments(bench)?;
    let map = bench.bytes(MAP);
    let mut refusal = Refusal { bench, map: &map, told };
    let mut rows = Vec::new();
    let mut row = |what: &str, tried: u64, refused: u64| {
        rows.push(json!({ "state": what, "tried": tried, "refused": refused }));
    };
    let (mut refused, tried) = (0, DAMAGED * count);
    for _ in 0..tried {
        refused += u64::from(refusal.is_refused(&damaged(&state, &mut dice), "")?);
    }
    row("damaged: bits changed, cut short, longer, emptied", tried, refused);
    refusal.told.step("damaged states");
    refused = 0;
    for (what, case, flags) in &OTHERS {
        let of_other = Watched::start(bench, case, &[], flags)?.stop_in_increments(bench)?;
        refused += u64::from(refusal.is_refused(&of_other, &format!("differs in {what}"))?);
        refusal.told.step(&format!("a state that differs in {what}"));
    }
    row("of another scene, method, accuracy, seed, memory, audit", OTHERS.len() as u64, refused);
    let builds = [
        (with(&state, |h| h["identity"]["version"] = json!("0.0.9"))?, "the version of isolux"),
        (with(&state, |h| h["identity"]["version"] = json!("99.0.0"))?, "the version of isolux"),
        (with(&state, |h| h["identity"]["build"] = json!("another"))?, "the build of isolux"),
        (with(&state, |h| h["identity"]["build"] = Value::Null)?, "its header"),
        (in_format(&state, 0), "it has format 0"),
        (in_format(&state, 3), "it has format 3"),
    ];
    refused = 0;
    for (state, said) in &builds {
        refused += u64::from(refusal.is_refused(state, said)?);
    }
    row("of an older or newer version, build or format", builds.len() as u64, refused);
    let (mut fine, tried) = (0, count.div_ceil(10));
    for number in 0..tried {
        let name = NUMBERS[number as usize % NUMBERS.len()];
        let value = dice.next() >> dice.below(64);
        let changed = with(&state, |header| header[name] = json!(value))?;
        fine += u64::from(refusal.ends_well(&changed, &format!("{name} = {value}"))?);
    }
    rows.push(
        json!({ "state": "numbers changed behind the checksum", "tried": tried, "no_panic": fine }),
    );
    if let Some(other) = other {
        rows.push(of_build(bench, other, told)?);
    }
    Ok(Value::Array(rows))
}

/// What refuses states.
struct Refusal<'a> {
    bench: &'a Bench<'a>,
    map: &'a [u8],
    told: &'a mut Told,
}

impl Refusal<'_> {
    /// Whether a state is refused by its name and for this reason, and is left alone, as is the map.
    fn is_refused(&mut self, state: &[u8], why: &str) -> Result<bool, String> {
        let bench = self.bench;
        bench.clear()?;
        bench.write(MAP, self.map)?;
        bench.write(CHECKPOINT, state)?;
        let ended = ended(bench.solve(&LONG, &[], &["--resume"]))?;
        let said = line(&ended.said, &bench.folder);
        let is_named = said.contains("error: m.checkpoint: ") && said.contains(why);
        let is_kept = bench.bytes(CHECKPOINT) == state && bench.bytes(MAP) == self.map;
        let is_alone = bench.names() == [CHECKPOINT, MAP];
        let what = || {
            format!(
                "a state is not refused for `{why}`, or something is overwritten: {:?} {said}",
                ended.code
            )
        };
        Ok(self.told.expect(ended.code == Some(2) && is_named && is_kept && is_alone, what))
    }

    /// Whether a run ends with a code of its own.
    fn ends_well(&mut self, state: &[u8], what: &str) -> Result<bool, String> {
        self.bench.clear()?;
        self.bench.write(CHECKPOINT, state)?;
        let ended = ended(self.bench.solve(&LONG, &[], &["--resume", "--time-limit", "500ms"]))?;
        let is_well = matches!(ended.code, Some(0 | 2 | 3 | 4));
        Ok(self.told.expect(is_well, || format!("{what}: {ended:?}")))
    }
}

/// A state of another build of the same sources is gone on with, that of other sources is refused.
fn of_build(bench: &Bench, other: &Path, told: &mut Told) -> Result<Value, String> {
    let (whole, _) = bench.whole(&LONG, "2")?;
    bench.clear()?;
    let made_by = Bench { isolux: other.to_owned(), folder: bench.folder.clone(), ..*bench };
    Watched::start(&made_by, &LONG, &[], &[])?.stop_in_increments(&made_by)?;
    let ended = ended(bench.solve(&LONG, &[], &["--resume"]))?;
    let is_gone_on = ended.code == Some(0) && bench.maps() == whole;
    let is_refused = ended.code == Some(2) && ended.said.contains("the build of isolux");
    let fine =
        told.expect(is_gone_on || is_refused, || format!("a state of another build: {ended:?}"));
    told.step("a state of another build");
    Ok(
        json!({ "state": "made by the other build", "tried": 1, "same_bytes": u64::from(fine && is_gone_on), "refused": u64::from(is_refused) }),
    )
}
