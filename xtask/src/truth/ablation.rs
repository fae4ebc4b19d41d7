//! What every mechanism of the engines is worth: the scenes of this bench with and without it.

use super::bounded::Isolux;
use super::exported::{self, TruthScene};
use super::flags::Flags;
use super::{judged, paths, solved};
use crate::peers::{cargo, wait};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A mechanism stays that saves a tenth of the work for an error, or of the error, in some kind of scene.
const WORTH: f64 = 1.1;
/// Runs of fewer seconds tell nothing of speed where they trace the same rays: the same run takes up to a fifth longer once or again.
const LONG_S: f64 = 2.0;
/// Readings outside their intervals, as a share of all, by which a map without it may be less honest.
const LESS_HONEST: f64 = 0.02;

/// Solves every scene with everything, then without each mechanism.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let (mechanisms, arguments) = chosen(root, arguments)?;
    let flags = Flags::parse(&arguments)?;
    let folder = root.join("target").join("truth");
    let program = flags.isolux.clone().map_or_else(|| build(root), Ok)?;
    let isolux = Isolux::new(root, Some(&program), &folder)?;
    let scenes = exported::scenes(root, flags.isolux.is_some())?;
    let scenes: Vec<TruthScene> = scenes.into_iter().filter(|s| flags.has(s)).collect();
    let kept = match flags.save {
        true => root.join("benchmarks").join("ablation"),
        false => folder.join("ablation"),
    };
    std::fs::create_dir_all(&kept).map_err(|e| format!("{}: {e}", kept.display()))?;
    let file = kept.join("rows.json");
    let text = std::fs::read(&file).unwrap_or_default();
    let mut rows: Map<String, Value> = serde_json::from_slice(&text).unwrap_or_default();
    for scene in &scenes {
        eprintln!("{}: {}", scene.name, scene.kind);
        let input = exported::files(&folder, &isolux, scene)?;
        let truth = paths::truth(&folder, &isolux, scene, &input, &flags)?;
        for mechanism in std::iter::once(None).chain(mechanisms.iter().map(|m| Some(m.as_str()))) {
            for method in &flags.methods {
                for &seed in &flags.seeds {
                    let key = key(scene, method, seed, mechanism);
                    if rows.contains_key(&key) && !flags.fresh {
                        continue;
                    }
                    let solver = isolux.without(mechanism);
                    let row =
                        solved::solve(&folder, &solver, scene, &input, (method, seed), &flags).map(
                            |(solved, readings)| judged::row(scene, &truth, solved, &readings),
                        );
                    let row = row.unwrap_or_else(|problem| json!({ "failed": problem }));
                    rows.insert(key, kept_of(&row, &scene.kind));
                }
            }
        }
        std::fs::write(&file, lines(&rows)).map_err(|e| format!("{}: {e}", file.display()))?;
    }
    let table = table(&mechanisms, &rows);
    let page = kept.join("table.md");
    std::fs::write(&page, &table).map_err(|e| format!("{}: {e}", page.display()))?;
    Ok(table)
}

/// What the table needs of a row.
fn kept_of(row: &Value, kind: &str) -> Value {
    const KEYS: [&str; 8] =
        ["exit", "cpu_s", "rays", "receivers", "true", "told", "outside", "failed"];
    let some = KEYS.iter().filter(|key| !row[**key].is_null());
    let mut kept: Map<String, Value> =
        some.map(|key| ((*key).to_owned(), row[*key].clone())).collect();
    kept.insert("kind".to_owned(), json!(kind));
    Value::Object(kept)
}

/// Rows as JSON, one a line.
fn lines(rows: &Map<String, Value>) -> String {
    let rows: Vec<String> =
        rows.iter().map(|(key, row)| format!("{}: {row}", json!(key))).collect();
    format!("{{\n{}\n}}\n", rows.join(",\n"))
}

fn key(scene: &TruthScene, method: &str, seed: u64, mechanism: Option<&str>) -> String {
    format!("{} {method} {seed} {}", scene.name, mechanism.unwrap_or("-"))
}

/// The mechanisms named after `--without`, or all that the core asks for; and the other arguments.
fn chosen<'a>(root: &Path, arguments: &[&'a str]) -> Result<(Vec<String>, Vec<&'a str>), String> {
    let all = mechanisms(&root.join("crates").join("isolux").join("src"))?;
    let Some(at) = arguments.iter().position(|word| *word == "--without") else {
        return Ok((all.into_iter().collect(), arguments.to_vec()));
    };
    let names = arguments[at + 1..].iter().take_while(|word| !word.starts_with("--"));
    let names: Vec<String> = names.map(|name| (*name).to_owned()).collect();
    if let Some(unknown) = names.iter().find(|name| !all.contains(*name)) {
        let all: Vec<String> = all.into_iter().collect();
        return Err(format!("no mechanism `{unknown}`; there are {}", all.join(", ")));
    }
    let others = arguments[..at].iter().chain(&arguments[at + 1 + names.len()..]);
    Ok((names, others.copied().collect()))
}

/// All names that `without` is asked for below a folder.
fn mechanisms(folder: &Path) -> Result<BTreeSet<String>, String> {
    let mut found = BTreeSet::new();
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            found.extend(mechanisms(&path)?);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            found.extend(asked(&text));
        }
    }
    Ok(found)
}

fn asked(text: &str) -> Vec<String> {
    let after = text.split("without(\"").skip(1);
    after.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
}

/// The command with the switches, in a folder of its own.
fn build(root: &Path) -> Result<PathBuf, String> {
    let target = root.join("target").join("ablation");
    let mut command = cargo();
    command.args(["build", "--release", "--quiet", "--package", "isolux-cli"]);
    command.args(["--features", "ablation", "--target-dir"]).arg(&target).current_dir(root);
    wait(&mut command, "cargo build")?;
    Ok(target.join("release").join(format!("isolux{}", std::env::consts::EXE_SUFFIX)))
}

/// What a scene comes to without a mechanism, of what it does with it.
struct Compared<'a> {
    kind: &'a str,
    /// Time of processors, true error, and time for one error: its square times the time.
    time: f64,
    error: f64,
    work: f64,
    /// By how much more readings lie outside their intervals, as a share.
    outside: f64,
    is_lost: bool,
}

/// One line a mechanism, those that are worth least first.
fn table(mechanisms: &[String], rows: &Map<String, Value>) -> String {
    let mut lines: Vec<(f64, String)> = mechanisms.iter().map(|m| line(m, rows)).collect();
    lines.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let head = "\
| without | time | true error | work for one error | outside | worst kind: work | lost | worth |
|---|---:|---:|---:|---:|---|---:|---|
";
    lines.into_iter().fold(head.to_owned(), |all, (_, line)| all + &line + "\n")
}

fn line(mechanism: &str, rows: &Map<String, Value>) -> (f64, String) {
    let found: Vec<Compared> =
        rows.iter().filter_map(|(k, row)| compared(mechanism, k, row, rows)).collect();
    let mean = |of: fn(&Compared) -> f64, some: &[&Compared]| {
        let logs: Vec<f64> = some.iter().map(|c| of(c).ln()).filter(|l| l.is_finite()).collect();
        (logs.iter().sum::<f64>() / logs.len().max(1) as f64).exp()
    };
    let all: Vec<&Compared> = found.iter().filter(|c| !c.is_lost).collect();
    let kinds: BTreeSet<&str> = all.iter().map(|c| c.kind).collect();
    let of_kind =
        |kind: &str| -> Vec<&Compared> { all.iter().filter(|c| c.kind == kind).copied().collect() };
    let by_kind = kinds.iter().map(|kind| (*kind, mean(|c| c.work, &of_kind(kind))));
    let worst = by_kind.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(("none", 1.0));
    let lost = found.iter().filter(|c| c.is_lost).count();
    let outside = all.iter().map(|c| c.outside).sum::<f64>() / all.len().max(1) as f64;
    let [time, error, work] =
        [mean(|c| c.time, &all), mean(|c| c.error, &all), mean(|c| c.work, &all)];
    let is_worth = worst.1 > WORTH || outside > LESS_HONEST || lost > 0;
    let (kind, of_worst) = worst;
    let worth = if is_worth { "yes" } else { "no" };
    let text = format!(
        "| {mechanism} | {time:.2} | {error:.2} | {work:.2} | {:+.1} % | {kind}: {of_worst:.2} | {lost} | {worth} |",
        100.0 * outside
    );
    (worst.1 + lost as f64, text)
}

fn compared<'a>(
    mechanism: &str,
    key: &str,
    row: &'a Value,
    rows: &Map<String, Value>,
) -> Option<Compared<'a>> {
    let scene = key.strip_suffix(mechanism)?.strip_suffix(' ')?;
    let with = rows.get(&format!("{scene} -"))?;
    let number = |row: &Value, key: &str| row[key].as_f64();
    let kind = row["kind"].as_str()?;
    let ratio = |key: &str| Some(number(row, key)? / number(with, key)?);
    let is_lost = !row["failed"].is_null() || row["exit"] != 0 && with["exit"] == 0;
    let [time, error] = ["cpu_s", "true"].map(|key| ratio(key).unwrap_or(f64::NAN));
    let is_short = number(with, "cpu_s").is_some_and(|time_s| time_s < LONG_S);
    let time = if is_short && row["rays"] == with["rays"] { 1.0 } else { time };
    let outside = number(row, "outside").zip(number(with, "outside"));
    let outside = outside.map_or(0.0, |(without, with)| without - with);
    Some(Compared { kind, time, error, work: time * error * error, outside, is_lost })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mechanisms_are_what_the_core_asks_for() {
        assert_eq!(asked("if without(\"a-b\") { }\n x && !without(\"c\")"), ["a-b", "c"]);
        assert!(asked("fn without(name: &str)").is_empty());
    }

    /// Half the time at twice the error is twice the work for one error.
    #[test]
    fn work_is_time_for_one_error() {
        let with = json!({ "kind": "k", "exit": 0, "rays": 9, "cpu_s": 2.0, "true": 0.01, "outside": 0.05 });
        let without =
            json!({ "kind": "k", "exit": 0, "cpu_s": 1.0, "true": 0.02, "outside": 0.06 });
        let rows: Map<String, Value> = Map::from_iter([
            ("s hybrid 1 -".to_owned(), with),
            ("s hybrid 1 m".to_owned(), without.clone()),
        ]);
        let found = compared("m", "s hybrid 1 m", &without, &rows).unwrap();
        assert!((found.work - 2.0).abs() < 1e-12 && !found.is_lost);
        let (_, text) = line("m", &rows);
        assert!(text.contains("| 0.50 | 2.00 | 2.00 | +1.0 % | k: 2.00 | 0 | yes |"), "{text}");
    }
}
