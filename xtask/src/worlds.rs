//! Judges of pictures: view3dscene and X_ITE of walk-throughs, three.js of the map itself, without a screen.

use crate::judge::{is_ci, missing_for_node};
use crate::peers::wait;
use crate::smoke::{PICTURE_SIZE, PICTURE_WHITE_CD_M2, Room};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Shows both kinds of file of one map to the judges; each must draw both alike and without a warning, and
/// all pictures are compared with one of isolux. A judge that is missing, or a screen to draw on, is left out.
pub(crate) fn run(root: &Path, room: &Room) -> Result<String, String> {
    let mut said = Vec::new();
    let mut pictures = Vec::new();
    match missing_for_view3dscene() {
        Some(missing) => said.push(format!("view3dscene skipped, as it is optional: {missing}")),
        None => pictures.push(by_view3dscene(&room.worlds)?),
    }
    let checks = root.join("checks");
    match missing_for_pages(&checks)? {
        None => pictures.extend(by_x_ite(&checks, &room.worlds)?),
        Some(missing) => {
            said.push(format!("X_ITE and three.js skipped, as they are optional: {missing}"));
            return Ok(said.join("\n"));
        }
    }
    compare(&checks, room, &pictures, &[])?;
    let shown = room.map.with_file_name("three-map.png");
    drawn_by_node(&checks, [(&room.map, &shown)])?;
    compare(&checks, room, &[shown], &["--light"])?;
    said.push("the browsers of worlds, and three.js, draw what isolux does".to_owned());
    Ok(said.join("\n"))
}

fn missing_for_view3dscene() -> Option<String> {
    let is_missing = |tool: &&str| {
        Command::new("which").arg(tool).output().is_ok_and(|found| !found.status.success())
    };
    let tool = ["view3dscene", "xvfb-run"].into_iter().find(is_missing)?;
    Some(format!("{tool} is not installed"))
}

const BROWSERS: [&str; 3] =
    ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/// What keeps pages from being shown; an error where `CI` is `true` and it is not the browser alone.
pub(crate) fn missing_for_pages(checks: &Path) -> Result<Option<String>, String> {
    match missing_for_node(checks).map(str::to_owned) {
        Some(missing) if is_ci() => Err(format!("not optional with CI=true: {missing}")),
        missing => Ok(missing.or_else(missing_browser)),
    }
}

fn missing_browser() -> Option<String> {
    let is_named = std::env::var_os("CHROMIUM").is_some();
    let is_there = is_named || BROWSERS.iter().any(|path| Path::new(path).is_file());
    (!is_there).then(|| "Chromium is not installed, nor named in CHROMIUM".to_owned())
}

/// The picture of both files, which must be the same.
fn by_view3dscene(files: &[PathBuf; 2]) -> Result<PathBuf, String> {
    let pictures = [drawn(&files[0], "view-wrl.png")?, drawn(&files[1], "view-x3d.png")?];
    let bytes =
        |path: &PathBuf| std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()));
    let [one, other] = [bytes(&pictures[0])?, bytes(&pictures[1])?];
    if one != other {
        return Err("view3dscene draws .wrl and .x3d differently".to_owned());
    }
    // One colour all over would compress to less.
    if one.len() < 2048 {
        return Err(format!("view3dscene draws nothing: {} bytes", one.len()));
    }
    let [picture, _] = pictures;
    Ok(picture)
}

/// A picture of a file.
fn drawn(file: &Path, name: &str) -> Result<PathBuf, String> {
    let picture = file.with_file_name(name);
    let output = Command::new("xvfb-run")
        .args(["--auto-servernum", "view3dscene"])
        .arg(file)
        .args(["--screenshot", "0"])
        .arg(&picture)
        .args(["--geometry", PICTURE_SIZE])
        .output()
        .map_err(|e| format!("cannot run xvfb-run: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    // It ends well on malformed files, too, and warns.
    if !output.status.success() || said.contains("Warning") {
        return Err(format!("view3dscene refuses {}: {said}", file.display()));
    }
    Ok(picture)
}

fn by_x_ite(checks: &Path, files: &[PathBuf; 2]) -> Result<[PathBuf; 2], String> {
    let pictures = ["x-ite-wrl.png", "x-ite-x3d.png"];
    let pictures = [0, 1].map(|k| files[k].with_file_name(pictures[k]));
    drawn_by_node(checks, files.iter().zip(&pictures))?;
    Ok(pictures)
}

/// Pictures of files, by headless Chromium.
fn drawn_by_node<'a>(
    checks: &Path,
    files: impl IntoIterator<Item = (&'a PathBuf, &'a PathBuf)>,
) -> Result<(), String> {
    let mut node = Command::new("node");
    node.args(["worlds.mjs", PICTURE_SIZE]).current_dir(checks);
    for (file, picture) in files {
        node.arg(file).arg(picture);
    }
    wait(&mut node, "checks/worlds.mjs")
}

fn compare(checks: &Path, room: &Room, pictures: &[PathBuf], how: &[&str]) -> Result<(), String> {
    let mut node = Command::new("node");
    node.arg("pictures.mjs").args(how).current_dir(checks);
    node.args(["--exposure", &room.exposure_m2_cd.to_string()]);
    node.args(["--white", &room.white_cd_m2.to_string()]);
    node.args(["--full", &PICTURE_WHITE_CD_M2.to_string()]);
    node.arg(&room.picture).args(pictures);
    wait(&mut node, "checks/pictures.mjs")
}
