//! Lighting reports, and what scenes require.

use crate::ran::Home;
use serde_json::Value;

/// A room with a lamp in the middle, 0.5 everywhere.
const ROOM: &str = "name = \"Room 7\"\n[materials.paint]\ndiffuse = 0.5\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 6, 3], inward = true }\nmaterial = \"paint\"\n\
    [[luminaire]]\nname = \"globe\"\nposition = [2, 3, 2.5]\nisotropic = { flux_lm = 6000 }\n\
    [[camera]]\nname = \"door\"\nposition = [0.5, 0.5, 1.6]\ntarget = [3, 5, 1]\n\
    [[grid]]\nname = \"desks\"\ncorner = [0.5, 0.5, 0.75]\nu = [3, 0, 0]\nv = [0, 5, 0]\n";

fn required(conditions: &str) -> String {
    format!("{ROOM}[[requirement]]\ngrid = \"desks\"\nconditions = \"{conditions}\"\n")
}

fn report(home: &Home, more: &[&str]) -> (i32, String) {
    let ran = home.run(&[&["report", "room.toml", "-o", "r.html"], more].concat());
    assert!(ran.code < 2, "{ran:?}");
    (ran.code, std::fs::read_to_string(home.path("r.html")).unwrap())
}

#[test]
fn a_report_holds_what_was_asked_and_found() {
    let home = Home::new();
    home.file("room.toml", required("Em >= 100, U0 >= 0.2"));
    let more = ["--client", "A & B", "--date", "2026-11-29", "--maintenance-factor", "0.8"];
    let (code, text) = report(&home, &more);
    assert_eq!(code, 0);
    for part in [
        "<h1>Room 7</h1>",
        "A &amp; B",
        "2026-11-29",
        "Em \u{2265} 100 lx",
        "globe",
        "paint",
        "0.80",
    ] {
        assert!(text.contains(part), "{part}");
    }
    assert!(
        text.matches("image/png").count() == 3,
        "a picture on the cover, and two of the camera"
    );
    assert!(text.matches("image/svg+xml").count() == 2, "a plan and a diagram");
    let german = report(&home, &["--language", "de"]).1;
    assert!(german.contains("Lichttechnischer Bericht") && german.contains("lang=\"de\""));
}

/// Figures of a report are those of `grid`.
#[test]
fn a_report_of_a_map_says_what_grid_says() {
    let home = Home::new();
    home.file("room.toml", required("Em >= 5000"));
    let solved = home.run(&["solve", "room.toml", "-o", "map.glb", "--accuracy", "5%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    let grid = home.run(&["grid", "map.glb", "--json"]);
    assert_eq!(grid.code, 1, "the requirement is in the map: {grid:?}");
    let json: Value = serde_json::from_str(&grid.out).unwrap();
    assert_eq!(json["requirements"][0]["condition"], "Em >= 5000 lx");
    assert_eq!(json["requirements"][0]["verdict"], "not_met");
    let ran = home.run(&["report", "map.glb", "-o", "r.html", "--json"]);
    assert_eq!(ran.code, 1, "{ran:?}");
    let told: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((&told["requirements"], &told["met"]), (&1.into(), &0.into()));
    let text = std::fs::read_to_string(home.path("r.html")).unwrap();
    let mean = json["grids"][0]["mean_lx"]["value"].as_f64().unwrap();
    let whole = format!("<p class=\"value\">{}", (mean / 10.0).floor());
    assert!(text.contains(&whole), "{mean}");
    assert!(text.contains("badge not-met"));
}

#[test]
fn what_cannot_be_reported_is_refused() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    for (more, part) in [
        (["-o", "r.txt"].as_slice(), ".html or .pdf"),
        (&["-o", "r.html", "--camera", "none"], "choose one"),
        (&["-o", "r.html", "--require", "U0 >= 6"], "at most 1"),
        (&["-o", "r.html", "--require", "floor: Em >= 6"], "there is no grid `floor`"),
        (&["-o", "r.html", "--paths", "1000"], "--weather"),
        (&["-o", "r.html", "--weather", "none.epw"], "none.epw"),
        (&["-o", "none/r.html"], "none"),
    ] {
        let ran = home.run(&[&["report", "room.toml"], more].concat());
        assert_eq!(ran.code, 2, "{more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    assert_eq!(home.names(), ["room.toml"], "nothing is half-written");
    if !cfg!(feature = "pdf") {
        let ran = home.run(&["report", "room.toml", "-o", "r.pdf"]);
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains("--features pdf"), "{}", ran.err);
    }
}

#[test]
fn requirements_of_scenes_are_checked_where_they_stand() {
    let home = Home::new();
    for (text, part) in [
        ("[[requirement]]\n", "without `task` and `conditions`"),
        ("[[requirement]]\nconditions = \"Em > 5\"\n", "is no condition"),
        ("[[requirement]]\nconditions = \"U0 >= 1.5\"\n", "at most 1"),
        ("[[requirement]]\ntask = \"EN 12464-1 99.9\"\n", "99.9"),
        ("[[requirement]]\ntask = \"Em >= 5\"\n", "a task is a row of a standard"),
        ("[[requirement]]\ngrid = \"floor\"\ntask = \"EN 12464-1 34.2\"\n", "no grid `floor`"),
        ("[[requirement]]\ncolour = 1\n", "colour"),
    ] {
        home.file("room.toml", format!("{ROOM}{text}"));
        let ran = home.run(&["check", "room.toml"]);
        assert_eq!(ran.code, 2, "{text}: {ran:?}");
        assert!(ran.err.contains(part) && ran.err.contains("room.toml"), "{part}: {}", ran.err);
    }
}

/// Requirements are written with the scene, and read again.
#[test]
fn requirements_come_back() {
    let home = Home::new();
    let task = "[[requirement]]\ngrid = \"desks\"\ntask = \"EN 12464-1 34.2\"\n";
    home.file("room.toml", required("Em >= 100 lx, Ud >= 0.1") + task);
    let ran = home.run(&["scene", "room.toml", "-o", "again"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let written = std::fs::read_to_string(home.path("again/scene.toml")).unwrap();
    assert!(written.contains("conditions = \"Em >= 100 lx, Ud >= 0.1\""), "{written}");
    assert!(written.contains("task = \"EN 12464-1 34.2\""), "{written}");
    let ran = home.run(&["grid", "again/scene.toml", "--accuracy", "10%", "--json"]);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["requirements"].as_array().unwrap().len(), 4);
}

/// Fluxes are in proportion, lines add as squares, and the report has the budget of the command.
#[test]
fn a_budget_adds_up() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let inputs = ["--flux", "5%", "--reflectance", "10%"];
    let ran = home.run(&[&["budget", "room.toml", "--json"], inputs.as_slice()].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let grid = &json["grids"][0];
    let number = |of: &Value| of.as_f64().unwrap();
    let lines = grid["lines"].as_array().unwrap();
    let kinds: Vec<&str> =
        lines.iter().map(|line| line["source"]["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["calculation", "flux", "reflectance"]);
    let mean_lx = number(&grid["mean_lx"]["value"]);
    assert!((number(&lines[1]["half_lx"]) - 0.05 * mean_lx).abs() < 1e-9 * mean_lx);
    // Walls of 0.5 everywhere: reflected light is some part of the mean, and depends on them by more than its tenth.
    assert!(number(&lines[2]["half_lx"]) > 0.01 * mean_lx, "{grid}");
    let squares: f64 = lines.iter().map(|line| number(&line["half_lx"]).powi(2)).sum();
    let half_lx = number(&grid["with_inputs_lx"]["high"]) - mean_lx;
    assert!((half_lx - squares.sqrt()).abs() < 1e-9 * mean_lx, "{half_lx}");
    let shares: f64 = lines.iter().map(|line| number(&line["share"])).sum();
    assert!((shares - 1.0).abs() < 1e-12);
    let text = report(&home, &inputs).1;
    assert!(text.contains("Reflectance of paint") && text.contains("Luminous flux"));
    for (more, part) in [(&[][..], "--flux 5%"), (&["--flux", "x"], "--flux")] {
        let ran = home.run(&[&["budget", "room.toml"], more].concat());
        assert_eq!(ran.code, 2, "{more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
}
