//! A judge of walk-throughs: view3dscene, without a screen.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Shows both kinds of file of one map to the judge; they must come without a warning to the same picture. Where it
/// or a screen to draw on is missing, it is left out.
pub(crate) fn run(files: &[PathBuf; 2]) -> Result<String, String> {
    for tool in ["view3dscene", "xvfb-run"] {
        if Command::new("which").arg(tool).output().is_ok_and(|found| !found.status.success()) {
            return Ok(format!("skipped, as it is optional: {tool} is not installed"));
        }
    }
    let [one, other] = [drawn(&files[0])?, drawn(&files[1])?];
    if one != other {
        return Err("view3dscene draws .wrl and .x3d differently".to_owned());
    }
    // One colour all over would compress to less.
    if one.len() < 2048 {
        return Err(format!("view3dscene draws nothing: {} bytes", one.len()));
    }
    Ok("view3dscene draws .wrl and .x3d alike".to_owned())
}

/// The bytes of a picture of a file.
fn drawn(file: &Path) -> Result<Vec<u8>, String> {
    let picture = file.with_extension("png");
    let output = Command::new("xvfb-run")
        .args(["--auto-servernum", "view3dscene"])
        .arg(file)
        .args(["--screenshot", "0"])
        .arg(&picture)
        .args(["--geometry", "640x360"])
        .output()
        .map_err(|e| format!("cannot run xvfb-run: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    // It ends well on malformed files, too, and warns.
    if !output.status.success() || said.contains("Warning") {
        return Err(format!("view3dscene refuses {}: {said}", file.display()));
    }
    std::fs::read(&picture).map_err(|e| format!("{}: {e}", picture.display()))
}
