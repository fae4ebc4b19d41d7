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
    let said = home.run(&["export", "m.glb", "-o", "g.glb", "--target", "godot"]).out;
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
