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
            "note.part: it is not a checkpoint, a pilot or a part of a run of isolux; give another file",
        ),
        (&["none.part"], "none.part: does not exist"),
    ] {
        let ran = home.run(&[&["merge", "-o", "m.glb"], words].concat());
        assert!(ran.code == 2 && ran.err.contains(said), "{words:?}: {ran:?}");
        assert!(!home.path("m.glb").exists());
    }
    for (words, said) in [
        (&["-o", "x.part"][..], "which part of the run?"),
        (&["-o", "x.glb", "--increments", "0..2"], "end its name in .part"),
        (&["-o", "x.part", "--increments", "2..2"], "the range is empty"),
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
