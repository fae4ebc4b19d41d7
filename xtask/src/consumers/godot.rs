//! Godot 3, as Debian has it.

use super::bench::{Bench, CODES, codes, luminance_cd_m2, srgb};
use crate::smoke::PICTURE_WHITE_CD_M2;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What shows as white in Godot's picture of the card, which has 127 cd/m2.
const EXPOSURE_M2_CD: f64 = 1.0 / PICTURE_WHITE_CD_M2;

/// Shows the card to Godot, as texels and with its light at vertices.
pub(super) fn show(bench: &Bench<'_>, card: &Path) -> Result<String, String> {
    let is_missing = |tool: &&str| {
        Command::new("which").arg(tool).output().map_or(true, |found| !found.status.success())
    };
    if let Some(tool) = ["godot3", "xvfb-run"].iter().find(|tool| is_missing(tool)) {
        return Ok(format!("Godot skipped: {tool} is not installed (Debian: godot3, xvfb)"));
    }
    // A project each: Godot keeps materials by their names.
    let texels = project(bench, "godot")?;
    bench.lightmap(card, "godot/card.glb", "godot", &["--texels-per-meter", "16"])?;
    let energy = luminance_cd_m2() * EXPOSURE_M2_CD;
    let texels = shows(&texels, energy, [energy; 2])?;
    let vertices = project(bench, "godot-vertices")?;
    let (_, white_cd_m2) = bench.vertices(card, "godot-vertices/card.glb", "godot")?;
    // Kept in 8 bits, of which the last is cut.
    let share = luminance_cd_m2() / white_cd_m2;
    let kept = (255.0 * share).floor() / 255.0;
    let vertices = shows(&vertices, 0.0, [kept, share])?;
    Ok(format!("Godot shows rho E / pi: {texels}; with light at vertices {vertices}"))
}

fn project(bench: &Bench<'_>, name: &str) -> Result<PathBuf, String> {
    let project = bench.folder.join(name);
    std::fs::create_dir_all(&project).map_err(|e| format!("{}: {e}", project.display()))?;
    for file in ["project.godot", "judge.gd"] {
        let source = bench.root.join("checks").join("godot").join(file);
        std::fs::copy(&source, project.join(file))
            .map_err(|e| format!("{}: {e}", source.display()))?;
    }
    Ok(project)
}

/// The codes that Godot shows in the middle of `card.glb`, which are to lie between those of two shares of white.
fn shows(project: &Path, energy: f64, due: [f64; 2]) -> Result<String, String> {
    // The editor imports what it finds, and ends.
    godot(project, &["--editor", "--quit"])?;
    let said = godot(project, &["-s", "judge.gd", &energy.to_string()])?;
    let [least, most] = due.map(|share| 255.0 * srgb(share));
    let is_due = |code: &f64| (least - CODES..=most + CODES).contains(code);
    match codes(&said) {
        Some(codes) if codes.iter().all(is_due) => {
            Ok(format!("codes {codes:.2?}, due are {least:.2} to {most:.2}"))
        }
        codes => Err(format!("Godot shows {codes:?} in place of {least:.2} to {most:.2}: {said}")),
    }
}

/// What Godot prints. It complains of sound and of locales, and ends well.
fn godot(project: &Path, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new("xvfb-run")
        .args(["--auto-servernum", "godot3", "--path"])
        .arg(project)
        .args(["--video-driver", "GLES3", "--audio-driver", "Dummy"])
        .args(arguments)
        .output()
        .map_err(|e| format!("cannot run xvfb-run: {e}"))?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}
