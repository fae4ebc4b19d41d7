//! Hostile files that readers were shown: those of the test `hostile` of `isolux-formats`.

use super::told::Told;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// Runs the test, and counts what it has tried.
pub(super) fn run(root: &Path, seed: u64, told: &mut Told) -> Result<Value, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args([
        "test",
        "--quiet",
        "-p",
        "isolux-formats",
        "--test",
        "hostile",
        "--",
        "--nocapture",
    ]);
    command.env("HOSTILE_SEED", seed.to_string()).current_dir(root);
    let output = command.output().map_err(|e| format!("cannot run cargo test: {e}"))?;
    let said = String::from_utf8_lossy(&output.stdout);
    let rows: Vec<Value> = said.lines().filter_map(row).collect();
    let is_fine = output.status.success() && !rows.is_empty();
    told.expect(is_fine, || {
        let why = String::from_utf8_lossy(&output.stderr);
        format!("the test `hostile` fails: {said}{why}")
    });
    told.step("hostile files");
    Ok(Value::Array(rows))
}

/// `rad: 412 of 1000 are read`.
fn row(line: &str) -> Option<Value> {
    let (reader, counts) = line.split_once(": ")?;
    let (read, tried) = counts.strip_suffix(" are read")?.split_once(" of ")?;
    let [read, tried] = [read.parse::<u64>().ok()?, tried.parse::<u64>().ok()?];
    Some(json!({ "reader": reader, "tried": tried, "read": read }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_of_what_the_test_says() {
        assert_eq!(
            row("rad: 412 of 1000 are read"),
            Some(json!({"reader": "rad", "tried": 1000, "read": 412}))
        );
        assert_eq!(row("test hostile_files_do_no_harm ... ok"), None);
    }
}
