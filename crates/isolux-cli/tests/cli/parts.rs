//! Parts of a run, made apart, and the pilot as a file.

use crate::ran::Home;
use std::fs;

const CUBE: [&str; 4] = ["solve", "builtin:cube", "--accuracy", "5%"];

fn made(home: &Home, range: &str, output: &str, more: &[&str]) {
    let ran = home.run(&[&CUBE[..], &["--increments", range, "-o", output], more].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
}

#[test]
fn parts_merge_to_the_bytes_of_one_run() {
    let home = Home::new();
    let whole = home.run(&[&CUBE[..], &["-o", "map.glb", "--json"]].concat());
    assert_eq!(whole.code, 0, "{whole:?}");
    let count = whole.json()["increments"].as_u64().unwrap();
    assert_eq!(home.run(&[&CUBE[..], &["-o", "cube.pilot"]].concat()).code, 0);
    made(&home, &format!("3..{count}"), "c.part", &["--threads", "1"]);
    made(&home, "0..2", "a.part", &["--pilot", "cube.pilot"]);
    made(&home, "2..3", "b.part", &["--pilot", "cube.pilot", "--threads", "3"]);
    let merged = home.run(&["merge", "c.part", "a.part", "b.part", "-o", "merged.glb"]);
    assert_eq!(merged.code, 0, "{merged:?}");
    assert!(home.run(&["merge", "c.part", "b.part", "-o", "bc.part"]).code == 0);
    let by_pilot = ["merge", "bc.part", "a.part", "--pilot", "cube.pilot", "-o", "by-pilot.glb"];
    assert_eq!(home.run(&by_pilot).code, 0);
    let bytes = |name: &str| fs::read(home.path(name)).unwrap();
    assert!(bytes("merged.glb") == bytes("map.glb"));
    assert!(bytes("by-pilot.glb") == bytes("map.glb"));
}

#[test]
fn parts_that_cannot_be_merged_are_named() {
    let home = Home::new();
    made(&home, "0..2", "a.part", &[]);
    made(&home, "1..2", "b.part", &[]);
    made(&home, "2..3", "other.part", &["--seed", "2"]);
    let whole = fs::read(home.path("a.part")).unwrap();
    home.file("cut.part", &whole[..whole.len() / 2]);
    home.file("note.part", "not to be forgotten");
    for (words, said) in [
        (&["a.part", "b.part"][..], "b.part: increments 1..2 are in an earlier part"),
        (&["a.part", "other.part"], "other.part: it differs from the first part in the seed"),
        (&["b.part"], "increments 0..1 are in no part"),
        (&["cut.part"], "cut.part: its contents do not match their checksum"),
        (
            &["note.part"],
            "note.part: it is not a checkpoint, a pilot or a part of a run of isolux; leave it out, or make this part again",
        ),
        (&["none.part"], "none.part: does not exist"),
    ] {
        let ran = home.run(&[&["merge", "-o", "m.glb"], words].concat());
        assert!(ran.code == 2 && ran.err.contains(said), "{words:?}: {ran:?}");
        assert!(!home.path("m.glb").exists());
    }
    let elsewhere = home.run(&["merge", "a.part", "--scene", "builtin:sphere", "-o", "m.glb"]);
    let said = "builtin:sphere: is not the scene that the parts are of, which was `builtin:cube`";
    assert!(elsewhere.code == 2 && elsewhere.err.contains(said), "{elsewhere:?}");
    for (words, said) in [
        (&["-o", "x.part"][..], "which part of the run?"),
        (&["-o", "x.glb", "--increments", "0..2"], "end its name in .part"),
        (&["--increments", "0..2"], "where does this part go? Add -o x.part"),
        (&["-o", "x.part", "--increments", "2..2"], "the range is empty; write A..B"),
        (&["-o", "x.part", "--increments", "5"], "write two whole numbers A..B"),
        (&["-o", "x.part", "--increments", "0..40000"], "at most 32768 increments"),
        (
            &["-o", "x.part", "--increments", "0..2", "--layout", "texels"],
            "--layout texels: x.part",
        ),
        (&["-o", "x.pilot", "--layout", "texels"], "--layout texels: x.pilot is no map"),
        (&["-o", "x.pilot", "--texels-per-meter", "9"], "--layout texels: x.pilot is no map"),
        (&["-o", "x.pilot", "--group"], "--group: x.pilot is no map"),
        (&["-o", "x.pilot", "--resume"], "--resume: x.pilot is no map"),
        (&["-o", "x.pilot", "--live"], "--live: x.pilot is no map"),
        (&["-o", "x.pilot", "--method", "cache", "--cache", "c"], "--cache: x.pilot is no map"),
        (
            &["-o", "x.part", "--increments", "0..2", "--method", "radiosity"],
            "hybrid, cache or forward",
        ),
        (&["-o", "x.part", "--increments", "0..2", "--pilot", "a.part"], "it is a part of a run"),
    ] {
        let ran = home.run(&[&CUBE[..], words].concat());
        assert!(ran.code == 2 && ran.err.contains(said), "{words:?}: {ran:?}");
    }
}

#[test]
fn info_says_what_files_of_a_run_hold() {
    let home = Home::new();
    assert_eq!(home.run(&[&CUBE[..], &["-o", "cube.pilot"]].concat()).code, 0);
    made(&home, "0..2", "a.part", &["--pilot", "cube.pilot"]);
    made(&home, "3..4", "b.part", &["--pilot", "cube.pilot"]);
    assert_eq!(home.run(&["merge", "a.part", "b.part", "-o", "all.part"]).code, 0);
    let part = home.run(&["info", "all.part"]);
    for said in ["part of a run", "builtin:cube", "0..2, 3..4", "5.0 %", "hybrid"] {
        assert!(part.out.contains(said), "{said}: {part:?}");
    }
    let hash = home.run(&["info", "all.part", "--json"]).json()["scene_hash"].clone();
    let pilot = home.run(&["info", "cube.pilot", "--json"]).json();
    assert_eq!((&pilot["kind"], &pilot["scene_hash"]), (&"pilot".into(), &hash));
    assert!(pilot["increments"].is_null() && pilot["receivers"].as_u64() > Some(100), "{pilot}");
    let whole = fs::read(home.path("all.part")).unwrap();
    home.file("cut.part", &whole[..whole.len() / 2]);
    let cut = home.run(&["info", "cut.part"]);
    assert!(cut.code == 2 && cut.err.contains("its contents do not match"), "{cut:?}");
}

#[test]
fn a_dry_run_makes_no_pilot() {
    let home = Home::new();
    let ran = home.run(&[&CUBE[..], &["-o", "cube.pilot", "--dry-run", "--json"]].concat());
    assert!(ran.code == 0 && ran.json()["receivers"].as_u64().is_some(), "{ran:?}");
    assert!(!home.path("cube.pilot").exists());
}
