//! Ctrl-C: a valid map, and a run that can go on.

use crate::ran::Home;
use isolux_formats::checkpoint;
use std::io::{BufRead, BufReader};
use std::process::Command;

/// A run that takes more than ten increments, so that a signal after the first still meets it.
const SOLVE: [&str; 6] = ["solve", "builtin:cube", "-o", "m.glb", "--accuracy", "0.05%"];

/// Starts a run and interrupts it after its first increments; its exit code.
fn interrupt(home: &Home) -> i32 {
    interrupt_with(home, "INT", &[]).0
}

/// The same by another signal and with more flags, and what it says afterwards.
fn interrupt_with(home: &Home, signal: &str, flags: &[&str]) -> (i32, String) {
    let mut child = home.start(&[&SOLVE[..], &["--progress", "json"], flags].concat());
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    let report: serde_json::Value = lines
        .by_ref()
        .map(|line| serde_json::from_str(&line).unwrap())
        .find(|report: &serde_json::Value| report["stage"] == "increments")
        .unwrap();
    assert!(report["rays"].as_u64().unwrap() > 0, "{report}");
    let (signal, id) = (format!("-{signal}"), child.id().to_string());
    assert!(Command::new("kill").args([&signal, &id]).status().unwrap().success());
    let said = lines.collect();
    (child.wait().unwrap().code().unwrap(), said)
}

#[test]
fn an_interrupted_run_saves_its_map_and_its_state() {
    for signal in ["INT", "TERM", "HUP"] {
        let home = Home::new();
        assert_eq!(interrupt_with(&home, signal, &[]).0, 130, "{signal}");
        assert_eq!(home.names(), ["m.checkpoint", "m.checkpoint.pilot", "m.glb"], "{signal}");
        assert_eq!(home.run(&["info", "m.glb"]).code, 0, "{signal}");
    }
}

#[test]
fn an_interrupted_run_says_that_texels_are_missing() {
    let home = Home::new();
    let (code, said) = interrupt_with(&home, "INT", &["--layout", "texels"]);
    assert!(code == 130 && said.contains("the texels are not baked"), "{code}: {said}");
    assert_eq!(home.names(), ["m.checkpoint", "m.checkpoint.pilot", "m.glb"]);
}

/// A bake that takes more than a second.
const BAKE: [&str; 10] = [
    "solve",
    "builtin:cube",
    "-o",
    "b.glb",
    "--accuracy",
    "2%",
    "--layout",
    "texels",
    "--texels-per-meter",
    "80",
];

/// Starts a bake and interrupts it; its exit code, the last it said of its progress, and what it said afterwards.
fn interrupt_bake(home: &Home) -> (i32, serde_json::Value, String) {
    let mut child = home.start(&[&BAKE[..], &["--progress", "json"]].concat());
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    let state = lines
        .by_ref()
        .map(|line| serde_json::from_str(&line).unwrap())
        .find(|state: &serde_json::Value| state["stage"] == "lightmap")
        .unwrap();
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let said = lines.collect();
    (child.wait().unwrap().code().unwrap(), state, said)
}

#[test]
fn a_run_interrupted_in_baking_goes_on_with_it() {
    let home = Home::new();
    let bytes = |name: &str| std::fs::read(home.path(name)).unwrap();
    let sparse = [&BAKE[..9], &["2"]].concat();
    assert_eq!(home.run(&sparse).code, 0);
    let whole = (bytes("b.glb"), bytes("b.exr"));
    let (code, state, said) = interrupt_bake(&home);
    assert_eq!(code, 130, "{said}");
    let share = state["share"].as_f64().unwrap();
    assert!((0.0..=1.0).contains(&share) && state["elapsed_s"].as_f64().unwrap() > 0.0, "{state}");
    assert!(state["left_s"].is_null() || state["left_s"].as_f64().unwrap() >= 0.0, "{state}");
    assert!(said.contains("the texels are not baked") && said.contains("--resume"), "{said}");
    // What an earlier bake left beside the map is not of it.
    assert!(said.contains("b.exr: is of an earlier bake"), "{said}");
    assert_eq!(home.names(), ["b.checkpoint", "b.checkpoint.pilot", "b.exr", "b.glb"]);
    let resumed = home.run(&[&sparse[..], &["--resume"]].concat());
    assert!(resumed.code == 0 && resumed.err.contains("is solved already"), "{resumed:?}");
    assert_eq!(home.names(), ["b.exr", "b.glb"]);
    assert!((bytes("b.glb"), bytes("b.exr")) == whole, "the lightmaps differ");
}

#[test]
fn a_bake_without_time_is_coarse_and_says_so() {
    let home = Home::new();
    assert_eq!(interrupt_bake(&home).0, 130);
    let sparse = [&BAKE[..9], &["2", "--resume", "--json"]].concat();
    let ran = home.run(&[&sparse[..], &["--time-limit", "1ms"]].concat());
    assert!(ran.code == 3 && ran.err.contains("are read coarsely"), "{ran:?}");
    let report = ran.json()["lightmap"].clone();
    assert_eq!(report["texels_coarse"], report["texels_known"], "{report}");
    assert!(report["texels_known"].as_u64().unwrap() > 2000, "{report}");
    // It is not taken for what the map allows, and its density is kept.
    let exported = home.run(&["export", "b.glb", "-o", "e.exr", "--json"]).json();
    assert_eq!(exported["taken_from_map"], false, "{exported}");
    assert_eq!(
        (&exported["texels_coarse"], &exported["texels_per_meter"]),
        (&0.into(), &2.0.into())
    );
    let whole = home.run(&sparse);
    assert!(whole.code == 0 && whole.err.contains("is solved already"), "{whole:?}");
    assert_eq!(whole.json()["lightmap"]["texels_coarse"], 0);
    assert_eq!(home.names(), ["b.exr", "b.glb", "e.exr"]);
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
fn a_resumed_run_that_comes_to_less_keeps_the_map_and_says_so() {
    let home = Home::new();
    let bytes = || std::fs::read(home.path("m.glb")).unwrap();
    let limited = |limit, flags: &[&str]| {
        home.run(&[&SOLVE[..], &["--json", "--time-limit", limit], flags].concat())
    };
    // Elements that were cut short leave nothing to go on from, so that a resumed run begins anew.
    let first = limited("1s", &[]);
    let (whole, known) = (bytes(), first.json());
    assert_eq!(first.code, 3, "{first:?}");
    let resumed = limited("1ms", &["--resume"]);
    let said = resumed.json();
    assert_eq!(resumed.code, 3, "{resumed:?}");
    assert!(bytes() == whole, "the map was replaced: {known} by {said}");
    for key in ["accuracy_reached", "increments", "rays", "receivers"] {
        assert_eq!(said[key], known[key], "{key}: {said}");
    }
    let less = &said["kept_instead_of"];
    assert!(less["rays"].as_u64() < known["rays"].as_u64(), "{said}");
    assert!(
        resumed.err.contains("m.glb: kept, because the result of this run is less accurate"),
        "{resumed:?}"
    );
    // Who solves from the beginning is told what was there.
    let anew = limited("1ms", &[]);
    assert!(bytes() != whole && anew.err.contains("m.glb: was more accurate before"), "{anew:?}");
    assert!(anew.json()["kept_instead_of"].is_null(), "{anew:?}");
}

#[test]
fn a_resumed_run_says_that_it_had_no_time_for_finer_elements() {
    let home = Home::new();
    assert_eq!(interrupt(&home), 130);
    let path = home.path("m.checkpoint");
    let mut state = checkpoint::state(&checkpoint::read(&path, 1 << 30).unwrap()).unwrap();
    assert!(!state.stayed_coarse, "it had no limit");
    state.stayed_coarse = true;
    checkpoint::write(&path, &checkpoint::of_state(&state)).unwrap();
    let resumed = home.run(&[&SOLVE[..], &["--resume"]].concat());
    let says = resumed.err.contains("went on with coarser elements");
    assert!(resumed.code == 0 && says, "{resumed:?}");
}

#[test]
fn a_run_with_other_flags_is_not_resumed() {
    let home = Home::new();
    assert_eq!(interrupt(&home), 130);
    let ran = home.run(&[&SOLVE[..], &["--resume", "--seed", "2"]].concat());
    assert!(ran.code == 2 && ran.err.contains("seed"), "{ran:?}");
}

#[test]
fn a_resumed_run_does_not_repeat_its_pilot() {
    let home = Home::new();
    assert_eq!(interrupt(&home), 130);
    let pilot = std::fs::read(home.path("m.checkpoint.pilot")).unwrap();
    let mut spoilt = pilot.clone();
    spoilt[pilot.len() / 2] ^= 1;
    home.file("m.checkpoint.pilot", &spoilt);
    let resume = [&SOLVE[..], &["--resume"]].concat();
    let refused = home.run(&resume);
    assert!(
        refused.code == 2 && refused.err.contains("m.checkpoint.pilot: its contents"),
        "{refused:?}"
    );
    home.file("m.checkpoint.pilot", &pilot);
    let resumed = home.run(&resume);
    assert!(resumed.code == 0 && !resumed.err.contains("subdividing"), "{resumed:?}");
    assert_eq!(home.names(), ["m.glb"]);
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
#[ignore = "slow: cargo xtask test --all"]
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
fn an_interrupted_picture_is_the_mean_of_its_rounds() {
    let home = Home::new();
    let ran = home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let view = ["render", "m.glb", "-o", "v.png", "--size", "64x48", "--picture-accuracy", "0.001"];
    let mut child = home.start(&view);
    // It listens before it writes the picture that will get better.
    while !home.path("v.png").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before there was a picture");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let mut told = String::new();
    std::io::Read::read_to_string(&mut child.stdout.take().unwrap(), &mut told).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{told}");
    assert!(told.contains("CIE94 in the mean (goal 0.0010)"), "{told}");
    assert!(home.path("v.png").exists());
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
    assert!(said.contains("of 200 runs are done, and only they are reported"), "{said}");
}

/// Below `nohup` a run outlives its terminal.
#[cfg(target_os = "linux")]
#[test]
fn the_end_of_the_terminal_is_none_below_nohup() {
    let home = Home::new();
    let run = [&SOLVE[..], &["--progress", "json"]].concat();
    let mut child = home.start_below_nohup(&run);
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap);
    let is_running = |line: String| line.contains("\"increments\"");
    assert!(lines.by_ref().any(is_running));
    let id = child.id().to_string();
    let send = |signal: &str| Command::new("kill").args([signal, &id]).status().unwrap().success();
    assert!(send("-HUP"));
    assert!(lines.by_ref().any(is_running), "it goes on");
    assert!(send("-INT"));
    lines.for_each(drop);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(home.names().contains(&"m.checkpoint".to_owned()), "{:?}", home.names());
}
