//! Bevy, built from its crates: several hundred, which takes minutes.

use super::bench::{Bench, CODES, codes, luminance_cd_m2, srgb, text};
use crate::peers::wait;
use crate::smoke::PICTURE_WHITE_CD_M2;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where Debian's drivers of Vulkan say that they are there.
const DRIVERS: &str = "/usr/share/vulkan/icd.d";

/// Shows the card to Bevy, as texels and with its light at vertices.
pub(super) fn show(bench: &Bench<'_>, map: &Path) -> Result<String, String> {
    let has_driver = std::fs::read_dir(DRIVERS).is_ok_and(|mut found| found.next().is_some());
    if !has_driver {
        let why =
            format!("there is no driver of Vulkan in {DRIVERS} (Debian: mesa-vulkan-drivers)");
        return Ok(format!("Bevy skipped: {why}"));
    }
    let judge = match build(bench) {
        Ok(judge) => judge?,
        Err(missing) => return Ok(format!("Bevy skipped: {missing}")),
    };
    let folder = |name: &str| {
        let folder = bench.folder.join(name);
        let made = std::fs::create_dir_all(&folder);
        made.map(|()| folder.clone()).map_err(|e| format!("{}: {e}", folder.display()))
    };
    let (texels, vertices) = (folder("bevy-texels")?, folder("bevy-vertices")?);
    bench.lightmap(map, "bevy-texels/card.glb", "bevy", &["--texels-per-meter", "16"])?;
    let (_, white_cd_m2) = bench.vertices(map, "bevy-vertices/card.glb", "bevy")?;
    let exposed = ["texels", &PICTURE_WHITE_CD_M2.to_string()];
    let texels = shows(&judge, (&texels, &exposed), PICTURE_WHITE_CD_M2)?;
    let vertices = shows(&judge, (&vertices, &["vertices"]), white_cd_m2)?;
    Ok(format!("Bevy shows rho E / pi: {texels}; with light at vertices {vertices}"))
}

/// Builds the judge; the outer error says what is missing for it.
fn build(bench: &Bench<'_>) -> Result<Result<PathBuf, String>, String> {
    let cargo = || {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.current_dir(bench.root.join("checks").join("bevy"));
        cargo
    };
    wait(cargo().args(["fetch", "--quiet", "--locked"]), "cargo fetch in checks/bevy")?;
    println!("building Bevy, which takes minutes the first time");
    let target = bench.folder.join("bevy");
    let arguments = ["build", "--quiet", "--locked", "--target-dir", &text(&target)];
    let built = wait(cargo().args(arguments), "cargo build in checks/bevy");
    let name = format!("isolux-bevy-judge{}", std::env::consts::EXE_SUFFIX);
    Ok(built.map(|()| target.join("debug").join(name)))
}

/// The codes in the middle of the picture, which are whole ones.
fn shows(
    judge: &Path,
    (folder, way): (&Path, &[&str]),
    white_cd_m2: f64,
) -> Result<String, String> {
    let output = Command::new(judge)
        .arg(folder)
        .args(way)
        .output()
        .map_err(|e| format!("cannot run {}: {e}", judge.display()))?;
    let said = String::from_utf8_lossy(&output.stdout);
    let due = 255.0 * srgb(luminance_cd_m2() / white_cd_m2);
    match codes(&said) {
        Some(codes) if codes.iter().all(|c| (c - due).abs() <= CODES) => {
            Ok(format!("codes {codes:?}, due are {due:.2}"))
        }
        codes => {
            let complaint = String::from_utf8_lossy(&output.stderr);
            Err(format!("Bevy shows {codes:?} in place of {due:.2}: {complaint}"))
        }
    }
}
