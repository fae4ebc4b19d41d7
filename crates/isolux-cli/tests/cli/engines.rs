//! Maps with their light at vertices, for engines.

use crate::ran::Home;

#[test]
fn every_target_gets_colours_and_says_what_they_are() {
    let home = Home::new();
    home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    let mut whites = Vec::new();
    for target in ["three", "bevy", "godot", "unity", "blender", "viewer"] {
        let out = format!("{target}.glb");
        let ran = home.run(&["export", "m.glb", "-o", &out, "--target", target, "--json"]);
        assert_eq!(ran.code, 0, "{ran:?}");
        let report = ran.json();
        assert_eq!((&report["target"], &report["file"]), (&target.into(), &out.clone().into()));
        whites.push(report["white_cd_m2"].as_f64().unwrap());
        let bytes = std::fs::metadata(home.path(&out)).unwrap().len();
        assert_eq!(report["bytes"], bytes);
        // Without the arrays of the map.
        assert!(bytes < std::fs::metadata(home.path("m.glb")).unwrap().len(), "{target}");
        assert_eq!(home.run(&["info", &out]).code, 0, "it is a scene");
        assert_eq!(home.run(&["probe", &out, "--points", "m.pts"]).code, 2, "it is no map");
    }
    // Of the walls of CUBE, A has 892.8 cd/m2, and a hundredth of the area is about it.
    assert!(whites[..5].iter().all(|white| *white == 900.0 || *white == 890.0), "{whites:?}");
    let said = home.run(&["export", "m.glb", "-o", "g.glb", "--target", "godot"]).words();
    assert!(said.contains("luminance = COLOR_0 * base colour texture * white_cd_m2"), "{said}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let home = Home::new();
    home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    for (arguments, remedy) in [
        (&["-o", "o.glb", "--texels-per-meter", "3"][..], "--layout texels"),
        (&["-o", "o.wrl", "--target", "three"], ".glb"),
        (&["-o", "o.glb", "--white", "500cd/m2"], "another target"),
        (&["-o", "o.glb", "--white", "500"], "500cd/m2"),
        (&["-o", "o.exr", "--white", "500cd/m2"], "leave it out"),
        (&["-o", "m.glb", "--target", "three"], "another name"),
        (&["-o", "o.glb", "--layout", "texels", "--lux"], "leave it out"),
        (&["-o", "o.csv", "--lux"], "leave it out"),
    ] {
        let ran = home.run(&[&["export", "m.glb"], arguments].concat());
        assert_eq!(ran.code, 2, "{arguments:?}: {ran:?}");
        assert!(ran.err.contains(remedy), "{}", ran.err);
    }
    assert_eq!(home.names(), ["m.glb"]);
}

#[test]
fn scenes_and_maps_are_not_replaced_and_exports_are() {
    let home = Home::new();
    home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    std::fs::copy(home.path("m.glb"), home.path("other.glb")).unwrap();
    home.file("scan.ply", "ply\nformat ascii 1.0\nend_header\n");
    home.file("room.glb", "a scene");
    for name in ["other.glb", "scan.ply", "room.glb"] {
        let before = std::fs::read(home.path(name)).unwrap();
        let ran = home.run(&["export", "m.glb", "-o", name]);
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains("choose another name"), "{}", ran.err);
        assert_eq!(std::fs::read(home.path(name)).unwrap(), before, "{name}");
    }
    for target in ["three", "bevy"] {
        for name in ["baked.glb", "baked.ply"] {
            let more: &[&str] = if name == "baked.glb" { &["--target", target] } else { &[] };
            let ran = home.run(&[&["export", "m.glb", "-o", name], more].concat());
            assert_eq!(ran.code, 0, "{ran:?}");
        }
    }
}

/// A square, one-sided, and the file that it is written in.
fn card() -> Vec<u8> {
    let corners: [f32; 12] = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0];
    let mut data: Vec<u8> = corners.iter().flat_map(|c| c.to_le_bytes()).collect();
    data.extend([0, 1, 2, 0, 2, 3, 0, 0]);
    let mut json = serde_json::json!({
        "asset": {"version": "2.0", "generator": "somebody"},
        "buffers": [{"byteLength": data.len()}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 6}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [1, 0, 1]},
            {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 6},
        ],
        "materials": [{"name": "paper", "pbrMetallicRoughness": {"metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "nodes": [{"name": "card", "mesh": 0, "extras": {"of": "the shop"}}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    })
    .to_string();
    json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
    let length = 28 + json.len() + data.len();
    let head = [2, length as u32, json.len() as u32].map(u32::to_le_bytes).concat();
    let middle = (data.len() as u32).to_le_bytes();
    [b"glTF", &head[..], b"JSON", json.as_bytes(), &middle, b"BIN\0", &data].concat()
}

/// The card in a scene with a luminaire, solved.
fn solved_card(home: &Home) {
    home.file("card.glb", card());
    let scene = "[[geometry]]\nfile = 'card.glb'\n[[luminaire]]\ndirection = [0, 0, -1]\n\
                 directional = { illuminance_lx = 500 }\n";
    home.file("scene.toml", scene);
    let ran = home.run(&["solve", "scene.toml", "-o", "m.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
}

const ONTO: [&str; 8] =
    ["export", "m.glb", "-o", "baked.glb", "--layout", "texels", "--onto", "card.glb"];

#[test]
fn a_scene_is_written_again_with_its_light() {
    let home = Home::new();
    solved_card(&home);
    for target in ["three", "bevy"] {
        // The second time it replaces what it wrote.
        let ran = home.run(&[&ONTO[..], &["--target", target, "--json"]].concat());
        assert_eq!(ran.code, 0, "{ran:?}");
        assert_eq!(
            ran.json()["files"],
            serde_json::json!(["baked.glb", "baked.exr", "baked.ktx2"])
        );
    }
    let bytes = std::fs::read(home.path("baked.glb")).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    for kept in ["somebody", "the shop", "MOZ_lightmap", "paper", "\"onto\":\"card.glb\""] {
        assert!(text.contains(kept), "{kept}");
    }
    let said = home.run(&["info", "baked.glb"]);
    assert_eq!(said.code, 0, "{said:?}");
    assert!(said.out.contains("paper"), "{said:?}");
}

#[test]
fn light_goes_onto_its_own_scene_alone() {
    let home = Home::new();
    solved_card(&home);
    let mut other = card();
    let at = other.windows(4).rposition(|w| w == 1.0_f32.to_le_bytes()).unwrap();
    other[at..at + 4].copy_from_slice(&1.5_f32.to_le_bytes());
    home.file("other.glb", &other);
    home.file("empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}");
    let three = |onto: &str| [&ONTO[..7], &[onto, "--target", "three"]].concat().join(" ");
    let before = home.names();
    for (arguments, words) in [
        (
            three("other.glb"),
            "other.glb: nodes[0], meshes[0].primitives[0]: `card` is not what the map was made of",
        ),
        (three("empty.gltf"), "empty.gltf: has no surface"),
        (three("missing.glb"), "missing.glb: does not exist"),
        (three("scene.toml"), "is neither GLB nor JSON"),
        (three("m.glb"), "is an illumination map, no scene"),
        (ONTO.join(" "), "add --target three"),
        (format!("{} --target godot", ONTO.join(" ")), "add --target three"),
        ("export m.glb -o baked.glb --onto card.glb --target three".into(), "add --layout texels"),
        ("export m.glb -o baked.exr --onto card.glb --target three".into(), "end the name in .glb"),
        (
            "export m.glb -o card.glb --onto card.glb --target three --layout texels".into(),
            "is there already",
        ),
        (
            "export m.glb -o baked.glb --target three --layout texels --without-lights".into(),
            "is for --onto",
        ),
    ] {
        let ran = home.run(&arguments.split(' ').collect::<Vec<_>>());
        assert_eq!(ran.code, 2, "{arguments}: {ran:?}");
        let errors: Vec<&str> = ran.err.lines().filter(|line| line.starts_with("error")).collect();
        assert_eq!(errors.len(), 1, "{}", ran.err);
        assert!(errors[0].contains(words), "{words}: {}", ran.err);
    }
    assert_eq!(home.names(), before);
}
