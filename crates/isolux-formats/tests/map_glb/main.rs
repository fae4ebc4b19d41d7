//! Maps written, read and spoiled.
#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise, helpers included")]

mod example;
mod exports;
mod hostile;

use example::{map, parts, scene};
use isolux::map::IlluminationMap;
use isolux::scene::{Body, Coat, Scene, SceneParts, UpAxis};
use isolux_formats::map_glb::{self, Preview};
use isolux_formats::{Loaded, Problems, atomic};
use serde_json::Value;
use std::path::{Path, PathBuf};

fn bytes(scene: &Scene, map: &IlluminationMap) -> Vec<u8> {
    map_glb::write(scene, map, &Preview::automatic(scene, map)).unwrap()
}

fn read_bytes(bytes: &[u8]) -> Result<Loaded<(Scene, IlluminationMap)>, Problems> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("map.glb");
    std::fs::write(&path, bytes).unwrap();
    map_glb::read(&path)
}

/// The JSON chunk and the bytes after it (header of the binary chunk included).
fn json_and_rest(bytes: &[u8]) -> (Value, &[u8]) {
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    (serde_json::from_slice(&bytes[20..20 + length]).unwrap(), &bytes[20 + length..])
}

#[test]
fn nothing_is_lost_between_writing_and_reading() {
    let scene = scene();
    let map = map(&scene);
    let written = bytes(&scene, &map);
    let (scene_read, map_read) = read_bytes(&written).unwrap().value;
    assert_eq!(map_read, map);
    assert_eq!(scene_read.to_parts(), scene.to_parts());
    assert_eq!(scene_read.hash(), scene.hash());
    assert!(bytes(&scene_read, &map_read) == written, "the second writing differs");
}

#[test]
fn what_files_cannot_hold_becomes_unknown() {
    let scene = scene();
    let mut spoiled = map(&scene);
    spoiled.values[0].as_mut().unwrap().direct_lx.0[1] = f64::NAN;
    spoiled.values[1].as_mut().unwrap().standard_error_lx = f64::NAN;
    spoiled.provenance.accuracy.as_mut().unwrap().bias = f64::INFINITY;
    spoiled.provenance.accuracy_target = Some(f64::NAN);
    let written = bytes(&scene, &spoiled);
    let read = read_bytes(&written).unwrap().value.1;
    assert_eq!(read.values[0], None);
    assert_eq!(read.values[1].unwrap().standard_error_lx, f64::INFINITY);
    assert_eq!(read.provenance.accuracy, None);
    assert_eq!(read.provenance.accuracy_target, None);
    assert!(bytes(&scene, &read) == written, "the second writing differs");
}

#[test]
fn a_map_is_told_from_other_files() {
    let directory = tempfile::tempdir().unwrap();
    let check = |name: &str, bytes: &[u8], expected: bool| {
        let path = directory.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(map_glb::is_map(&path), expected, "{name}");
    };
    let scene = scene();
    let written = bytes(&scene, &map(&scene));
    check("map.glb", &written, true);
    check("cut.glb", &written[..300], false);
    check("empty.glb", &[], false);
    let plain = br#"{"asset":{"version":"2.0"},"extras":{"name":"no map"}}  "#;
    let mut glb = Vec::new();
    for word in [0x4654_6c67, 2, 20 + plain.len() as u32, plain.len() as u32, 0x4e4f_534a] {
        glb.extend(word.to_le_bytes());
    }
    glb.extend(plain);
    check("scene.glb", &glb, false);
    let problems = read_bytes(&glb).unwrap_err();
    assert!(problems.to_string().contains("no illumination map"), "{problems}");
    assert!(!map_glb::is_map(directory.path()));
    assert!(!map_glb::is_map(&directory.path().join("missing")));
}

#[test]
fn the_record_says_what_the_numbers_are() {
    let scene = scene();
    let map = map(&scene);
    let (json, _) = json_and_rest(&bytes(&scene, &map)).clone();
    let isolux = &json["extras"]["isolux"];
    assert_eq!(isolux["format_version"], 2);
    assert_eq!(isolux["quantity"], "illuminance");
    assert_eq!(isolux["unit"], "lx");
    assert_eq!(isolux["accuracy_reached"], 0.0093);
    assert_eq!(isolux["provenance"]["seed"], u64::MAX);
    // Two luminaires share one table.
    assert_eq!(isolux["scene"]["distributions"].as_array().unwrap().len(), 5);
    assert!(json["asset"]["generator"].as_str().unwrap().starts_with("isolux "));
}

#[test]
fn shapes_are_shown_with_the_sides_they_have() {
    let scene = scene();
    let (json, _) = json_and_rest(&bytes(&scene, &map(&scene))).clone();
    let meshes = json["meshes"].as_array().unwrap();
    let shown: Vec<(&str, usize)> = meshes
        .iter()
        .map(|m| (m["name"].as_str().unwrap(), m["primitives"].as_array().unwrap().len()))
        .collect();
    let expected = [("floor", 1), ("curtain", 2), ("mirror", 1), ("window", 1), ("panel", 1)];
    assert_eq!(shown, [&expected[..], &[("steel", 2)]].concat());
    let indices = &meshes[0]["primitives"][0]["indices"];
    let count = &json["accessors"][indices.as_u64().unwrap() as usize]["count"];
    // Two triangles with area, of which one is bisected twice.
    assert_eq!(count, 3 * 4);
    let root = json["nodes"].as_array().unwrap().last().unwrap();
    assert!(root["rotation"][0].as_f64().unwrap() < -0.7, "z-up is turned");
}

/// For the checks by other programs: `checks/validate.mjs`, `checks/three.mjs`.
#[test]
fn examples_are_written_for_outside_judges() {
    let write = |name: &str, parts: SceneParts| {
        let scene = Scene::assemble(parts).unwrap();
        let path: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        atomic::write(&path, &bytes(&scene, &map(&scene))).unwrap();
    };
    write("map-everything.glb", parts());
    let mut plain = SceneParts { up: UpAxis::Y, ..parts() };
    plain.luminaires.clear();
    plain.cameras.clear();
    plain.shapes.truncate(1);
    write("map-plain.glb", plain);
}

/// Who reads version 2 alone would leave coats out; without any, files are as before.
#[test]
fn coats_come_back_and_raise_the_version() {
    let plain = parts();
    let mut coated = parts();
    let steel = coated.materials.iter_mut().find(|m| m.name == "steel").unwrap();
    let Body::Opaque { front, .. } = &mut steel.body else { panic!() };
    front.coat = Some(Coat { cover: 0.5, alpha: 0.04 });
    for (parts, version) in [(plain, 2), (coated, 3)] {
        let scene = Scene::assemble(parts).unwrap();
        let written = bytes(&scene, &map(&scene));
        assert_eq!(json_and_rest(&written).0["extras"]["isolux"]["format_version"], version);
        let (read, _) = read_bytes(&written).unwrap().value;
        assert_eq!(read.to_parts(), scene.to_parts());
        assert_eq!(read.hash(), scene.hash());
    }
}
