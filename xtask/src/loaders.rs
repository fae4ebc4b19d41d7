//! Judges of the loaders: what other software reads of a map, beside what the command says of it.

mod bevy;

use crate::built::built;
use crate::judge::optional;
use crate::peers::{python_of_judge, wait};
use crate::worlds::missing_for_pages;
use std::path::Path;
use std::process::Command;

/// `loaders/three` in Chromium. Without Node or a browser it is left out; where `CI` is `true`, without a browser alone.
pub(crate) fn three(root: &Path) -> Result<String, String> {
    let checks = root.join("checks");
    if let Some(missing) = missing_for_pages(&checks)? {
        return Ok(format!("skipped, as it is optional: {missing}"));
    }
    let mut node = Command::new("node");
    node.arg("loader-three.mjs").arg(built(root)?).current_dir(&checks);
    wait(&mut node, "checks/loader-three.mjs")?;
    Ok("loaders/three reads, dims and shows what the command does".to_owned())
}

/// The add-on of Blender, in Blender as a module of Python. Without Python 3.11 or a package index it is left out.
pub(crate) fn blender(root: &Path) -> Result<String, String> {
    let source = root.join("checks").join("blender-addon");
    let python = python_of_judge(&source, &root.join("target").join("judge-of-blender"));
    optional(python.map_err(|e| format!("{e}; bpy needs Python 3.11 as python3")), |python| {
        let mut judge = Command::new(python);
        judge.arg("-B").arg(source.join("judge.py")).arg(built(root)?);
        judge.arg(root.join("loaders").join("blender"));
        wait(&mut judge, "checks/blender-addon/judge.py")?;
        Ok("loaders/blender brings the light to Blender that the command computes".to_owned())
    })
}

/// The loader of Bevy, without a window. Without its crates it is left out.
pub(crate) fn bevy(root: &Path) -> Result<String, String> {
    optional(bevy::fetched(root), |()| bevy::run(root))
}
