//! `scene.toml`: every key, every problem with its place, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod cameras;
mod geometry;
mod grids;
mod hostile;
mod imports;
mod luminaires;
mod materials;
mod problems;
mod sky;

use isolux::geometry::{Triangle, Vector};
use isolux::scene::{Scene, SceneParts};
use isolux_formats::{Loaded, Problems, scene_toml};
use std::path::Path;

/// A scene needs geometry.
const FLOOR: &str = "
[materials.grey]
diffuse = 0.5
[[geometry]]
name = 'floor'
rectangle = { corner = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }
material = 'grey'
";

/// Reads a scene of a directory of its own, with other files beside it.
fn read_with(text: &str, files: &[(&str, &str)]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(dir.path().join(name), content).unwrap();
    }
    let path = dir.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    scene_toml::read(&path)
}

fn read(text: &str) -> SceneParts {
    read_with(text, &[]).unwrap_or_else(|problems| panic!("{problems}\n{text}")).value
}

/// Problems as `place: what; remedy`.
fn problems(text: &str) -> Vec<String> {
    let Problems(list) = read_with(text, &[]).expect_err(text);
    assert!(list.iter().all(|p| p.file.ends_with("scene.toml") && !p.remedy.is_empty()));
    list.iter().map(|p| format!("{}: {}; {}", p.place, p.what, p.remedy)).collect()
}

fn triangles(parts: &SceneParts) -> Vec<Triangle> {
    let scene = Scene::assemble(parts.clone()).unwrap();
    (0..scene.triangle_count()).map(|t| scene.triangle(t)).collect()
}

/// Sum of areas with their normals.
fn area_vector(parts: &SceneParts) -> Vector {
    triangles(parts).iter().fold(Vector::ZERO, |sum, t| sum + t.area_vector() * 0.5)
}

fn near(a: Vector, b: [f64; 3]) -> bool {
    // Positions are in single precision, in scenes of a few metres.
    (a - Vector::from(b)).length() < 1e-5
}

fn scenes() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}
