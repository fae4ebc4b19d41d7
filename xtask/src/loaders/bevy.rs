//! The loader of Bevy: what its example reads of a room with two groups, beside what the command says of it.

use crate::peers::{cargo, wait};
use crate::smoke::isolux;
use serde_json::Value;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Light of files and places have 32 bits; at the edge of a shadow light doubles within a decimetre. Measured: 2e-7.
const SINGLE: f64 = 1e-5;
/// Of walls and floor, in linear Rec. 709.
const REFLECTANCES: [[f64; 3]; 2] = [[0.6, 0.6, 0.6], [0.3, 0.2, 0.12]];
const DIMMED: &str = "spots=0.3";
/// Lines of points in each direction.
const LINES: usize = 12;

const SCENE: &str = r#"name = "two groups"
[materials.paint]
diffuse = 0.6
[materials.carpet]
diffuse = [0.3, 0.2, 0.12]
[[geometry]]
box = { min = [0, 0, 0], max = [4, 5, 2.8], inward = true }
material = "paint"
materials = { z_min = "carpet" }
[[luminaire]]
position = [1.2, 1.3, 2.6]
cosine = { flux_lm = 2000 }
group = "general"
[[luminaire]]
position = [2.5, 3.5, 2.6]
spot = { flux_lm = 800, inner_deg = 15, outer_deg = 30 }
colour = [1, 0.8, 0.6]
group = "spots"
"#;

/// An error without the crates of Bevy.
pub(super) fn fetched(root: &Path) -> Result<(), String> {
    let source = root.join("loaders").join("bevy");
    wait(at(&source).args(["fetch", "--quiet", "--locked"]), "cargo fetch in loaders/bevy")
}

/// Builds the example, and has it read.
pub(super) fn run(root: &Path) -> Result<String, String> {
    let source = root.join("loaders").join("bevy");
    let target = root.join("target").join("loader-bevy");
    println!("building Bevy's assets and meshes, which takes minutes the first time");
    for step in [&["test", "--quiet"][..], &["build", "--quiet", "--example", "read"]] {
        let flags = ["--locked", "--target-dir", &text(&target)];
        wait(at(&source).args(step).args(flags), "cargo in loaders/bevy")?;
    }
    let name = format!("read{}", std::env::consts::EXE_SUFFIX);
    let room = Room::solve(root, target.join("debug").join("examples").join(name))?;
    let undimmed = room.compare("map.glb", &[])?;
    room.compare("dimmed.glb", &[DIMMED])?;
    room.refuses(&["light.glb", "attic=1"], "has no group attic, but")?;
    room.refuses(&["map.toml"], "is no binary glTF")?;
    room.refuses(&["colours.glb"], "--lux")?;
    Ok(format!("loaders/bevy reads and dims {undimmed} places as the command does"))
}

fn at(folder: &Path) -> Command {
    let mut command = cargo();
    command.current_dir(folder);
    command
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// A room that is solved, and the example that reads it.
struct Room<'a> {
    root: &'a Path,
    folder: PathBuf,
    example: PathBuf,
    exposure_m2_cd: f64,
}

impl<'a> Room<'a> {
    fn solve(root: &'a Path, example: PathBuf) -> Result<Self, String> {
        let folder = root.join("target").join("judge-of-bevy");
        std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let mut room = Self { root, folder, example, exposure_m2_cd: 0.0 };
        for (name, content) in [("map.toml", SCENE), ("places.pts", &points())] {
            let file = room.folder.join(name);
            std::fs::write(&file, content).map_err(|e| format!("{}: {e}", file.display()))?;
        }
        let [scene, map, light, dimmed, colours] =
            ["map.toml", "map.glb", "light.glb", "dimmed.glb", "colours.glb"].map(|n| room.path(n));
        isolux(root, &["solve", &scene, "-o", &map, "--group", "--quality", "draft"])?;
        isolux(root, &["mix", &map, "--dim", DIMMED, "-o", &dimmed])?;
        isolux(root, &["export", &map, "-o", &colours])?;
        let said =
            isolux(root, &["export", &map, "-o", &light, "--lux", "--target", "bevy", "--json"])?;
        room.exposure_m2_cd = parsed(&said)?["exposure_m2_cd"].as_f64().ok_or("no exposure")?;
        Ok(room)
    }

    fn path(&self, name: &str) -> String {
        text(&self.folder.join(name))
    }

    /// Compares readings of the example, dimmed, with those of a map; the count of places.
    fn compare(&self, map: &str, levels: &[&str]) -> Result<usize, String> {
        let points = self.path("places.pts");
        let probe = ["probe", &self.path(map), "--points", &points, "--interpolated", "--json"];
        let due = parsed(&isolux(self.root, &probe)?)?;
        let due = due["points"].as_array().ok_or("probe prints no points")?;
        let said = Command::new(&self.example)
            .arg(self.path("light.glb"))
            .arg(&points)
            .args(levels)
            .output();
        let said = said.map_err(|e| format!("{}: {e}", self.example.display()))?;
        let read = parsed(&String::from_utf8_lossy(&said.stdout))
            .map_err(|e| format!("{e}: {}", String::from_utf8_lossy(&said.stderr)))?;
        let read = read.as_array().ok_or("the example prints no readings")?;
        if read.len() != due.len() || read.len() < 2 * LINES * LINES {
            return Err(format!("{} readings in place of {}", read.len(), due.len()));
        }
        for (read, due) in read.iter().zip(due) {
            near(read, due, "illuminance_lx")?;
            match levels {
                [] => near(read, due, "direct_lx")?,
                _ if read["direct_lx"].is_null() => {}
                _ => return Err("direct light of groups is not in the file".to_owned()),
            }
        }
        let at_vertices: Vec<&Value> = read
            .iter()
            .filter(|read| read["vertices"].as_array().is_some_and(|all| !all.is_empty()))
            .collect();
        match at_vertices.iter().find(|read| !self.shows(read)) {
            Some(read) => Err(format!("meshes show {read} at {} m2/cd", self.exposure_m2_cd)),
            None if at_vertices.len() < 4 => {
                Err("the corners of the room are no vertices".to_owned())
            }
            None => Ok(read.len()),
        }
    }

    /// Whether meshes have, at the place of a reading, its illuminance, and the exposed luminance of one of the materials in it.
    fn shows(&self, read: &Value) -> bool {
        let lux = read["illuminance_lx"].as_f64().unwrap_or(f64::NAN);
        let vertices = read["vertices"].as_array().into_iter().flatten();
        vertices.map(|vertex| (numbers(&vertex["lx"]), vertex)).any(|(lx, vertex)| {
            let own = 0.2126 * lx[0] + 0.7152 * lx[1] + 0.0722 * lx[2];
            (own - lux).abs() <= SINGLE * lux && self.is_luminance(vertex)
        })
    }

    /// Whether the colour of a vertex is the exposed luminance of one of the materials in its light.
    fn is_luminance(&self, vertex: &Value) -> bool {
        let (lx, colour) = (numbers(&vertex["lx"]), numbers(&vertex["colour"]));
        REFLECTANCES.iter().any(|reflectance| {
            let channel = |k: usize| self.exposure_m2_cd * reflectance[k] * lx[k] / PI;
            (0..3).all(|k| (colour[k] - channel(k)).abs() <= SINGLE * channel(k))
        })
    }

    fn refuses(&self, arguments: &[&str], words: &str) -> Result<(), String> {
        let [file, levels @ ..] = arguments else { return Ok(()) };
        let mut example = Command::new(&self.example);
        let said = example.arg(self.path(file)).arg(self.path("places.pts")).args(levels).output();
        let said = said.map_err(|e| format!("{}: {e}", self.example.display()))?;
        let error = String::from_utf8_lossy(&said.stderr);
        match !said.status.success() && error.contains(words) {
            true => Ok(()),
            false => Err(format!("{arguments:?}: says {error:?} in place of {words:?}")),
        }
    }
}

/// On the floor and on a wall, and the corners of both.
fn points() -> String {
    let mut text = String::new();
    let inside = |k: usize| (k as f64 + 0.37) / LINES as f64;
    for (k, l) in (0..LINES).flat_map(|k| (0..LINES).map(move |l| (k, l))) {
        let _ = writeln!(text, "{} {} 0 0 0 1", 4.0 * inside(k), 5.0 * inside(l));
        let _ = writeln!(text, "0 {} {} 1 0 0", 5.0 * inside(k), 2.8 * inside(l));
    }
    for (x, y) in [(0, 0), (4, 0), (4, 5), (0, 5)] {
        let _ = writeln!(text, "{x} {y} 0 0 0 1");
    }
    text
}

fn parsed(text: &str) -> Result<Value, String> {
    serde_json::from_str(text).map_err(|e| format!("{e} in {text:?}"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
}

fn near(read: &Value, due: &Value, figure: &str) -> Result<(), String> {
    match (read[figure].as_f64(), due[figure].as_f64()) {
        (Some(read), Some(due)) if (read - due).abs() <= SINGLE * due => Ok(()),
        _ => Err(format!("{figure} {} in place of {}", read[figure], due[figure])),
    }
}
