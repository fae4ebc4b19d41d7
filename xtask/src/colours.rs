//! A judge of differences of colours: colour-science, through Python.

use crate::judge::optional;
use crate::peers::{cargo, python_of_judge, wait};
use std::path::Path;
use std::process::Command;

/// Asks for the differences of many pairs of colours. Without Python or a package index it is left out,
/// except where `CI` is `true`.
pub(crate) fn run(root: &Path) -> Result<String, String> {
    let source = root.join("checks").join("colour");
    let folder = root.join("target").join("judge-of-colours");
    optional(python_of_judge(&source, &folder), |python| {
        let mut judge = Command::new(python);
        judge.arg(source.join("judge.py")).current_dir(root);
        judge.arg("--published").arg(source.join("sharma-2005.csv"));
        judge.arg("--").arg(cargo().get_program());
        judge.args(["run", "--quiet", "-p", "isolux-compare", "--example", "colour_differences"]);
        wait(&mut judge, "checks/colour/judge.py")?;
        Ok("colour-science finds the same differences of colours".to_owned())
    })
}
