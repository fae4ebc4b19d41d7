//! The scenes, their places and their files.

use super::bounded::Isolux;
use crate::peers::cargo;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

/// Places by area, and in every other stratum.
const PLACES: [&str; 2] = ["400", "40"];

/// The time to write the files of a scene; most take a tenth of a second.
const MOST_TO_WRITE: Duration = Duration::from_secs(60);

/// A scene to be judged.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TruthScene {
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) half: String,
    pub(super) hash: String,
    pub(super) leaves_caustics: bool,
    pub(super) places: Vec<Place>,
}

/// A place of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    /// As `isolux probe` reads it.
    pub(super) point: String,
    pub(super) surface: String,
    pub(super) stratum: String,
}

impl TruthScene {
    /// The points of a file of them.
    pub(super) fn points(&self) -> String {
        self.places.iter().map(|place| format!("{}\n", place.point)).collect()
    }
}

/// Whether nothing is to be built as it is shipped: another command is measured.
fn profile(is_given: bool) -> &'static [&'static str] {
    if is_given { &[] } else { &["--release"] }
}

/// All scenes.
pub(super) fn scenes(root: &Path, is_given: bool) -> Result<Vec<TruthScene>, String> {
    let mut command = cargo();
    command.args(["run", "--quiet", "-p", "isolux-compare", "--example", "truth"]);
    command.args(profile(is_given)).arg("--").args(PLACES).current_dir(root);
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.map_err(|e| format!("cannot run the example `truth`: {e}"))?;
    let values: Vec<Value> =
        serde_json::from_slice(&output.stdout).map_err(|e| format!("the example `truth`: {e}"))?;
    values.iter().map(|v| scene(v).ok_or("the example `truth` left something out".into())).collect()
}

fn scene(value: &Value) -> Option<TruthScene> {
    let text = |value: &Value, key: &str| value[key].as_str().map(String::from);
    let place = |value: &Value| {
        Some(Place {
            point: text(value, "point")?,
            surface: text(value, "surface")?,
            stratum: text(value, "stratum")?,
        })
    };
    Some(TruthScene {
        name: text(value, "name")?,
        kind: text(value, "kind")?,
        half: text(value, "half")?,
        hash: text(value, "hash")?,
        leaves_caustics: value["leaves_caustics"].as_bool()?,
        places: value["places"].as_array()?.iter().map(place).collect::<Option<_>>()?,
    })
}

/// Writes a scene as files; its `scene.toml`.
pub(super) fn files(folder: &Path, isolux: &Isolux, scene: &TruthScene) -> Result<PathBuf, String> {
    let folder = folder.join("scenes").join(format!("{}-{}", scene.name, &scene.hash[..12]));
    let file = folder.join("scene.toml");
    if !file.exists() {
        let words = ["scene", &format!("builtin:{}", scene.name), "-o", &folder.to_string_lossy()];
        let ended = isolux.run(&words.map(str::to_owned), MOST_TO_WRITE)?;
        if ended.code != Some(0) {
            return Err(format!("isolux scene: {}", ended.last_words));
        }
    }
    Ok(file)
}
