//! Scenes of Mitsuba 3: shapes, materials, light, cameras, parameters, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod hostile;
mod light;
mod materials;
mod shapes;
#[path = "../spoil/mod.rs"]
mod spoil;

use isolux::geometry::{Direction, Vector};
use isolux::scene::{Body, Finish, LuminaireKind, Scene, SceneParts, Shape, UpAxis};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, load, mitsuba, scene_toml};
use spoil::{Dice, spoil};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

const CORNELL: &str = "../../scenes/cornell_mitsuba/scene.xml";
const RECTANGLE: &str = "<shape type='rectangle'/>";

fn cornell() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(CORNELL)
}

/// Reads `scene.xml`, of which the inside is given, beside other files.
fn read_with(inside: &str, files: &[(&str, &str)]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(dir.path().join(name), text).unwrap();
    }
    let path = dir.path().join("scene.xml");
    std::fs::write(&path, format!("<scene version='3.0.0'>\n{inside}\n</scene>")).unwrap();
    mitsuba::read(&path)
}

fn read(inside: &str) -> SceneParts {
    read_with(inside, &[]).unwrap_or_else(|p| panic!("{p}")).value
}

fn told(inside: &str) -> String {
    let warnings = read_with(inside, &[]).unwrap_or_else(|p| panic!("{p}")).warnings;
    warnings.iter().map(|w| format!("{w}\n")).collect()
}

#[track_caller]
fn refused(inside: &str, expected: &str) {
    let message = read_with(inside, &[]).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
    assert!(message.contains("; "), "no remedy: {message}");
}

#[track_caller]
fn near(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs().max(1e-300), "{a} {b}");
}

/// The front of a rectangle of a material.
fn body(bsdf: &str) -> Body {
    let parts = read(&format!("<shape type='rectangle'>{bsdf}</shape>"));
    parts.materials[parts.shapes[0].material as usize].body.clone()
}

fn front(bsdf: &str) -> Finish {
    let Body::Opaque { front, .. } = body(bsdf) else { panic!("{bsdf}") };
    front
}

/// The sum of areas with their normals, and the area.
fn areas(shape: &Shape) -> (Vector, f64) {
    let corner = |k: u32| Vector::from(shape.positions[k as usize]);
    shape.triangles.iter().fold((Vector::ZERO, 0.0), |(sum, area), t| {
        let [a, b, c] = t.map(corner);
        let half = (b - a).cross(c - a) * 0.5;
        (sum + half, area + half.length())
    })
}
