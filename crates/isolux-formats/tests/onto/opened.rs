//! Files of every form: compressed, in parts, spoilt.

use crate::build::{FLOAT, File, floats, png};
use crate::grafted::Glb;
use crate::light::ONE_PAGE;
use crate::scene;
use crate::spoil::Dice;
use crate::written::Lit;
use isolux_formats::gltf;
use isolux_formats::lightmap::Target;
use isolux_formats::onto::Options;
use serde_json::{Value, json};
use std::path::Path;

fn sample(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/gltf").join(name)
}

/// What was compressed is stored as any program can read it, with the light where it belongs.
#[test]
fn compressed_files_are_unpacked() {
    for name in
        ["draco_edgebreaker.glb", "draco_sequential.glb", "meshopt_v0.glb", "meshopt_v1.glb"]
    {
        let path = sample(name);
        let light = Lit::of(&path, ONE_PAGE);
        let (bytes, warnings) = light.onto(&path, (Target::Three, Options::default())).unwrap();
        assert!(warnings.iter().any(|w| w.what.contains("stored unpacked")), "{name}");
        let text = Glb::of(&bytes).json.to_string();
        for word in ["KHR_draco", "meshopt_comp", "fallback"] {
            assert!(!text.contains(word), "{name}: {word}");
        }
        let home = tempfile::tempdir().unwrap();
        let again = home.path().join("again.glb");
        std::fs::write(&again, &bytes).unwrap();
        let [old, new] = [&path, &again].map(|path| gltf::read(path).unwrap().value.shapes);
        let corners = |shapes: &[isolux::scene::Shape]| {
            let of = |s: &isolux::scene::Shape| {
                let corners = s.triangles.iter().flatten().map(|&v| s.positions[v as usize]);
                (s.name.clone(), corners.collect::<Vec<_>>())
            };
            let mut all: Vec<_> = shapes.iter().map(of).collect();
            all.sort_by(|a, b| a.0.cmp(&b.0));
            all
        };
        assert!(!old.is_empty());
        for ((name, new), (same, old)) in corners(&new).iter().zip(corners(&old)) {
            assert_eq!((name, new.len()), (&same, old.len()));
            // Places of copies are rounded to `f32` once more.
            let near = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-6);
            assert!(new.iter().zip(&old).all(near), "{name}");
        }
    }
}

/// Data and pictures beside the file are in the new one, which may stand elsewhere.
#[test]
fn what_lies_beside_a_file_is_taken_in() {
    let home = tempfile::tempdir().unwrap();
    let mut file = scene::file();
    let picture = png(&[[1, 2, 3]]);
    file.json["buffers"][0]["uri"] = json!("data%20of.bin");
    file.json["images"] = json!([{"uri": "a.png"}, {"uri": "data:image/png;base64,iVBORw0KGgo="}]);
    std::fs::write(home.path().join("data of.bin"), &file.binary).unwrap();
    std::fs::write(home.path().join("a.png"), &picture).unwrap();
    let path = home.path().join("scene.gltf");
    std::fs::write(&path, file.json.to_string()).unwrap();
    let light = Lit::of(&path, ONE_PAGE);
    let (bytes, _) = light.onto(&path, (Target::Three, Options::default())).unwrap();
    let glb = Glb::of(&bytes);
    assert_eq!(glb.json["buffers"].as_array().unwrap().len(), 1);
    assert_eq!(glb.json["buffers"][0].get("uri"), None);
    let image = &glb.json["images"][0];
    assert_eq!((image.get("uri"), &image["mimeType"]), (None, &json!("image/png")));
    assert_eq!(glb.view(&image["bufferView"]), picture);
    assert_eq!(glb.json["images"][1], file.json["images"][1]);
    // A picture that nothing shows need not be read to be solved.
    file.json["images"][1]["uri"] = json!("missing.png");
    std::fs::write(&path, file.json.to_string()).unwrap();
    assert!(light.refused(&path).contains("images[1].uri: file `"), "{}", light.refused(&path));
}

/// A skin, of which every vertex follows one joint, and luminaires that are left out.
#[test]
fn skins_keep_their_joints_and_lights_may_go() {
    let mut file = File::triangle();
    let joints = file.accessor(&[0, 0, 0, 0].repeat(3), "VEC4", crate::build::U8, 3);
    let weights = file.accessor(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(3)), "VEC4", FLOAT, 3);
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.json["nodes"] = json!([
        {"mesh": 0, "skin": 0},
        {"name": "bone", "translation": [3, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    ]);
    file.json["scenes"] = json!([{"nodes": [0, 1]}]);
    file.json["skins"] = json!([{"joints": [1]}]);
    file.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    let lamp = json!({"type": "point", "intensity": 1e-9});
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [lamp]}});
    file.primitive()["extensions"] = json!({"CESIUM_primitive_outline": {"indices": joints}});
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let light = Lit::of(&path, ONE_PAGE);
    for without_lights in [false, true] {
        let (bytes, warnings) = light
            .onto(&path, (Target::Three, Options { without_lights, ..Options::default() }))
            .unwrap();
        let said = |words: &str| warnings.iter().any(|w| w.what.contains(words));
        assert!(said("skins keep the light of the pose"));
        assert!(said("CESIUM_primitive_outline of primitives stays"));
        assert_eq!(said("1 luminaire stays"), !without_lights);
        let glb = Glb::of(&bytes);
        assert_eq!(glb.node("bone").get("extensions").is_some(), !without_lights);
        assert_eq!(glb.json["extensions"], file.json["extensions"]);
        let primitive = &glb.json["meshes"][0]["primitives"][0];
        let attributes = &primitive["attributes"];
        // What an extension may need is still there.
        assert_eq!(primitive["extensions"]["CESIUM_primitive_outline"]["indices"], joints);
        assert_eq!(glb.numbers(&json!(joints)), [[0.0; 4]; 3]);
        assert_eq!(glb.numbers(&attributes["JOINTS_0"]), [[0.0; 4]; 3]);
        assert_eq!(glb.numbers(&attributes["WEIGHTS_0"]), [[1.0, 0.0, 0.0, 0.0]; 3]);
    }
}

/// A small file that asks for much: a mesh with a megabyte of words, in a thousand places.
#[test]
fn copies_of_what_is_large_are_bounded() {
    let mut file = File::triangle();
    file.json["meshes"][0]["extras"] = json!("x".repeat(1 << 20));
    let places: Vec<f32> = (0..1000).flat_map(|k| [2.0 * k as f32, 0.0, 0.0]).collect();
    let places = file.accessor(&floats(&places), "VEC3", FLOAT, 1000);
    file.json["nodes"][0]["extensions"] =
        json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}});
    file.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let said = Lit::of(&path, ONE_PAGE).refused(&path);
    assert!(said.contains("meshes: copies for all places"), "{said}");
}

/// Puts something else in the place of some value.
fn replace(value: &mut Value, dice: &mut Dice) {
    let children: Vec<&mut Value> = match value {
        Value::Array(values) => values.iter_mut().collect(),
        Value::Object(members) => members.values_mut().collect(),
        _ => Vec::new(),
    };
    let count = children.len();
    if count > 0 && dice.below(8) > 0 {
        let child = dice.below(count);
        return children.into_iter().nth(child).into_iter().for_each(|c| replace(c, dice));
    }
    let others = [
        json!(0),
        json!(1),
        json!(7),
        json!(4_294_967_295_u32),
        json!(-1),
        json!(1e300),
        json!([]),
        json!({}),
        json!(null),
        json!("x"),
        json!([0]),
        json!([[{}]]),
        json!({"extensions": []}),
        json!(true),
    ];
    *value = others[dice.below(others.len())].clone();
}

/// Documents spoilt at random are refused, or written as files that can be opened; nothing panics.
#[test]
fn spoilt_documents() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.gltf");
    let mut file = scene::file();
    file.json["buffers"][0]["uri"] = json!("scene.bin");
    std::fs::write(home.path().join("scene.bin"), &file.binary).unwrap();
    std::fs::write(&path, file.json.to_string()).unwrap();
    let light = Lit::of(&path, ONE_PAGE);
    let mut dice = Dice(7);
    let (mut written, mut refused) = (0, 0);
    for round in 0..1000 {
        let mut json = file.json.clone();
        (0..=round % 3).for_each(|_| replace(&mut json, &mut dice));
        std::fs::write(&path, json.to_string()).unwrap();
        match light.written(&path) {
            Ok(bytes) => {
                assert!(Glb::of(&bytes).json["nodes"].is_array());
                written += 1;
            }
            Err(said) => {
                assert!(said.contains("scene.gltf") || said.contains("scene.bin"), "{said}");
                refused += 1;
            }
        }
    }
    assert!(written > 50 && refused > 50, "{written} {refused}");
}
