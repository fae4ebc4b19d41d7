//! Maps of small scenes, whose bytes a move or a renaming must not change.
//!
//! The same input gives the same bytes on any number of threads, so that a hash tells whether a change of the code
//! has changed any result. Where one was meant to, `--save` keeps the new hashes, and the table shows what it did to rays.

mod cases;
mod table;

use crate::case::Case;
use crate::peers;
use cases::CASES;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Numbers of threads, which must not matter.
const THREADS: [&str; 2] = ["1", "2"];

/// Solves every case and compares with what is kept.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let flags = Flags::parse(arguments)?;
    let isolux = flags.isolux.map_or_else(|| peers::build(root), Ok)?;
    let folder = root.join("target").join("golden");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let kept_file = root.join("benchmarks").join("golden").join("maps.json");
    let kept = read(&kept_file);
    let mut rows = Map::new();
    let mut problems = Vec::new();
    for case in CASES.iter().filter(|case| flags.only.is_none_or(|part| case.name.contains(part))) {
        let found = solve(root, &isolux, &folder, case);
        let before = &kept[case.name];
        println!("{}", table::line(case.name, before, &found));
        match found {
            Ok(row) if table::is_same(before, &row) || flags.save => {
                rows.insert(case.name.to_owned(), row);
            }
            Ok(_) => problems.push(format!("{}: another map than is kept", case.name)),
            Err(problem) => problems.push(format!("{}: {problem}", case.name)),
        }
    }
    if flags.save && flags.only.is_none() {
        let text = format!("{:#}\n", Value::Object(rows.clone()));
        std::fs::write(&kept_file, text).map_err(|e| format!("{}: {e}", kept_file.display()))?;
    }
    if rows.is_empty() && problems.is_empty() {
        return Err("golden: no case is called so".into());
    }
    if problems.is_empty() {
        return Ok(format!("golden: {} maps, on {} threads", rows.len(), THREADS.join(" and on ")));
    }
    Err(format!("{}\ngolden: {} to look at", problems.join("\n"), problems.len()))
}

/// What is asked for.
struct Flags<'a> {
    only: Option<&'a str>,
    save: bool,
    /// Another command than that of this workspace.
    isolux: Option<PathBuf>,
}

impl<'a> Flags<'a> {
    fn parse(arguments: &[&'a str]) -> Result<Self, String> {
        let mut flags = Self { only: None, save: false, isolux: None };
        let mut words = arguments.iter().copied();
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("give {word} a value"));
            match word {
                "--only" => flags.only = Some(value()?),
                "--isolux" => flags.isolux = Some(value()?.into()),
                "--save" => flags.save = true,
                _ => return Err(format!("golden: {word}: use --only PART, --isolux PATH, --save")),
            }
        }
        if flags.save && flags.only.is_some() {
            return Err("golden: --save keeps all cases: leave --only out".into());
        }
        Ok(flags)
    }
}

/// Solves a case on each number of threads; hash, rays and what the map tells.
fn solve(root: &Path, isolux: &Path, folder: &Path, case: &Case) -> Result<Value, String> {
    let mut first: Option<Value> = None;
    for threads in THREADS {
        let row = solve_on(root, isolux, folder, case, threads)?;
        match first {
            Some(ref first) if row["hash"] != first["hash"] => {
                return Err(format!("another map on {threads} threads"));
            }
            Some(_) => {}
            None => first = Some(row),
        }
    }
    first.ok_or_else(|| "no number of threads".into())
}

fn solve_on(
    root: &Path,
    isolux: &Path,
    folder: &Path,
    case: &Case,
    threads: &str,
) -> Result<Value, String> {
    let map = folder.join("map.glb");
    let _ = std::fs::remove_file(&map);
    let mut command = Command::new(isolux);
    command.args(["solve", case.scene, "-o"]).arg(&map).args(["--json", "--progress", "none"]);
    command.args(["--threads", threads, "--method", case.method, "--accuracy", case.accuracy]);
    command.args(case.flags).current_dir(root).stdin(Stdio::null());
    let output = command.output().map_err(|e| format!("cannot run {}: {e}", isolux.display()))?;
    let bytes = std::fs::read(&map).map_err(|_| {
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        format!("no map: {}", said.lines().last().unwrap_or_default())
    })?;
    let said: Value = serde_json::from_slice(&output.stdout)
        .map_err(|e| format!("what `solve --json` said is no JSON: {e}"))?;
    Ok(json!({
        "hash": blake3::hash(&bytes).to_hex().to_string(),
        "exit": output.status.code(),
        "rays": said["rays"],
        "receivers": said["receivers"],
        "accuracy_reached": said["accuracy_reached"],
    }))
}

fn read(file: &Path) -> Value {
    let text = std::fs::read(file).unwrap_or_default();
    serde_json::from_slice(&text).unwrap_or_default()
}
