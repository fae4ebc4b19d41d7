//! Everything that must hold before a change lands, in one command.

use crate::smoke::isolux;
use crate::{
    colours, compared, golden, grids, judge, lamps, loaders, page, peers, python, sanitize, smoke,
    tidy, walk, worlds,
};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

const CARGO_STEPS: [&[&str]; 2] = [
    &["fmt", "--all", "--check"],
    &["clippy", "--quiet", "--workspace", "--all-targets", "--", "-D", "warnings"],
];

/// What every change must pass. With `all` more judges look at what the command line made.
fn every_change(all: bool) -> [Step; 6] {
    [
        ("tidy", tidy::run),
        ("cargo test --workspace", |root| cargo(root, &["test", "--workspace"])),
        (
            "the command line as a user runs it, and what it made before judges outside of the workspace",
            if all { smoke_and_judge } else { smoke },
        ),
        ("page of the walk-through", page::run),
        ("scripts of the bench of peers", peers::check),
        ("the package for Python: pytest, mypy, stubtest", python::run),
    ]
}

/// What takes longer or changes less, and must hold before a release.
const ALL: [Step; 15] = [
    ("outside judge of the walk-through: Chromium", walk::run),
    ("outside judge of the loader of three.js: Chromium", loaders::three),
    ("outside judges of photometric files: ies2rad, photompy", lamps::run),
    ("outside judge of differences of colours: colour-science", colours::run),
    ("the package for Python on clusters of Ray", python::cluster),
    ("the ray kernel under the address sanitizer", sanitize::run),
    ("slow tests", |root| {
        let tests = ["test", "--workspace", "--", "--ignored", "--skip", BILLION];
        cargo(root, &tests)
    }),
    ("reports as PDF", |root| {
        cargo(root, &["test", "--package", "isolux-report", "--features", "pdf"])
    }),
    ("a billion rays in a closed hall", |root| {
        let kernel = ["test", "--release", "--quiet", "--package", "isolux-geometry"];
        cargo(root, &[&kernel[..], &["--", "--ignored", "--exact", BILLION]].concat())
    }),
    ("comparison of all systems, as short as it can be", compared::run),
    ("outside judge of the add-on of Blender: Blender", loaders::blender),
    ("outside judge of the loader of Bevy: its crates", loaders::bevy),
    ("golden maps", |root| golden::run(root, &[])),
    ("example notebooks of Python", python::notebooks),
    ("validation against exact values", validate),
];

/// The test of a billion rays.
const BILLION: &str = "watertight::nothing_leaves_the_hall_in_a_billion_rays";

/// What is done, and how.
type Step = (&'static str, fn(&Path) -> Result<String, String>);

/// Runs what every change must pass, and with `all` the rest; the error names the first step that failed.
pub(crate) fn run(root: &Path, all: bool) -> Result<String, String> {
    for step in CARGO_STEPS {
        timed((&format!("cargo {}", step.join(" ")), || cargo(root, step)))?;
    }
    for (name, step) in every_change(all) {
        timed((name, || step(root)))?;
    }
    if all {
        for (name, step) in ALL {
            timed((name, || step(root)))?;
        }
    }
    Ok("all fine".to_owned())
}

/// Runs the command line as a user does, and shows its map to the glTF validator and to three.js.
fn smoke(root: &Path) -> Result<String, String> {
    judge::run(root, &smoke::run(root)?)
}

/// Runs the command line as a user does, and shows all that it made to them, view3dscene, X_ITE, VTK and PyVista.
pub(crate) fn smoke_and_judge(root: &Path) -> Result<String, String> {
    let made = smoke::run(root)?;
    let judged = judge::run(root, &made)?;
    let worlds = worlds::run(root, &made.room)?;
    Ok([judged, worlds, grids::run(root, &made.room)?].join("\n"))
}

/// Every method against the exact values of its cases.
fn validate(root: &Path) -> Result<String, String> {
    isolux(root, &["validate"]).map(|_| "all methods pass".to_owned())
}

/// Announces a step, runs it, and says what came of it and how long it took.
fn timed<F: FnOnce() -> Result<String, String>>((name, step): (&str, F)) -> Result<(), String> {
    println!("== {name}");
    let started = Instant::now();
    let said = step()?;
    let seconds = started.elapsed().as_secs_f64();
    if !said.is_empty() {
        println!("{said}");
    }
    println!("-- {seconds:.0} s: {name}");
    Ok(())
}

fn cargo(root: &Path, arguments: &[&str]) -> Result<String, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo).args(arguments).current_dir(root).status();
    let line = arguments.join(" ");
    match status {
        Ok(status) if status.success() => Ok(String::new()),
        Ok(_) => Err(format!("failed: cargo {line}")),
        Err(e) => Err(format!("cannot run cargo {line}: {e}")),
    }
}
