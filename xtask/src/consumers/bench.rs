//! What all checks of consumers share: the card, the command, and codes of colours.

use crate::smoke::CARD;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Half a code of eight bits, and half floats of the buffer behind it (2^-11 of the light, 0.05 codes). Measured: 0.18.
pub(super) const CODES: f64 = 0.6;

/// A folder for the work, and the command as it is shipped.
pub(super) struct Bench<'a> {
    pub(super) root: &'a Path,
    pub(super) folder: PathBuf,
    pub(super) isolux: PathBuf,
}

impl Bench<'_> {
    /// Light at the vertices of a map for a consumer, and what its colours show as white, cd/m2.
    pub(super) fn vertices(
        &self,
        map: &Path,
        name: &str,
        target: &str,
    ) -> Result<(PathBuf, f64), String> {
        let file = self.folder.join(name);
        let way = ["--target", target, "--json"];
        let said =
            self.isolux(&[&["export", &text(map), "-o", &text(&file)], &way[..]].concat())?;
        let said: serde_json::Value = serde_json::from_str(&said).map_err(|e| e.to_string())?;
        let white = said["white_cd_m2"].as_f64().ok_or("export does not say `white_cd_m2`")?;
        Ok((file, white))
    }

    /// A lightmap of a map for a consumer.
    pub(super) fn lightmap(
        &self,
        map: &Path,
        name: &str,
        target: &str,
        density: &[&str],
    ) -> Result<PathBuf, String> {
        let file = self.folder.join(name);
        let into = ["export", &text(map), "-o", &text(&file)];
        let way = ["--layout", "texels", "--target", target];
        self.isolux(&[&into[..], &way, density].concat())?;
        Ok(file)
    }

    /// What the command prints.
    pub(super) fn isolux(&self, arguments: &[&str]) -> Result<String, String> {
        let line = format!("isolux {}", arguments.join(" "));
        let output = Command::new(&self.isolux).args(arguments).output();
        match output {
            Ok(output) if output.status.success() => {
                Ok(String::from_utf8_lossy(&output.stdout).into_owned())
            }
            Ok(output) => Err(format!("{line}: {}", String::from_utf8_lossy(&output.stderr))),
            Err(e) => Err(format!("cannot run {line}: {e}")),
        }
    }
}

/// Of the card.
pub(super) fn luminance_cd_m2() -> f64 {
    CARD.reflectance * CARD.illuminance_lx / std::f64::consts::PI
}

/// IEC 61966-2-1.
pub(super) fn srgb(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

pub(super) fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// The codes that a judge prints.
pub(super) fn codes(said: &str) -> Option<Vec<f64>> {
    let line = said.lines().find_map(|line| line.strip_prefix("codes "))?;
    let codes: Option<Vec<f64>> = line.split(' ').map(|code| code.parse().ok()).collect();
    codes.filter(|codes| codes.len() == 3)
}
