//! A scene solved, and its map read, as a user would.

use super::bounded::{Ended, Isolux};
use super::exported::TruthScene;
use super::flags::Flags;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Duration;

/// What a run may take beyond its time limit before it is ended, and a reading at all places.
const BEYOND: Duration = Duration::from_secs(60);
const LONGEST_READING: Duration = Duration::from_secs(180);
/// Memory of a run.
const MEMORY: &str = "4GiB";

/// What a map tells of a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    pub(super) lx: f64,
    pub(super) standard_error_lx: f64,
}

/// What a run said of itself, and what its map says at every place.
pub(super) fn solve(
    folder: &Path,
    isolux: &Isolux,
    scene: &TruthScene,
    file: &Path,
    (method, seed): (&str, u64),
    flags: &Flags,
) -> Result<(Value, Vec<Option<Reading>>), String> {
    let map = folder.join("map.glb");
    let _ = std::fs::remove_file(&map);
    let text = |path: &Path| path.display().to_string();
    let words = ["solve", &text(file), "-o", &text(&map), "--json", "--progress", "none"];
    let mut words: Vec<String> = words.map(String::from).into();
    words.extend(["--method".into(), method.into(), "--seed".into(), seed.to_string()]);
    words.extend(["--accuracy".into(), flags.accuracy.to_string()]);
    words.extend(["--time-limit".into(), format!("{}s", flags.time_limit_s)]);
    words.extend(["--max-memory".into(), MEMORY.into()]);
    let ended = isolux.run(&words, Duration::from_secs(flags.time_limit_s) + BEYOND)?;
    let said = ended.json().map_err(|problem| format!("solve: {problem}"))?;
    if !map.exists() {
        return Err(format!("no map: {}", ended.last_words));
    }
    let points = folder.join("points.pts");
    std::fs::write(&points, scene.points()).map_err(|e| format!("{}: {e}", points.display()))?;
    let words = ["probe", &text(&map), "--points", &text(&points), "--json"].map(String::from);
    let read = isolux.run(&words, LONGEST_READING)?;
    let json = read.json().map_err(|problem| format!("probe: {problem}"))?;
    let values = json["points"].as_array().ok_or("isolux probe gave no points")?;
    Ok((summary(&ended, &said, read.time_s), values.iter().map(reading).collect()))
}

fn summary(ended: &Ended, said: &Value, reading_s: f64) -> Value {
    json!({
        "exit": ended.code,
        "time_s": ended.time_s,
        "cpu_s": ended.cpu_s,
        "reading_s": reading_s,
        "rays": said["rays"],
        "receivers": said["receivers"],
        "told": said["accuracy_reached"],
        "reference_lx": said["reference_lx"],
        "audited": said["accuracy_audited"],
    })
}

/// Without caustics, which paths leave out.
fn reading(value: &Value) -> Option<Reading> {
    let lx = value["illuminance_lx"].as_f64()? - value["caustic_lx"].as_f64().unwrap_or(0.0);
    Some(Reading { lx, standard_error_lx: value["standard_error_lx"].as_f64()? })
}
