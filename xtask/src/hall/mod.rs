//! The bench of the practical scene: time to an accuracy against triangles and luminaires, and the
//! true error of maps against a reference.

mod reference;
mod truth;

use reference::{Kind, Place};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Stdio};

/// Triangles and luminaires, the standard hall first: it is what the others are compared with.
const VARIANTS: [(u32, u32); 7] = [
    (10_000, 2626),
    (100_000, 2626),
    (1_000_000, 2626),
    (10_000_000, 2626),
    (10_000, 100),
    (10_000, 10_000),
    (10_000, 100_000),
];
const QUICK: [(u32, u32); 3] = [(10_000, 2626), (100_000, 2626), (10_000, 100)];

/// Luminaires of the reference; dividing surfaces changes no light.
const REFERENCE_LUMINAIRES: u32 = 2626;

/// What is asked of every run.
struct Effort<'a> {
    accuracy: &'a str,
    time_limit: &'a str,
    /// All there are, unless given.
    threads: Option<&'a str>,
}

/// Solves every variant and prints a table, or JSON.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let is_set = |flag: &str| arguments.contains(&flag);
    if arguments == ["--reference"] {
        return reference::make(root);
    }
    let is_quick = is_set("--quick");
    let default = if is_quick { ("10%", "60s") } else { ("1%", "600s") };
    let effort = Effort {
        accuracy: value_of(arguments, "--accuracy")?.unwrap_or(default.0),
        time_limit: value_of(arguments, "--time-limit")?.unwrap_or(default.1),
        threads: value_of(arguments, "--threads")?,
    };
    refuse_unknown(arguments)?;
    let folder = root.join("target").join("hall");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let variants = match (is_set("--standard"), is_quick) {
        (true, _) => &VARIANTS[..1],
        (false, true) => &QUICK[..],
        (false, false) => &VARIANTS[..],
    };
    let places = reference::read(root)?;
    let mut rows = Vec::new();
    for &(triangles, luminaires) in variants {
        let scene = format!("builtin:hall,triangles={triangles},luminaires={luminaires}");
        eprintln!("{scene} to {} within {}", effort.accuracy, effort.time_limit);
        let map = folder.join("map.glb");
        let solved = solve(root, &scene, &map, &effort)?;
        let mut row = row(triangles, luminaires, &solved);
        if luminaires == REFERENCE_LUMINAIRES {
            row["true_errors"] = true_errors(root, &map, triangles, &places)?;
        }
        rows.push(row);
    }
    Ok(if is_set("--json") { format!("{:#}", Value::Array(rows)) } else { table(&rows) })
}

/// Corners of triangles are vertices of the standard division alone.
fn true_errors(root: &Path, map: &Path, triangles: u32, places: &[Place]) -> Result<Value, String> {
    let is_standard = triangles == VARIANTS[0].0;
    let kinds: &[Kind] = if is_standard { &[Kind::Area, Kind::Corner] } else { &[Kind::Area] };
    truth::errors(root, map, places, kinds)
}

/// The word after a flag.
fn value_of<'a>(arguments: &[&'a str], flag: &str) -> Result<Option<&'a str>, String> {
    let Some(at) = arguments.iter().position(|word| *word == flag) else { return Ok(None) };
    let value = arguments.get(at + 1).filter(|word| !word.starts_with("--"));
    value.copied().map(Some).ok_or_else(|| format!("bench hall: give {flag} a value"))
}

fn refuse_unknown(arguments: &[&str]) -> Result<(), String> {
    const FLAGS: [&str; 6] =
        ["--quick", "--standard", "--json", "--accuracy", "--time-limit", "--threads"];
    let unknown = arguments.iter().find(|a| a.starts_with("--") && !FLAGS.contains(a));
    unknown
        .map_or(Ok(()), |a| Err(format!("bench hall: no flag {a}; there are {}", FLAGS.join(" "))))
}

/// Runs the command; a run that its time limit ended is a result, too.
fn solve(root: &Path, scene: &str, map: &Path, effort: &Effort) -> Result<Value, String> {
    const STOPPED_EARLY: i32 = 3;
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["run", "--release", "--quiet", "--package", "isolux-cli", "--", "solve", scene]);
    command.arg("-o").arg(map).args(["--json", "--progress", "none"]);
    command.args(["--accuracy", effort.accuracy, "--time-limit", effort.time_limit]);
    if let Some(threads) = effort.threads {
        command.args(["--threads", threads]);
    }
    let output = command.current_dir(root).stderr(Stdio::inherit()).output();
    let output = output.map_err(|e| format!("cannot run isolux: {e}"))?;
    if !output.status.success() && output.status.code() != Some(STOPPED_EARLY) {
        return Err(format!("isolux solve {scene}: {}", output.status));
    }
    serde_json::from_slice(&output.stdout).map_err(|e| format!("isolux solve {scene}: {e}"))
}

/// What counts of a run, as the run says of itself.
fn row(triangles: u32, luminaires: u32, solved: &Value) -> Value {
    let mut row = json!({ "triangles": triangles, "luminaires": luminaires });
    for key in [
        "complete",
        "time_s",
        "accuracy_target",
        "accuracy_reached",
        "accuracy_statistical",
        "accuracy_discretization",
        "accuracy_bias",
        "accuracy_interpolated",
        "increments",
        "rays",
        "receivers",
    ] {
        row[key] = solved[key].clone();
    }
    row
}

fn table(rows: &[Value]) -> String {
    let mut text = String::from(
        "triangles  luminaires   time s  complete  reached %  interpolated %  receivers  Mrays\n",
    );
    for row in rows {
        let percent = |key: &str| match row[key].as_f64() {
            Some(share) => format!("{:.2}", 100.0 * share),
            None => "unknown".to_owned(),
        };
        text += &format!(
            "{:>9}  {:>10}  {:>7.1}  {:>8}  {:>9}  {:>14}  {:>9}  {:>5.1}\n",
            row["triangles"],
            row["luminaires"],
            row["time_s"].as_f64().unwrap_or(f64::NAN),
            if row["complete"] == true { "yes" } else { "no" },
            percent("accuracy_reached"),
            percent("accuracy_interpolated"),
            row["receivers"],
            row["rays"].as_f64().unwrap_or(f64::NAN) * 1e-6,
        );
    }
    for row in rows.iter().filter(|row| !row["true_errors"].is_null()) {
        text += &format!("\n{} triangles against the reference:\n", row["triangles"]);
        text += &truth::text(&row["true_errors"]);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_have_values_and_names() {
        let arguments = ["--quick", "--accuracy", "5%"];
        assert_eq!(value_of(&arguments, "--accuracy"), Ok(Some("5%")));
        assert_eq!(value_of(&arguments, "--threads"), Ok(None));
        for arguments in [&["--accuracy"][..], &["--accuracy", "--json"]] {
            assert!(value_of(arguments, "--accuracy").is_err());
        }
        assert!(refuse_unknown(&["--fast"]).unwrap_err().contains("--quick"));
        assert_eq!(refuse_unknown(&arguments), Ok(()));
    }

    #[test]
    fn what_is_not_known_is_not_zero() {
        let solved =
            json!({ "complete": false, "time_s": 60.5, "receivers": 7, "rays": 2_500_000 });
        let text = table(&[row(10_000, 100, &solved)]);
        let words: Vec<&str> = text.lines().nth(1).unwrap().split_whitespace().collect();
        assert_eq!(words, ["10000", "100", "60.5", "no", "unknown", "unknown", "7", "2.5"]);
    }
}
