//! The first minute: a room from nothing, views of it from anywhere, and its light for an engine.

use crate::ran::Home;

/// A room to begin with, solved.
fn furnished() -> Home {
    let home = Home::new();
    let made = home.run(&["new", "office", "--size", "4x3x2.6", "-o", "room.toml"]);
    assert_eq!((made.code, made.out.trim()), (0, "room.toml"), "{made:?}");
    let solved = home.run(&["solve", "room.toml", "-o", "m.glb", "--accuracy", "10%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    home
}

#[test]
fn a_new_room_is_solved_read_and_seen_from_anywhere() {
    let home = furnished();
    let again = home.run(&["new", "empty", "-o", "room.toml"]);
    assert!(again.code == 2 && again.err.contains("--force"), "{again:?}");
    let grid = home.run(&["grid", "m.glb", "--json"]).json();
    let mean_lx =
        grid["grids"][0]["mean_lx"].as_f64().or(grid["grids"][0]["mean"]["value"].as_f64());
    // Panels are counted for 500 lx.
    assert!(mean_lx.is_none_or(|lx| (200.0..1500.0).contains(&lx)), "{grid}");
    home.file("eye.vf", "rvu -vtv -vp 1 1 1.6 -vd 1 1 -.2 -vu 0 0 1 -vh 60 -vv 40\n");
    let draw = |flags: &[&str]| {
        let mut all = vec!["render", "m.glb", "-o", "v.png", "--size", "32x18", "--interpolated"];
        all.extend(flags);
        home.run(&all)
    };
    for flags in [&["--eye", "1,1,1.6", "--target", "3,2,1", "--fov", "60"][..], &["-vf", "eye.vf"]]
    {
        let ran = draw(flags);
        assert_eq!(ran.code, 0, "{ran:?}");
        let picture = std::fs::read(home.path("v.png")).unwrap();
        assert_ne!(draw(&["--camera", "door"]).code, 2);
        assert_ne!(std::fs::read(home.path("v.png")).unwrap(), picture, "{flags:?}");
    }
    for (flags, word) in [
        (&["--eye", "1,1,1.6", "--target", "1,1,1.6"][..], "--target"),
        (&["--eye", "1,1,1", "--target", "1,1,2"], "--up"),
        (&["--eye", "1,1"], "x,y,z"),
        (&["--eye", "1,1,1", "--fov", "180"], "180"),
        (&["--target", "1,1,1"], "--eye"),
        (&["-vf", "missing.vf"], "missing.vf"),
    ] {
        let ran = draw(flags);
        assert!(ran.code == 2 && ran.err.contains(word), "{flags:?}: {ran:?}");
    }
}

#[test]
fn baking_is_solving_and_exporting() {
    let home = furnished();
    let words =
        ["bake", "room.toml", "-o", "b.glb", "--accuracy", "10%", "--texels-per-meter", "4"];
    let baked = home.run(&[&words[..], &["--target", "three", "--json"]].concat());
    assert_eq!(baked.code, 0, "{baked:?}");
    let facts = baked.json();
    assert!(facts["solution"]["accuracy_reached"].as_f64().is_some_and(|share| share <= 0.1));
    assert!(facts["solution"]["map"].is_null(), "no map is kept");
    let words = ["export", "m.glb", "-o", "e.glb", "--layout", "texels", "--texels-per-meter", "4"];
    assert_eq!(home.run(&[&words[..], &["--target", "three"]].concat()).code, 0);
    let bytes = |name: &str| std::fs::read(home.path(name)).unwrap();
    assert_eq!(bytes("b.exr"), bytes("e.exr"), "the same light");
    let left: Vec<String> = home.names().into_iter().filter(|name| name.contains("bake")).collect();
    assert!(left.is_empty(), "{left:?}");
    for (flags, word) in [
        (&["bake", "room.toml", "-o", "b.wrl"][..], ".ktx2"),
        (&["bake", "missing.toml", "-o", "b.glb"], "missing.toml"),
        (&["bake", "room.toml", "-o", "none/b.glb"], "none"),
    ] {
        let ran = home.run(flags);
        assert!(ran.code == 2 && ran.err.contains(word), "{flags:?}: {ran:?}");
    }
}

#[test]
fn shells_and_manuals_know_every_subcommand() {
    let home = Home::new();
    let bash = home.run(&["completions", "bash"]);
    assert!(bash.code == 0 && bash.out.contains("isolux__solve") || bash.out.contains("solve"));
    let man = home.run(&["man", "-o", "pages", "--json"]).json();
    let pages = man["files"].as_array().unwrap().len();
    assert!(pages > 15, "{man}");
    assert!(home.path("pages/isolux-solve.1").exists());
}
