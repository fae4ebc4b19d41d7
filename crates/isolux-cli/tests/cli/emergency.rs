//! Emergency lighting by EN 1838.

use crate::ran::Home;
use serde_json::Value;

/// White walls, which must not count; a route of 10 x 2 m, and the whole floor.
const CORRIDOR: &str = "[materials.white]\ndiffuse = 0.9\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [10, 4, 3], inward = true }\nmaterial = \"white\"\n\
    [[grid]]\nname = \"route\"\ncorner = [0, 1, 0]\nu = [10, 0, 0]\nv = [0, 2, 0]\n\
    [[grid]]\nname = \"hall\"\ncorner = [0, 0, 0]\nu = [10, 0, 0]\nv = [0, 4, 0]\n";

fn lamp(x: f64, candela: f64, more: &str) -> String {
    format!(
        "[[luminaire]]\nposition = [{x}, 2, 2.5]\nisotropic = {{ intensity_cd = {candela} }}\n{more}\n"
    )
}

/// On the floor, so far along and across from below a lamp.
fn floor_lx(candela: f64, along: f64, across: f64) -> f64 {
    let squared: f64 = 6.25 + along * along + across * across;
    candela * 2.5 / (squared * squared.sqrt())
}

fn judged(scene: &str, more: &[&str]) -> (i32, Vec<Value>) {
    let home = Home::new();
    home.file("room.toml", scene);
    let ran = home.run(&[&["grid", "room.toml", "--json", "--emergency"], more].concat());
    assert!(ran.code <= 1, "{ran:?}");
    let json = ran.json();
    assert_eq!(json["standard"], "EN 1838:2013");
    (ran.code, json["requirements"].as_array().unwrap().clone())
}

fn verdicts(judged: &[Value]) -> Vec<&str> {
    judged.iter().map(|of| of["verdict"].as_str().unwrap()).collect()
}

#[test]
fn escape_routes_by_hand() {
    // A bright lamp that is not marked, and one of 20 cd in the middle: 0.29 lx at the ends of the route.
    let one = CORRIDOR.to_owned() + &lamp(3.0, 900.0, "") + &lamp(5.0, 20.0, "emergency = true");
    let (code, found) = judged(&one, &["escape-route", "--name", "route"]);
    assert_eq!((code, verdicts(&found)), (1, vec!["not_met", "not_met", "met"]), "{found:?}");
    let value = |k: usize| found[k]["value"].as_f64().unwrap();
    let [end, corner] = [0.0, 0.5].map(|across| floor_lx(20.0, 5.0, across));
    assert!((value(0) / end - 1.0).abs() < 1e-4, "{} for {end}", value(0));
    assert!((value(1) / corner - 1.0).abs() < 1e-4, "{} for {corner}", value(1));
    let ratio = floor_lx(20.0, 0.0, 0.0) / end;
    assert!((value(2) / ratio - 1.0).abs() < 1e-4, "{} for {ratio}", value(2));
    // A tenth of lamps of ten times as much, one every four metres.
    let share = "emergency_flux_share = 0.1";
    let three = [1.0, 5.0, 9.0].map(|x| lamp(x, 200.0, share)).concat();
    let (code, found) =
        judged(&(CORRIDOR.to_owned() + &three), &["escape-route", "--name", "route"]);
    assert_eq!((code, verdicts(&found)), (0, vec!["met"; 3]), "{found:?}");
}

#[test]
fn open_and_high_risk_areas_by_hand() {
    let lamp = lamp(5.0, 30.0, "emergency = true");
    let scene = CORRIDOR.to_owned() + &lamp;
    let (code, found) = judged(&scene, &["open-area", "--name", "hall"]);
    // At the corners of the core, 4.2 m and 1.3 m off or so: 0.5 lx, and more than the 40th part of 4.8 lx.
    let least = found[0]["value"].as_f64().unwrap();
    let bound = |along: f64, across: f64| floor_lx(30.0, along, across);
    assert!(least > bound(4.5, 1.5) && least < bound(3.5, 1.0), "{least}");
    assert_eq!(
        (code == 0, verdicts(&found)[0] == "met"),
        (least >= 0.5, least >= 0.5),
        "{found:?}"
    );
    assert_eq!(found[1]["verdict"], "met");
    let (code, found) = judged(&scene, &["high-risk", "--task", "500", "--name", "hall"]);
    assert_eq!((code, found[0]["verdict"].as_str()), (1, Some("not_met")), "{found:?}");
    assert!(found[0]["condition"].as_str().unwrap().contains("50 lx"), "{found:?}");
    let (_, found) = judged(&scene, &["high-risk", "--task", "50lx", "--name", "hall"]);
    assert!(found[0]["condition"].as_str().unwrap().contains("15 lx"), "{found:?}");
}

#[test]
fn maps_keep_the_marks_and_darkness_is_not_met() {
    let home = Home::new();
    // A screen below the lamp.
    let screen =
        "[[geometry]]\nbox = { min = [0, 0, 2.2], max = [10, 4, 2.3] }\nmaterial = \"white\"\n";
    home.file(
        "room.toml",
        CORRIDOR.to_owned() + screen + &lamp(5.0, 50.0, "emergency = true") + &lamp(2.0, 50.0, ""),
    );
    let solve = ["solve", "room.toml", "-o", "map.glb", "--quality", "draft"];
    assert_eq!(home.run(&solve).code, 0);
    let asked = ["grid", "map.glb", "--name", "route", "--emergency", "escape-route"];
    let ran = home.run(&asked);
    assert_eq!(ran.code, 1, "{ran:?}");
    assert_eq!(ran.out.matches("not met").count(), 3, "{}", ran.out);
    assert!(ran.out.contains("nothing is reflected"), "{}", ran.out);
}

#[test]
fn what_cannot_be_judged_is_refused() {
    let home = Home::new();
    home.file("dark.toml", CORRIDOR.to_owned() + &lamp(5.0, 30.0, "emergency = false"));
    home.file("room.toml", CORRIDOR.to_owned() + &lamp(5.0, 30.0, "emergency = true"));
    let both = lamp(5.0, 30.0, "emergency = false\nemergency_flux_share = 0.1");
    home.file("both.toml", CORRIDOR.to_owned() + &both);
    for (arguments, told) in [
        (&["dark.toml", "--emergency", "open-area"][..], "no luminaire of dark.toml is marked"),
        (&["both.toml", "--emergency", "open-area"], "remove one of them"),
        (&["room.toml", "--emergency", "escape-route", "--name", "hall"], "is 4 m wide"),
        (&["room.toml", "--emergency", "high-risk"], "add --task LX"),
        (&["room.toml", "--emergency", "open-area", "--task", "500"], "leave it out"),
        (&["room.toml", "--emergency", "open-area", "--csv", "x.csv"], "cannot be used with"),
        (&["room.toml", "--emergency", "stairs"], "escape-route"),
    ] {
        let ran = home.run(&[&["grid"], arguments].concat());
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains(told), "{arguments:?}: {}", ran.err);
    }
}

/// A route and a machine that are marked, and a desk that is none of emergency lighting.
const MARKED: &str = "[[grid]]\nname = \"way out\"\ncorner = [0, 1, 0]\nu = [10, 0, 0]\nv = [0, 2, 0]\nemergency = \"escape-route\"\n\
    [[grid]]\nname = \"saw\"\ncorner = [4.5, 1.5, 0.8]\nu = [1, 0, 0]\nv = [0, 1, 0]\nemergency = \"high-risk\"\ntask_lx = 50\n";

#[test]
fn grids_that_are_marked_are_judged_as_marked_and_nowhere_else() {
    let home = Home::new();
    let lamps = [1.0, 5.0, 9.0].map(|x| lamp(x, 100.0, "emergency = true")).concat();
    home.file("room.toml", CORRIDOR.to_owned() + MARKED + &lamps);
    let ran = home.run(&["grid", "room.toml", "--emergency", "as-marked", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    let found: Vec<(&str, &str)> = json["requirements"]
        .as_array()
        .unwrap()
        .iter()
        .map(|of| (of["grid"].as_str().unwrap(), of["condition"].as_str().unwrap()))
        .collect();
    assert_eq!(found.len(), 5, "{found:?}");
    assert!(found.contains(&("saw", "Em >= 15 lx")) && found[0].0 == "way out", "{found:?}");
    // Maps keep the marks, and scenes that are written have them, too.
    assert_eq!(home.run(&["solve", "room.toml", "-o", "map.glb", "--quality", "draft"]).code, 0);
    let names = |source: &str| -> Vec<String> {
        let json = home.run(&["grid", source, "--json"]).json();
        let grids = json["grids"].as_array().unwrap().clone();
        grids.iter().map(|grid| grid["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names("map.glb"), ["route", "hall"]);
    assert_eq!(home.run(&["scene", "room.toml", "-o", "again"]).code, 0);
    assert_eq!(names("again/scene.toml"), ["route", "hall"]);
    let again = home.run(&["grid", "again/scene.toml", "--emergency", "as-marked", "--json"]);
    assert_eq!(again.json()["requirements"].as_array().unwrap().len(), 5, "{again:?}");
    let report = home.run(&["report", "map.glb", "-o", "report.html", "--json"]);
    assert_eq!((report.code, report.json()["met"].as_u64()), (0, Some(5)), "{report:?}");
    let text = std::fs::read_to_string(home.path("report.html")).unwrap();
    assert!(text.contains("Emergency lighting") && text.contains("on the centre line"));
    // With a hundredth of the light only ratios hold, in the report, too.
    let dimmed = home.run(&[
        "report",
        "room.toml",
        "-o",
        "dim.html",
        "--maintenance-factor",
        "0.01",
        "--json",
    ]);
    assert_eq!((dimmed.code, dimmed.json()["met"].as_u64()), (1, Some(2)), "{dimmed:?}");
}

#[test]
fn wrong_marks_are_refused() {
    for (more, words) in [
        ("emergency = \"high-risk\"\n", "add task_lx"),
        ("emergency = \"open-area\"\ntask_lx = 5\n", "no area of high risk"),
        ("emergency = \"exit\"\n", "escape-route"),
    ] {
        let home = Home::new();
        let lamp = lamp(5.0, 9.0, "emergency = true");
        home.file("room.toml", CORRIDOR.to_owned() + more + &lamp);
        let ran = home.run(&["grid", "room.toml", "--emergency", "as-marked"]);
        assert!(ran.code == 2 && ran.err.contains(words), "{more}: {ran:?}");
    }
    let home = Home::new();
    home.file("room.toml", CORRIDOR.to_owned() + &lamp(5.0, 9.0, "emergency = true"));
    let ran = home.run(&["grid", "room.toml", "--emergency", "as-marked"]);
    assert!(ran.code == 2 && ran.err.contains("no grid of"), "{ran:?}");
}
