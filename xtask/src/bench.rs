//! The bench of the ray kernel, and the Embree it is measured beside.

use std::path::Path;
use std::process::Command;

/// A Python wheel of Embree 4.4: its shared libraries without a package of the system.
const WHEEL: &str = "embreex==4.4.0.post1";

/// Measures rays; the arguments go on to the bench.
pub(crate) fn rays(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["run", "--release", "--quiet", "--package", "isolux-bench", "--bin", "rays"]);
    run(command.arg("--").args(arguments).current_dir(root), "the bench")?;
    Ok(String::new())
}

/// Downloads Embree and unpacks it into `target/embree`.
pub(crate) fn setup(root: &Path) -> Result<String, String> {
    let folder = root.join("target").join("embree");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let download = ["-m", "pip", "download", "--no-deps", "--only-binary", ":all:", WHEEL];
    run(Command::new("python3").args(download).current_dir(&folder), "pip")?;
    let entries = std::fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for wheel in entries.flatten().map(|entry| entry.path()) {
        if wheel.extension().is_some_and(|ending| ending == "whl") {
            let unpack = ["-m", "zipfile", "-e"];
            let mut command = Command::new("python3");
            run(command.args(unpack).arg(&wheel).arg(&folder), "zipfile")?;
        }
    }
    Ok(format!("{WHEEL} is in target/embree"))
}

fn run(command: &mut Command, what: &str) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what}: {status}")),
        Err(e) => Err(format!("cannot run {what}: {e}")),
    }
}
