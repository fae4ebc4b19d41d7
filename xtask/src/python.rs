//! The package for Python: its wheel, its tests, and whether its types are those of what runs.

use crate::judge::optional;
use crate::peers::{python_of_judge, wait};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds the wheel as tests are built, installs it into a folder of its own, and has pytest, mypy and stubtest look at it. Without Python
/// or a package index it is left out, except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let package = root.join("crates").join("isolux-python");
    let folder = root.join("target").join("python");
    optional(python_of_judge(&package.join("tests"), &folder), |python| {
        let wheel = wheel(&package, &folder.join("wheels"), &python)?;
        let module = |name: &str| {
            let mut module = Command::new(&python);
            module.current_dir(&package).args(["-m", name]);
            module
        };
        let install = ["install", "--quiet", "--no-deps", "--force-reinstall"];
        wait(module("pip").args(install).arg(&wheel), "pip install of the wheel")?;
        wait(&mut module("pytest"), "pytest")?;
        wait(module("mypy").args(["python/isolux", "tests"]), "mypy")?;
        wait(
            module("mypy.stubtest").args([
                "--concise",
                "--mypy-config-file",
                "pyproject.toml",
                "isolux",
            ]),
            "stubtest",
        )?;
        Ok("the package for Python passes its tests and is of its types".to_owned())
    })
}

/// Has pytest run what needs Ray: clusters of this machine, some of whose workers and nodes are killed.
pub(crate) fn cluster(root: &Path) -> Result<String, String> {
    let package = root.join("crates").join("isolux-python");
    let folder = root.join("target").join("python-cluster");
    optional(python_of_judge(&package.join("tests").join("cluster"), &folder), |python| {
        let wheel = wheel(&package, &folder.join("wheels"), &python)?;
        let install = ["-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall"];
        wait(Command::new(&python).args(install).arg(&wheel), "pip install of the wheel")?;
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
