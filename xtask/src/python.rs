//! The package for Python: its wheel, its tests, and whether its types are those of what runs.

use crate::judge::optional;
use crate::peers::{python_of_judge, wait};
use crate::worlds::missing_for_pages;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Those of `crates/isolux-python/notebooks`.
const NOTEBOOKS: [&str; 3] = ["office", "cube", "positions"];

/// Builds the wheel as tests are built, installs it into a folder of its own, and has pytest, mypy and stubtest look at it. Without Python
/// or a package index it is left out, except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let package = root.join("crates").join("isolux-python");
    let folder = root.join("target").join("python");
    optional(python_of_judge(&package.join("tests"), &folder), |python| {
        install(&package, &folder, &python)?;
        let module = |name: &str| module(&python, &package, name);
        wait(&mut module("pytest"), "pytest")?;
        wait(module("mypy").args(["python/isolux", "tests"]), "mypy")?;
        wait(
            module("mypy.stubtest").args([
                "--concise",
                "--mypy-config-file",
                "pyproject.toml",
                "isolux._native",
            ]),
            "stubtest",
        )?;
        Ok("the package for Python passes its tests and is of its types".to_owned())
    })
}

/// The example notebooks, run and made pages, and tests with all the packages that maps are exchanged with. Left out as [`run`] is.
pub(crate) fn notebooks(root: &Path) -> Result<String, String> {
    let package = root.join("crates").join("isolux-python");
    let (source, folder) =
        (package.join("notebooks"), root.join("target").join("python-notebooks"));
    optional(python_of_judge(&source, &folder), |python| {
        install(&package, &folder, &python)?;
        wait(module(&python, &package, "pytest").arg("notebooks/tests"), "pytest")?;
        let pages = folder.join("pages");
        let _ = std::fs::remove_dir_all(&pages);
        let mut convert = module(&python, &source, "nbconvert");
        convert.args(["--execute", "--to", "html", "--output-dir"]).arg(&pages);
        for name in NOTEBOOKS {
            convert.arg(format!("{name}.ipynb"));
        }
        wait(&mut convert, "nbconvert")?;
        let shown = NOTEBOOKS.map(|name| pages.join(format!("{name}.html")));
        let drawn = walked(root, &shown)?;
        Ok(format!("the notebooks run, into {}; {drawn}", pages.display()))
    })
}

/// Whether the walk-throughs in pages draw and read.
fn walked(root: &Path, pages: &[PathBuf]) -> Result<&'static str, String> {
    let checks = root.join("checks");
    if missing_for_pages(&checks)?.is_some() {
        return Ok("there is no browser to look at them");
    }
    let mut node = Command::new("node");
    node.arg("notebooks.mjs").args(pages).current_dir(&checks);
    wait(&mut node, "checks/notebooks.mjs")?;
    Ok("their walk-throughs draw and read")
}

fn module(python: &Path, folder: &Path, name: &str) -> Command {
    let mut module = Command::new(python);
    module.current_dir(folder).args(["-m", name]);
    module
}

/// Builds the wheel and installs it.
fn install(package: &Path, folder: &Path, python: &Path) -> Result<(), String> {
    let wheel = wheel(package, &folder.join("wheels"), python)?;
    let words = ["install", "--quiet", "--no-deps", "--force-reinstall"];
    wait(module(python, package, "pip").args(words).arg(&wheel), "pip install of the wheel")
}

/// Has pytest run what needs Ray: clusters of this machine, some of whose workers and nodes are killed.
pub(crate) fn cluster(root: &Path) -> Result<String, String> {
    let package = root.join("crates").join("isolux-python");
    let folder = root.join("target").join("python-cluster");
    optional(python_of_judge(&package.join("tests").join("cluster"), &folder), |python| {
        install(&package, &folder, &python)?;
        let test = ["-m", "pytest", "-m", "cluster"];
        wait(Command::new(&python).current_dir(&package).args(test), "pytest")?;
        Ok("runs and studies on clusters of Ray pass their tests".to_owned())
    })
}

/// Builds the wheel; where it is.
fn wheel(package: &Path, folder: &Path, python: &Path) -> Result<PathBuf, String> {
    // Of earlier versions, too.
    let _ = std::fs::remove_dir_all(folder);
    let mut maturin = Command::new(python);
    maturin.args(["-m", "maturin", "build", "--quiet", "--profile", "dev", "--interpreter"]);
    maturin.arg(python).arg("--out").arg(folder).current_dir(package);
    wait(&mut maturin, "maturin")?;
    let built = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut wheels = built.filter_map(|entry| Some(entry.ok()?.path()));
    wheels.next().ok_or_else(|| "maturin has made no wheel".to_owned())
}
