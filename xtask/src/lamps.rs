//! Judges of the reading of photometric files: Radiance's ies2rad and photompy, through Python.

use crate::built::built;
use crate::judge::optional;
use crate::peers::{python_of_judge, wait};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The version in `checks/photometry/requirements.txt`, whose source package has test files.
const PHOTOMPY: &str = "photompy==0.3.1";

/// Shows the files of `scenes/photometry`, and those of the source package of photompy, to the judges.
/// Without Python or a package index they are left out, except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let source = root.join("checks").join("photometry");
    let folder = root.join("target").join("judges-of-lamps");
    let needed = python_of_judge(&source, &folder)
        .and_then(|python| Ok((unpacked(&folder, &python)?, python)));
    optional(needed, |(samples, python)| {
        let mut judge = Command::new(python);
        judge.arg(source.join("judge.py")).arg("--isolux").arg(built(root)?);
        judge.arg("--accepted").arg(source.join("accepted.json"));
        for (name, files) in
            [("collection", root.join("scenes").join("photometry")), ("photompy", samples)]
        {
            judge.arg(format!("{name}={}", files.display()));
        }
        wait(&mut judge, "ies2rad and photompy")?;
        Ok("the judges read the lamps alike".to_owned())
    })
}

/// The test files of the source package of photompy, downloaded once.
fn unpacked(folder: &Path, python: &Path) -> Result<PathBuf, String> {
    let name = PHOTOMPY.replace("==", "-");
    let files = folder.join(&name).join("tests").join("data");
    if files.is_dir() {
        return Ok(files);
    }
    let download = ["-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", ":all:"];
    let mut pip = Command::new(python);
    wait(pip.args(download).arg(PHOTOMPY).arg("--dest").arg(folder), "pip download")?;
    let unpack = ["-m", "tarfile", "--filter", "data", "--extract"];
    let archive = folder.join(format!("{name}.tar.gz"));
    wait(Command::new(python).args(unpack).arg(archive).arg(folder), "tarfile")?;
    Ok(files)
}
