//! Judges outside the workspace: the glTF validator and three.js, through node.

use std::path::Path;
use std::process::Command;

const JUDGES: [&str; 2] = ["validate.mjs", "three.mjs"];

/// Shows a map to the judges. Without node they are left out, except where `CI` is `true`.
pub(crate) fn run(root: &Path, map: &Path) -> Result<String, String> {
    let folder = root.join("checks");
    if !folder.join("package.json").is_file() {
        return Ok("skipped: there is no checks/".to_owned());
    }
    if let Some(missing) = missing_for_node(&folder) {
        let message = format!("skipped, as it is optional: {missing}");
        return if is_ci() {
            Err(format!("not optional with CI=true: {missing}"))
        } else {
            Ok(message)
        };
    }
    for judge in JUDGES {
        let status = Command::new("node")
            .arg(judge)
            .arg(map)
            .current_dir(&folder)
            .status()
            .map_err(|e| format!("cannot run node: {e}"))?;
        if !status.success() {
            return Err(format!("checks/{judge} refuses {}", map.display()));
        }
    }
    Ok("the judges accept the map".to_owned())
}

/// Whether nothing may be left out.
pub(crate) fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|value| value == "true")
}

/// What keeps the judges of a folder from running.
pub(crate) fn missing_for_node(folder: &Path) -> Option<&'static str> {
    let node = Command::new("node").arg("--version").output();
    if !node.is_ok_and(|output| output.status.success()) {
        return Some("node is not installed");
    }
    (!folder.join("node_modules").is_dir()).then_some("run `npm ci` in checks/ first")
}
