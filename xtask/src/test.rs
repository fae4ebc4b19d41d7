//! Everything that must hold before a change lands, in one command.

use crate::{colours, compared, grids, judge, lamps, page, peers, smoke, tidy, walk, worlds};
use std::path::Path;
use std::process::Command;

const CARGO_STEPS: [&[&str]; 2] = [
    &["fmt", "--all", "--check"],
    &["clippy", "--quiet", "--workspace", "--all-targets", "--", "-D", "warnings"],
];

/// Runs all of it; the error names the first step that failed.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    for step in CARGO_STEPS {
        cargo(root, step)?;
    }
    announce("tidy");
    println!("{}", tidy::run(root)?);
    cargo(root, &["test", "--workspace"])?;
    println!("{}", smoke_and_judge(root)?);
    announce("page of the walk-through");
    println!("{}", page::run(root)?);
    announce("outside judge of the walk-through: Chromium");
    println!("{}", walk::run(root)?);
    announce("comparison of all systems, as short as it can be");
    println!("{}", compared::run(root)?);
    announce("outside judges of photometric files: ies2rad, photompy");
    println!("{}", lamps::run(root)?);
    announce("outside judge of differences of colours: colour-science");
    println!("{}", colours::run(root)?);
    announce("scripts of the bench of peers");
    println!("{}", peers::check(root)?);
    Ok("all fine".to_owned())
}

/// Runs the command line as a user does, and shows its map to judges outside the workspace.
pub(crate) fn smoke_and_judge(root: &Path) -> Result<String, String> {
    announce("smoke test of the command line");
    let made = smoke::run(root)?;
    announce("outside judges of the map: glTF validator, three.js");
    println!("{}", judge::run(root, &made)?);
    announce("outside judges of pictures: view3dscene, X_ITE, three.js");
    println!("{}", worlds::run(root, &made.room)?);
    announce("outside judges of grids: VTK, PyVista");
    grids::run(root, &made.room)
}

fn announce(step: &str) {
    println!("== {step}");
}

fn cargo(root: &Path, arguments: &[&str]) -> Result<(), String> {
    let line = format!("cargo {}", arguments.join(" "));
    announce(&line);
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo).args(arguments).current_dir(root).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(format!("failed: {line}")),
        Err(e) => Err(format!("cannot run {line}: {e}")),
    }
}
