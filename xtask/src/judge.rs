//! Judges outside the workspace: the glTF validator and three.js, through node.

use crate::smoke::{Card, Made};
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

const JUDGES: [&str; 2] = ["validate.mjs", "three.mjs"];

/// What `lightmap.mjs` ends with where there is no browser.
const NO_BROWSER: i32 = 77;

/// Shows a map and what is made of it for engines to the judges. Without node they are left out, except where `CI` is `true`.
pub(crate) fn run(root: &Path, made: &Made) -> Result<String, String> {
    let folder = root.join("checks");
    if !folder.join("package.json").is_file() {
        return Ok("skipped: there is no checks/".to_owned());
    }
    let needed = missing_for_node(&folder).map_or(Ok(()), |missing| Err(missing.to_owned()));
    optional(needed, |()| show(&folder, made))
}

fn show(folder: &Path, made: &Made) -> Result<String, String> {
    for judge in JUDGES {
        accept(folder, judge, &[made.map.as_os_str()])?;
    }
    let Card { file, vertices, onto, reflectance, illuminance_lx } = &made.card;
    let files = made.for_engines.iter().chain([file, vertices, onto]);
    accept(folder, "validate.mjs", &files.map(|file| file.as_os_str()).collect::<Vec<_>>())?;
    let [reflectance, illuminance_lx] = [reflectance, illuminance_lx].map(ToString::to_string);
    let known = [OsStr::new(&reflectance), OsStr::new(&illuminance_lx)];
    let card = [&[file.as_os_str(), vertices.as_os_str(), onto.as_os_str()], &known[..]].concat();
    match node(folder, "lightmap.mjs", &card)? {
        Some(0) => Ok("the judges accept the map and what is made of it for engines".to_owned()),
        Some(NO_BROWSER) => {
            Ok("the judges accept the map and what is made of it for engines, but three.js drew \
             none of it: install chromium, or name it in CHROMIUM"
                .to_owned())
        }
        _ => Err(format!("checks/lightmap.mjs refuses {}", file.display())),
    }
}

fn accept(folder: &Path, judge: &str, files: &[&OsStr]) -> Result<(), String> {
    match node(folder, judge, files)? {
        Some(0) => Ok(()),
        _ => Err(format!("checks/{judge} refuses one of {files:?}")),
    }
}

/// The exit code of a judge.
fn node(folder: &Path, judge: &str, arguments: &[&OsStr]) -> Result<Option<i32>, String> {
    let status = Command::new("node").arg(judge).args(arguments).current_dir(folder).status();
    status.map(|status| status.code()).map_err(|e| format!("cannot run node: {e}"))
}

/// Whether nothing may be left out.
pub(crate) fn is_ci() -> bool {
    std::env::var_os("CI").is_some_and(|value| value == "true")
}

/// Has judges look that need something that may not be there; without it they are left out, except where `CI` is `true`.
pub(crate) fn optional<T>(
    needed: Result<T, String>,
    judge: impl FnOnce(T) -> Result<String, String>,
) -> Result<String, String> {
    match needed {
        Ok(found) => judge(found),
        Err(missing) if is_ci() => Err(format!("not optional with CI=true: {missing}")),
        Err(missing) => Ok(format!("skipped, as it is optional: {missing}")),
    }
}

/// What keeps the judges of a folder from running.
pub(crate) fn missing_for_node(folder: &Path) -> Option<&'static str> {
    let node = Command::new("node").arg("--version").output();
    if !node.is_ok_and(|output| output.status.success()) {
        return Some("node is not installed");
    }
    (!folder.join("node_modules").is_dir()).then_some("run `npm ci` in checks/ first")
}
