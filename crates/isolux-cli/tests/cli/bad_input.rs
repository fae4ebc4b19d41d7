//! Bad input: exit code 2, a message that names it and its remedy, nothing half-written.

use crate::ran::Home;

/// Arguments, and what the message must hold.
const BAD_ARGUMENTS: &[(&[&str], &str)] = &[
    (&[], "Usage"),
    (&["paint"], "paint"),
    (&["solve"], "SCENE"),
    (&["solve", "builtin:cube"], "--output"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "1"], "1%"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "-1%"], "--accuracy"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "NaN"], "0.01"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "2%", "--quality", "draft"], "cannot"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--quality", "best"], "medium"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--cache", "c"], "--method cache"),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--method", "cache", "--cache", "c", "--resume"],
        "cannot be used with",
    ),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--method", "cache", "--cache", "text.glb"],
        "text.glb: is not a cache",
    ),
    (&["render", "builtin:cube", "-o", "v.png", "--cache", "."], "not a regular file"),
    (&["render", "builtin:cube", "-o", "v.png", "--cache", "missing/c"], "missing"),
    (&["render", "dark.toml", "-o", "v.png", "--cache", "c"], "dark.toml: the scene has no light"),
    (&["render", "m.glb", "-o", "v.png", "--accuracy", "2%"], "--cache"),
    (&["render", "builtin:hall", "-o", "v.png", "--camera", "dor"], "choose one of"),
    (&["render", "builtin:hall", "-o", "v.png", "-vf", "missing.vf"], "missing.vf: does not exist"),
    (&["render", "builtin:hall", "-o", "v.png", "-vf", "dark.toml"], "dark.toml: has no view"),
    (&["render", "builtin:hall", "-o", "v-{kamera}.png"], "{camera}"),
    (&["render", "builtin:hall", "-o", "none/v-{camera}.png"], "`none`"),
    (&["render", "builtin:hall", "-o", "v-{camera}.bmp"], ".png, .exr or .hdr"),
    (&["render", "builtin:hall", "-o", "v.png", "--all-cameras"], "{camera}"),
    (&["render", "builtin:cube", "-o", "v.png", "--size", "16384x16384"], "million pixels"),
    (&["render", "builtin:cube", "-o", "v.png", "--size", "99999x9"], "from 1 to 16384"),
    (&["new", "office", "--size", "6x500x3", "-o", "r.toml"], "from 1 to 200 m"),
    (&["bake", "builtin:cube", "-o", "none/b.glb"], "there is no directory `none`"),
    (&["grid", "m.glb", "--height", "1", "--border", "-1"], "less than 0"),
    (&["grid", "m.glb", "--height", "1", "--spacing", "0"], "above zero"),
    (&["grid", "m.glb", "--height", "1", "--spacing", "-1"], "above zero"),
    (&["grid", "m.glb", "--corner", "0,0,0", "--u", "0,0,0", "--v", "0,1,0"], "has no length"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--method", "lumen"], "hybrid"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--unshot", "1%"], "--method radiosity"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--diffuse-only"], "--method radiosity"),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--method", "radiosity", "--min-element", "5"],
        "5cm",
    ),
    (&["solve", "builtin:cube", "-o", "m.glb", "--layout", "charts"], "texels"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--texels-per-meter", "9"], "--layout texels"),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--layout", "texels", "--texels-per-meter", "0"],
        "above zero",
    ),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--layout", "texels", "--texels-per-meter=NaN"],
        "above zero",
    ),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--layout", "texels", "--texels-per-meter", "-4"],
        "above zero",
    ),
    (&["solve", "builtin:cube", "-o", "taken.glb", "--layout", "texels"], "taken.exr"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--layout", "texels", "--group"], "group"),
    (&["export", "text.glb", "-o", "l.glb", "--texels-per-meter", "3"], "--layout texels"),
    (&["export", "text.glb", "-o", "l.glb", "--without-dark"], "--layout texels"),
    (&["export", "text.glb", "-o", "l.ply", "--without-dark"], "--layout texels"),
    (&["export", "text.glb", "-o", "l.wrl", "--layout", "texels"], ".ktx2"),
    (&["export", "text.glb", "-o", "l.wrl", "--target", "three"], ".ktx2"),
    (&["export", "text.glb", "-o", "l.exr", "--target", "quake"], "godot"),
    (&["export", "text.glb", "-o", "l.exr", "--texels-per-meter", "inf"], "above zero"),
    (&["export", "text.glb", "-o", "missing/l.exr"], "missing/l.exr"),
    (&["export", "text.glb", "-o", "l.exr"], "text.glb"),
    (&["export", "text.glb", "-o", "text.glb", "--layout", "texels"], "input"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--time-limit", "60"], "60s"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--max-memory", "8"], "8GiB"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--threads", "0"], "whole number from 1 to 1024"),
    (
        &["solve", "builtin:cube", "-o", "m.glb", "--threads", "65535"],
        "whole number from 1 to 1024",
    ),
    (&["solve", "builtin:cube", "-o", "m.glb", "--threads", "abc"], "whole number from 1 to 1024"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--threads", "-1"], "whole number from 1 to 1024"),
    (&["export", "m.glb", "-o", "m.ktx2", "--threads", "0"], "whole number from 1 to 1024"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--max-receivers", "0"], "whole number from 1 to"),
    (&["solve", "builtin:cube", "-o", "m.glb", "--seed", "-1"], "whole number"),
    (&["solve", "builtin:cube", "-o", "m.png"], ".glb"),
    (&["solve", "builtin:cube", "-o", "missing/m.glb"], "missing/m.glb"),
    (&["solve", "builtin:cube", "-o", "."], ".glb"),
    (&["solve", "builtin:teapot", "-o", "m.glb"], "builtin:cube"),
    (&["solve", "builtin:hall,triangles=7", "-o", "m.glb"], "triangles=10000 to 10000000"),
    (&["check", "builtin:hall,luminaires=many"], "luminaires=100 to 100000"),
    (&["info", "builtin:hall,chairs=7"], "chairs"),
    (&["scene", "builtin:hall"], "--output"),
    (&["scene", "builtin:teapot", "-o", "teapot"], "builtin:cube"),
    (&["scene", "missing.glb", "-o", "missing"], "missing.glb"),
    (&["solve", "missing.glb", "-o", "m.glb"], "missing.glb"),
    (&["solve", "text.glb", "-o", "m.glb"], "text.glb"),
    (&["solve", "empty.glb", "-o", "m.glb"], "empty.glb"),
    (&["solve", "text.glb", "-o", "text.glb"], "input"),
    (&["solve", "scene.xyz", "-o", "m.glb"], "scene.xyz"),
    (&["solve", "text.toml", "-o", "m.glb"], "text.toml"),
    (&["solve", "empty.obj", "-o", "m.glb"], "empty.obj: is empty"),
    (&["check", "empty.stl"], "empty.stl: is empty"),
    (&["solve", "sky.rad", "-o", "m.glb"], "sky.rad: scene: there is no geometry"),
    (&["check", "shell.rad"], "`!rm` is not run"),
    (&["info", "text.ldt"], "text.ldt"),
    (&["info", "missing.ies"], "missing.ies: does not exist"),
    (&["solve", "folder.toml", "-o", "m.glb"], "folder.toml: line 8, column 7: `.` is a directory"),
    (&["info", "text.ies"], "text.ies"),
    (&["info", "text.xyz"], "text.xyz"),
    (&["validate", "--calibrate", "--method", "radiosity"], "replicates"),
    (&["probe", "text.glb"], "--points"),
    (&["probe", "missing.glb", "--points", "good.pts"], "missing.glb"),
    (&["probe", "text.glb", "--points", "good.pts"], "text.glb"),
    (&["probe", "text.glb", "--points", "missing.pts"], "missing.pts: does not exist"),
    (&["probe", "text.glb", "--points", "taken.exr"], "taken.exr: is a directory"),
    (&["probe", "text.glb", "--points", "utf16.pts"], "utf16.pts: is text in UTF-16"),
    (&["probe", "text.glb", "--points", "short.pts"], "short.pts: line 1: 1 number; write six"),
    (&["probe", "text.glb", "--points", "bad.pts"], "bad.pts: line 2"),
    (&["probe", "text.glb", "--points", "empty.glb"], "x y z nx ny nz"),
    (&["probe", "builtin:teapot", "--points", "good.pts"], "builtin:cube"),
    (
        &["probe", "builtin:cube", "--points", "good.pts", "--exact"],
        "--exact: builtin:cube is a scene",
    ),
    (&["probe", "builtin:cube", "--points", "good.pts", "--interpolated"], "give a map"),
    (&["probe", "builtin:cube", "--points", "good.pts", "--paths", "31"], "whole number from 32"),
    (&["probe", "dark.toml", "--points", "good.pts"], "dark.toml: the scene has no light"),
    (
        &["probe", "m.glb", "--points", "good.pts", "--exact", "--interpolated"],
        "cannot be used with",
    ),
    (&["render", "text.glb", "-o", "v.png", "--size", "0x5"], "1280x720"),
    (&["render", "text.glb", "-o", "v.jpg"], ".png"),
    (&["render", "text.glb", "-o", "v.png", "--scale", "5:1"], "0:500"),
    (
        &[
            "render",
            "text.glb",
            "-o",
            "v.png",
            "--false-colour",
            "--logarithmic",
            "--limits",
            "0:1",
        ],
        "1:1000",
    ),
    (
        &["solve", "dark.toml", "-o", "m.glb"],
        "dark.toml: the scene has no light; add a [[luminaire]]",
    ),
    (&["solve", "flat.gltf", "-o", "m.glb"], "no triangle of the scene has an area"),
    (&["solve", "far.toml", "-o", "m.glb"], "far.toml: it reaches 4000004 m from its origin"),
    (&["probe", "far.toml", "--points", "good.pts"], "resolves 0.25 m"),
    (&["grid", "far.toml"], "by (-500000, -4000000, 0) m"),
    (&["render", "far.toml", "-o", "v.png", "--cache", "c"], "move it near the origin"),
    (&["solve", "latin.toml", "-o", "m.glb"], "latin.toml: line 2: is not UTF-8"),
    (&["solve", "text.ies", "-o", "m.glb"], "[[luminaire]]"),
    (&["render", "missing.glb", "-o", "v.png"], "missing.glb"),
    (&["check", "missing.toml"], "missing.toml"),
    (&["info", "nothing"], "nothing: does not exist"),
    (&["info", "."], ".: is a directory"),
    (&["check", "missing.glb"], "missing.glb: does not exist"),
    (&["render", "missing.glb", "-o", "v.png"], "missing.glb: does not exist"),
    (&["export", ".", "-o", "l.exr"], ".: is a directory"),
    (&["validate", "--case", "teapot"], "cube"),
    (&["validate", "--seeds", "0"], "whole number from 1 to 10000"),
    (&["grid", "builtin:cube", "--maintenance-factor", "80"], "write 0.8 or 80%"),
];

/// A room without a luminaire.
const DARK: &str = "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = \"m\"\n\
                    box = { min = [0, 0, 0], max = [4, 4, 3], inward = true }\n";

/// A room where a survey puts it.
const FAR: &str = "[materials.m]\ndiffuse = 0.5\n[[luminaire]]\nposition = [500002, 4000002, 2]\n\
                   isotropic = { flux_lm = 1000 }\n[[geometry]]\nmaterial = \"m\"\n\
                   box = { min = [500000, 4000000, 0], max = [500004, 4000004, 3], inward = true }\n";

/// A triangle of which all corners are one, that emits.
const FLAT: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"emissiveFactor": [1, 1, 1]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,ZEROS"}]}"#;

#[test]
fn bad_input_is_refused_with_a_reason() {
    let home = Home::new();
    home.file("text.glb", "this is no glTF");
    home.file("text.ies", "this is no lamp");
    home.file("text.ldt", "this is no lamp");
    home.file("text.toml", "this is no scene");
    home.file("dark.toml", DARK);
    home.file("far.toml", FAR);
    home.file("latin.toml", b"# caf\xc3\xa9\n# caf\xe9\n");
    home.file("empty.obj", "");
    home.file("empty.stl", "");
    home.file("flat.gltf", FLAT.replace("ZEROS", &"AAAA".repeat(12)));
    home.file("sky.rad", "void glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\n");
    home.file("shell.rad", "!rm good.pts\n");
    home.file("text.xyz", "this is nothing");
    home.file("empty.glb", "");
    home.file("good.pts", "0 0 0 0 0 1\n");
    home.file("short.pts", "7\n");
    home.file("utf16.pts", b"\xff\xfe0\0 \0");
    home.file(
        "folder.toml",
        DARK.to_owned() + "[[luminaire]]\nposition = [2, 2, 2]\nies = \".\"\n",
    );
    home.file("bad.pts", "0 0 0 0 0 1\n0 0 zero 0 0 1\n");
    std::fs::create_dir(home.path("taken.exr")).unwrap();
    let before = home.names();
    for (arguments, expected) in BAD_ARGUMENTS {
        let ran = home.run(arguments);
        assert_eq!(ran.code, 2, "{arguments:?}: {ran:?}");
        assert!(ran.err.contains(expected), "{arguments:?} does not say {expected}: {}", ran.err);
        assert_eq!(ran.out, "", "{arguments:?}");
        assert!(!ran.err.contains("panicked"), "{arguments:?}: {}", ran.err);
    }
    assert_eq!(home.names(), before, "something was left behind");
}

#[test]
fn every_subcommand_has_help_with_an_example() {
    let home = Home::new();
    let all = "solve info probe grid render view export mix check lint validate scene demo";
    for subcommand in all.split(' ') {
        let ran = home.run(&[subcommand, "--help"]);
        assert_eq!(ran.code, 0, "{ran:?}");
        assert!(ran.out.contains("Example"), "{subcommand}: {}", ran.out);
        assert!(ran.out.contains("--json"), "{subcommand}: {}", ran.out);
        assert_eq!(home.run(&["help", subcommand]).out, ran.out);
    }
    assert_eq!(home.run(&["--version"]).code, 0);
}

#[cfg(unix)]
#[test]
fn names_too_long_for_a_map_or_its_state_are_refused_before_the_work() {
    let home = Home::new();
    // The second map could be written, its checkpoint not.
    for length in [300, 250] {
        let output = format!("{}.glb", "m".repeat(length));
        let ran = home.run(&["solve", "builtin:cube", "-o", &output]);
        assert!(ran.code == 2 && ran.err.contains("choose a shorter name"), "{ran:?}");
        assert!(!ran.err.contains("subdividing"), "{}", ran.err);
    }
    assert_eq!(home.names(), [""; 0]);
}

#[cfg(unix)]
#[test]
fn points_without_end_that_are_no_text_are_refused_at_once() {
    let home = Home::new();
    let ran = home.run(&["probe", "m.glb", "--points", "/dev/zero"]);
    assert!(ran.code == 2 && ran.err.contains("/dev/zero: is not text"), "{ran:?}");
}
