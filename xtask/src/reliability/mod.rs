//! The bench of reliability: faults are injected into real runs of the command, and bytes are compared.

mod cases;
mod dice;
mod disk;
mod flags;
mod foreign;
mod hostile;
mod kills;
mod made;
mod page;
mod runs;
mod same;
mod sealed;
mod sizes;
mod told;
mod twice;
mod watched;

use crate::peers;
use crate::truth;
use flags::Flags;
use runs::Bench;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use told::Told;

/// Parts of the bench, in their order.
const PARTS: [&str; 7] = ["kills", "disk", "foreign", "twice", "same", "sizes", "hostile"];

/// Runs the parts that are asked for; the error lists what failed.
pub(crate) fn run(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let flags = Flags::parse(arguments)?;
    let isolux = flags.isolux.clone().map_or_else(|| peers::build(root), Ok)?;
    let isolux =
        std::fs::canonicalize(&isolux).map_err(|e| format!("{}: {e}", isolux.display()))?;
    let folder = root.join("target").join("reliability");
    let kept = if flags.save { root.join(page::TABLE) } else { folder.join("table.json") };
    let asked: Vec<&str> =
        PARTS.into_iter().filter(|part| flags.only.is_none_or(|only| only == *part)).collect();
    if asked.is_empty() {
        return Err(format!("reliability: there are {}", PARTS.join(", ")));
    }
    let mut told = Told::new();
    for part in asked {
        let bench = Bench { root, isolux: isolux.clone(), folder: folder.join(part) };
        let begun = Instant::now();
        let rows = of_part(part, &bench, &flags, &mut told)?;
        let mut table = read(&kept);
        table[part] = json!({
            "command": flags.command(part),
            "isolux": version(&bench)?,
            "machine": truth::machine(),
            "seconds": begun.elapsed().as_secs_f64().round(),
            "rows": rows,
        });
        // A bench that is stopped leaves what it has.
        write(&kept, &format!("{table:#}\n"))?;
    }
    let table = read(&kept);
    if flags.save {
        page::write(root, &table)?;
    }
    match told.problems.len() {
        0 => Ok(page::tables(&table)),
        count => Err(format!("{}\nreliability: {count} to look at", told.problems.join("\n"))),
    }
}

fn of_part(part: &str, bench: &Bench, flags: &Flags, told: &mut Told) -> Result<Value, String> {
    let chance = (flags.seed, flags.count);
    let other = flags.other.as_deref();
    match part {
        "kills" => kills::run(bench, chance, told),
        "disk" => disk::run(bench, chance, told),
        "foreign" => foreign::run(bench, other, chance, told),
        "twice" => twice::run(bench, chance, told),
        "same" => same::run(bench, (other, flags.arm.as_deref()), told),
        "sizes" => sizes::run(bench, told),
        _ => hostile::run(bench.root, flags.seed, told),
    }
}

fn version(bench: &Bench) -> Result<String, String> {
    let output = Command::new(&bench.isolux).arg("--version").output();
    let output = output.map_err(|e| format!("cannot run {}: {e}", bench.isolux.display()))?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

fn read(file: &Path) -> Value {
    let text = std::fs::read(file).unwrap_or_default();
    serde_json::from_slice(&text).unwrap_or_else(|_| json!({}))
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    let folder = file.parent().unwrap_or(file);
    let made = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(file, text));
    made.map_err(|e| format!("{}: {e}", file.display()))
}
