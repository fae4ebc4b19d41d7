//! Files that lie outside of the folder of the scene that names them: refused, with the way to allow it, or read when that is allowed.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux_formats::obj::Materials;
use isolux_formats::{Problem, Problems, Reach, load_with};
use std::fs;

const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
const RAD_FACE: &str = "void plastic m 0 0 5 .5 .5 .5 0 0\nm polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n";
const FLOOR: &str = "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\n\
    rectangle = { corner = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }\n";

/// Files beside the folder of the scene.
const OUTSIDE: [(&str, &str); 5] = [
    ("face.obj", FACE),
    ("face.mtl", "newmtl m\nKd .5 .5 .5\n"),
    ("face.rad", RAD_FACE),
    ("face.xml", "<scene version='3.0.0'><shape type='rectangle'/></scene>"),
    ("face.toml", FLOOR),
];

/// What is found when a scene of this name and text is read.
fn read(name: &str, text: &str, reach: Reach) -> Result<Vec<Problem>, Problems> {
    let outer = tempfile::tempdir().unwrap();
    OUTSIDE.iter().for_each(|(name, text)| fs::write(outer.path().join(name), text).unwrap());
    let lamp = "../../scenes/photometry/own/downlight.ies";
    fs::copy(lamp, outer.path().join("lamp.ies")).unwrap();
    fs::write(outer.path().join("face.bin"), [0; 36]).unwrap();
    fs::copy("tests/hostile/beside/beside.png", outer.path().join("wood.png")).unwrap();
    let folder = outer.path().join("scene");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("own.mtl"), "newmtl m\nKd 1 1 1\nmap_Kd ../wood.png\n").unwrap();
    fs::write(folder.join(name), text).unwrap();
    load_with(&folder.join(name), Materials::AsMeant, reach).map(|loaded| loaded.warnings)
}

const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "../face.bin"}]}"#;

/// Scenes that name such a file, each in its own way.
fn scenes() -> Vec<(&'static str, String)> {
    let toml = |more: &str| ("scene.toml", format!("{FLOOR}{more}"));
    let xml = |more: &str| {
        let shape = "<shape type='rectangle'/>";
        ("scene.xml", format!("<scene version='3.0.0'>{shape}{more}</scene>"))
    };
    vec![
        ("scene.gltf", GLTF.to_owned()),
        ("scene.obj", format!("mtllib ../face.mtl\n{FACE}")),
        ("scene.obj", format!("mtllib own.mtl\n{FACE}")),
        ("scene.rad", format!("{RAD_FACE}!xform ../face.rad\n")),
        ("scene.rad", format!("{RAD_FACE}!ies2rad ../lamp.ies\n")),
        xml("<include filename='../face.xml'/>"),
        xml("<shape type='obj'><string name='filename' value='../face.obj'/></shape>"),
        toml("[[geometry]]\nfile = '../face.obj'\nmaterial = 'm'\n"),
        toml("[[luminaire]]\nposition = [0, 0, 1]\nies = '../lamp.ies'\n"),
    ]
}

/// Whether one of them is about a file outside, and says how to allow it.
fn tells(found: &[Problem]) -> bool {
    let is_told = |p: &Problem| p.remedy.contains("--allow-outside");
    found.iter().any(is_told)
}

#[test]
fn files_outside_are_refused_by_a_message_that_names_the_flag() {
    for (name, text) in scenes() {
        // What an OBJ file names may be missing: that is a warning.
        let found = read(name, &text, Reach::Inside).unwrap_or_else(|Problems(list)| list);
        assert!(tells(&found), "{name}: {text}: {found:#?}");
    }
}

#[test]
fn files_outside_are_read_when_that_is_allowed() {
    for (name, text) in scenes() {
        let found = read(name, &text, Reach::Anywhere).unwrap_or_else(|p| panic!("{name}: {p}"));
        let is_missing = |p: &Problem| p.what.contains("outside") || p.what.contains("not exist");
        assert!(!tells(&found) && !found.iter().any(is_missing), "{name}: {found:#?}");
    }
}

#[test]
fn no_other_machine_is_asked_even_then() {
    let remote = [
        ("scene.obj", format!("mtllib //machine/face.mtl\n{FACE}"), "another machine"),
        ("scene.gltf", GLTF.replace("../face.bin", "http://machine/face.bin"), "of the kind"),
        ("scene.gltf", GLTF.replace("../face.bin", "//machine/face.bin"), "leaves the directory"),
    ];
    for (name, text, said) in remote {
        let found = read(name, &text, Reach::Anywhere).unwrap_or_else(|Problems(list)| list);
        assert!(found.iter().any(|p| p.what.contains(said)), "{name}: {found:#?}");
    }
}
