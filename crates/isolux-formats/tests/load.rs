//! Scenes of every kind through one door.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux::scene::Scene;
use isolux_formats::load;
use std::path::Path;

#[test]
fn by_extension() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for name in [
        "cornell_mcguire/CornellBox-Original.obj",
        "cornell_mcguire/scene.toml",
        "cornell_embree/scene.toml",
    ] {
        let parts = load(&scenes.join(name)).unwrap_or_else(|p| panic!("{p}")).value;
        assert!(!parts.shapes.is_empty(), "{name}");
    }
}

#[test]
fn extensions_in_capitals() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("A.OBJ");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert!(load(&path).is_ok());
}

#[test]
fn anything_else_is_refused_with_what_is_read() {
    let dir = tempfile::tempdir().unwrap();
    let message_of = |name: &str| {
        let path = dir.path().join(name);
        std::fs::write(&path, "what").unwrap();
        load(&path).unwrap_err().to_string()
    };
    for name in ["scene.what", "scene", ".toml", "scene.gltf.zip"] {
        let message = message_of(name);
        assert!(
            message.contains("name a .toml, .gltf, .glb, .obj, .ply, .rad, .stl or .xml file"),
            "{message}"
        );
    }
    for (name, remedy) in [
        ("scene.fbx", "export it as .glb"),
        ("scene.USDZ", "export it as .glb"),
        ("lamp.gldf", "unpack it"),
        ("lamp.ldt", "[[luminaire]]"),
        ("room.hdr", "--sky"),
        ("place.epw", "--sky"),
    ] {
        let message = message_of(name);
        assert!(message.contains(remedy), "{message}");
    }
    for name in [
        "none.toml",
        "none.gltf",
        "none.glb",
        "none.obj",
        "none.rad",
        "none.stl",
        "none.ply",
        "none.xml",
    ] {
        let message = load(Path::new(name)).unwrap_err().to_string();
        assert!(message.contains(name) && message.contains("does not exist; check"), "{message}");
    }
}

#[test]
fn the_demo_is_a_furnished_room() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/demo/scene.toml");
    let loaded = load(&path).unwrap_or_else(|p| panic!("{p}"));
    let unexpected: Vec<_> =
        loaded.warnings.iter().filter(|w| !w.what.contains("lies exactly on another")).collect();
    assert!(unexpected.is_empty(), "{unexpected:?}");
    let scene = Scene::assemble(loaded.value).unwrap();
    let (low, high) = scene.bvh().mesh().bounds().unwrap();
    // Walls are in single precision; nothing sticks out of the room.
    assert!((low.to_vector()).length() < 1e-6 && (high.x - 8.0).abs() < 1e-6, "{low:?} {high:?}");
    assert!((high.y - 6.0).abs() < 1e-6 && (high.z - 3.0).abs() < 1e-6);
    assert_eq!(scene.luminaires().len(), 14);
    assert_eq!(scene.groups(), ["general", "table", "accent", "desk lamp"]);
    assert_eq!(scene.cameras().len(), 2);
}

/// A closed room of what absorbs nothing has no solution: it is held, and told by name. A perfect mirror is one.
#[test]
fn what_reflects_all_light_is_held_and_named() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("white.toml");
    let text = r#"
        [materials.chalk]
        diffuse = 1.0
        [materials.lacquer]
        diffuse = 0.96
        gloss = { f0 = 0.04, roughness = 0.3 }
        [materials.silver]
        mirror = 1.0
        [materials.paint]
        diffuse = 0.99
        [[geometry]]
        box = { min = [0, 0, 0], max = [4, 5, 3], inward = true }
        material = "chalk"
    "#;
    std::fs::write(&path, text).unwrap();
    let loaded = load(&path).unwrap_or_else(|p| panic!("{p}"));
    let told = |name: &str| {
        let named = format!("material `{name}`");
        loaded
            .warnings
            .iter()
            .find(|w| w.place == named && w.what.contains("taken to reflect 0.99"))
    };
    assert!(["chalk", "lacquer"].iter().all(|name| told(name).is_some()), "{:?}", loaded.warnings);
    assert!(["silver", "paint"].iter().all(|name| told(name).is_none()), "{:?}", loaded.warnings);
    for material in &loaded.value.materials {
        let finish = material.finish(false).unwrap();
        let all = finish.diffuse.colour + finish.glossy_f0();
        assert!(all.max_channel() <= 0.99 + 1e-12, "{material:?}");
        assert!(material.name != "silver" || finish.mirror.max_channel() == 1.0);
    }
    assert!(load(&path).unwrap().value.clone().hold_reflectances().is_empty(), "once is enough");
}

/// A scene in each format whose light has a level that is still to be written.
const LIT: &[(&str, &str)] = &[
    ("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n"),
    ("a.rad", "void light lamp 0 0 3 LEVEL LEVEL LEVEL\nlamp polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n"),
    (
        "a.xml",
        "<scene version='3.0.0'><shape type='rectangle' id='lamp'><emitter type='area'>\
         <rgb name='radiance' value='LEVEL'/></emitter></shape></scene>",
    ),
    (
        "point.xml",
        "<scene version='3.0.0'><shape type='rectangle'/><emitter type='point' id='lamp'>\
         <rgb name='intensity' value='LEVEL'/></emitter></scene>",
    ),
    (
        "a.toml",
        "[materials.lamp]\nluminance_cd_m2 = LEVEL\n[[geometry]]\nmaterial = 'lamp'\n\
         rectangle = { corner = [0,0,0], u = [1,0,0], v = [0,1,0] }\n",
    ),
];

/// Regression: `Ke 1e308` came to a flux of inf lm and about NaN lx, and all was well.
#[test]
fn light_that_nothing_gives_is_refused_where_it_is() {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in LIT {
        let read = |level: &str| {
            let path = dir.path().join(name);
            std::fs::write(&path, text.replace("LEVEL", level)).unwrap();
            std::fs::write(dir.path().join("a.mtl"), format!("newmtl lamp\nKd 0\nKe {level}\n"))
                .unwrap();
            load(&path)
        };
        read("1e6").unwrap_or_else(|p| panic!("{name}: {p}"));
        for level in ["1e13", "1e300"] {
            let message = read(level).map(|_| ()).unwrap_err().to_string();
            assert!(message.contains("lamp") && message.contains("are read"), "{name}: {message}");
        }
    }
}

/// No file of any format opens another outside of its folder, also not by a link.
#[cfg(unix)]
#[test]
fn names_in_files_do_not_lead_outside() {
    let outer = tempfile::tempdir().unwrap();
    let home = outer.path().join("scene");
    std::fs::create_dir(&home).unwrap();
    for (name, text) in [
        ("secret.mtl", "newmtl m\nKd 0.123\n"),
        ("secret.rad", "void plastic m 0 0 5 .1 .1 .1 0 0\nm polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n"),
        ("secret.xml", "<scene version='3.0.0'><shape type='rectangle'/></scene>"),
        ("secret.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("secret.txt", "-t 0 0 1\n"),
        ("secret.bin", "0123456789012345678901234567890123456789"),
    ] {
        std::fs::write(outer.path().join(name), text).unwrap();
        std::os::unix::fs::symlink(outer.path().join(name), home.join(format!("link_{name}")))
            .unwrap();
    }
    let face = "polygon f 0 0 9 0 0 0 1 0 0 0 1 0";
    let gltf = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"NAME.bin"}]}"#;
    let scenes = [
        ("a.rad", "!xform NAME.rad\n".to_owned()),
        ("b.rad", format!("void plastic m 0 0 5 .1 .1 .1 0 0\nm {face}\n!genbox m b 1 1 1 | xform -f NAME.txt\n")),
        ("a.xml", "<scene version='3.0.0'><include filename='NAME.xml'/></scene>".into()),
        ("b.xml", "<scene version='3.0.0'><shape type='obj'><string name='filename' value='NAME.obj'/></shape></scene>".into()),
        ("a.toml", "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\nfile = 'NAME.obj'\n".into()),
        ("a.gltf", gltf.to_owned()),
    ];
    let absolute = outer.path().join("secret").display().to_string();
    for name in [
        "../secret",
        "link_secret",
        absolute.as_str(),
        "sub/../../secret",
        "http://example.org/secret",
    ] {
        for (file, text) in &scenes {
            let path = home.join(file);
            std::fs::write(&path, text.replace("NAME", name)).unwrap();
            assert!(load(&path).is_err(), "{file}: {name}");
        }
        // What an OBJ file names may be missing; it is not read.
        let path = home.join("a.obj");
        let text = format!("mtllib {name}.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
        std::fs::write(&path, text).unwrap();
        let parts = load(&path).unwrap().value;
        let colour = parts.materials[0].finish(false).unwrap().diffuse.colour;
        assert_ne!(colour.0[0], 0.123, "{name}");
    }
}
