//! Ctrl-C: a valid map, and a run that can go on.

use crate::ran::Home;
use std::io::{BufRead, BufReader};
use std::process::Command;

/// A run that takes more than ten increments, so that a signal after the first still meets it.
const SOLVE: [&str; 6] = ["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "0.05%"];

/// Starts a run and interrupts it after its first increments; its exit code.
fn interrupt(home: &Home) -> i32 {
    interrupt_with(home, &[]).0
}

/// The same with more flags, and what it says afterwards.
fn interrupt_with(home: &Home, flags: &[&str]) -> (i32, String) {
    let mut child = home.start(&[&SOLVE[..], &["--progress", "json"], flags].concat());
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    let report: serde_json::Value = lines
        .by_ref()
        .map(|line| serde_json::from_str(&line).unwrap())
        .find(|report: &serde_json::Value| report["stage"] == "increments")
        .unwrap();
    assert!(report["rays"].as_u64().unwrap() > 0, "{report}");
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let said = lines.collect();
    (child.wait().unwrap().code().unwrap(), said)
}

#[test]
fn an_interrupted_run_saves_its_map_and_its_state() {
    let home = Home::new();
    assert_eq!(interrupt(&home), 130);
    assert_eq!(home.names(), ["m.checkpoint", "m.glb"]);
    assert_eq!(home.run(&["info", "m.glb"]).code, 0);
}

#[test]
fn an_interrupted_run_says_that_texels_are_missing() {
    let home = Home::new();
    let (code, said) = interrupt_with(&home, &["--layout", "texels"]);
    assert!(code == 130 && said.contains("the texels are not baked"), "{code}: {said}");
    assert_eq!(home.names(), ["m.checkpoint", "m.glb"]);
}

#[test]
fn a_resumed_run_ends_with_the_bytes_of_one_that_was_never_stopped() {
    let home = Home::new();
    let bytes = || std::fs::read(home.path("m.glb")).unwrap();
    assert_eq!(home.run(&SOLVE).code, 0);
    let whole = bytes();
    assert_eq!(interrupt(&home), 130);
    assert!(bytes() != whole, "it was not stopped");
    let resumed = home.run(&[&SOLVE[..], &["--resume"]].concat());
    assert_eq!(resumed.code, 0, "{resumed:?}");
    assert!(bytes() == whole, "the maps differ");
    assert_eq!(home.names(), ["m.glb"]);
}

#[test]
fn a_run_with_other_flags_is_not_resumed() {
    let home = Home::new();
    assert_eq!(interrupt(&home), 130);
    let ran = home.run(&[&SOLVE[..], &["--resume", "--seed", "2"]].concat());
    assert!(ran.code == 2 && ran.err.contains("seed"), "{ran:?}");
}

#[test]
fn a_damaged_state_is_refused() {
    let home = Home::new();
    for contents in ["", "this is no state"] {
        home.file("m.checkpoint", contents);
        let ran = home.run(&[&SOLVE[..], &["--resume"]].concat());
        assert!(ran.code == 2 && ran.err.contains("m.checkpoint"), "{ran:?}");
    }
}

#[test]
fn an_interrupted_view_keeps_the_samples_that_are_whole() {
    let home = Home::new();
    let view =
        ["render", "builtin:sphere", "--cache", "s.cache", "--accuracy", "0.1%", "-o", "v.png"];
    let mut child = home.start(&view);
    // As soon as it listens, which is before any sample is made.
    std::thread::sleep(std::time::Duration::from_millis(300));
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut said).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    assert!(said.contains("interrupted, without a view: "), "{said}");
    assert!(!home.path("v.png").exists());
}

#[test]
fn an_interrupted_validation_tells_what_is_done() {
    let home = Home::new();
    let mut child = home.start(&["validate", "--case", "cube", "--seeds", "50"]);
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    assert!(lines.by_ref().any(|line| line.ends_with(": pass")));
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let said: String = lines.collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said}");
    assert!(said.contains("of 200 runs are done, and only they are told"), "{said}");
}
