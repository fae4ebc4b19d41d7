//! A judge of differences of colours: colour-science, through Python.

use crate::judge::is_ci;
use crate::lamps::has_python;
use crate::peers::{cargo, environment, wait};
use std::path::Path;
use std::process::Command;

/// Asks for the differences of many pairs of colours. Without Python or a package index it is left out,
/// except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let source = root.join("checks").join("colour");
    let folder = root.join("target").join("judge-of-colours");
    let found = has_python().and_then(|()| {
        std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        environment(&source, &folder.join("venv"))
    });
    let python = match found {
        Ok(python) => python,
        Err(missing) if is_ci() => return Err(format!("not optional with CI=true: {missing}")),
        Err(missing) => return Ok(format!("skipped, as it is optional: {missing}")),
    };
    let mut judge = Command::new(python);
    judge.arg(source.join("judge.py")).current_dir(root);
    judge.arg("--published").arg(source.join("sharma-2005.csv"));
    judge.arg("--").arg(cargo().get_program());
    judge.args(["run", "--quiet", "-p", "isolux-compare", "--example", "colour_differences"]);
    wait(&mut judge, "checks/colour/judge.py")?;
    Ok("colour-science finds the same differences of colours".to_owned())
}
