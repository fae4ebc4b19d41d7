//! A year of daylight, skies, and requirements on grids.

use crate::ran::Home;
use serde_json::Value;
use std::fmt::Write;

/// A room of 4 x 5 x 3 m, open to the south above one metre, with a grid on the desks.
const ROOM: &str = "name = \"room\"\n[materials.paint]\ndiffuse = 0.5\n\
    [[geometry]]\npolygon = [[0, 0, 0], [4, 0, 0], [4, 5, 0], [0, 5, 0]]\nmaterial = \"paint\"\n\
    [[geometry]]\npolygon = [[0, 0, 3], [0, 5, 3], [4, 5, 3], [4, 0, 3]]\nmaterial = \"paint\"\n\
    [[geometry]]\npolygon = [[0, 0, 0], [0, 5, 0], [0, 5, 3], [0, 0, 3]]\nmaterial = \"paint\"\n\
    [[geometry]]\npolygon = [[4, 0, 0], [4, 0, 3], [4, 5, 3], [4, 5, 0]]\nmaterial = \"paint\"\n\
    [[geometry]]\npolygon = [[0, 5, 0], [4, 5, 0], [4, 5, 3], [0, 5, 3]]\nmaterial = \"paint\"\n\
    [[geometry]]\npolygon = [[0, 0, 0], [0, 0, 1], [4, 0, 1], [4, 0, 0]]\nmaterial = \"paint\"\n\
    [[grid]]\nname = \"desks\"\ncorner = [0.5, 0.5, 0.8]\nu = [3, 0, 0]\nv = [0, 4, 0]\nspacing = 1.0\n";

/// Days of the months.
const DAYS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// A year in Berlin: days by turns overcast and clear, with light from 8 to 16.
fn weather() -> String {
    let mut text = "LOCATION,Berlin,BE,DEU,Test,103840,52.47,13.40,1.0,49.0\n\
                    DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
        .to_owned();
    for (month, days) in (1..).zip(DAYS) {
        for day in 1..=days {
            let (direct, diffuse) = if day % 2 == 0 { (800, 100) } else { (0, 200) };
            for hour in 1..=24 {
                let is_lit = (9..=16).contains(&hour);
                let [direct, diffuse] = [direct, diffuse].map(|w| if is_lit { w } else { 0 });
                let columns = format!("{},{direct},{diffuse},0,0,0,0", direct + diffuse);
                let _ = writeln!(
                    text,
                    "2001,{month},{day},{hour},60,?9?9,20,11,50,101325,0,0,300,{columns}"
                );
            }
        }
    }
    text
}

fn home() -> Home {
    let home = Home::new();
    home.file("room.toml", ROOM);
    home.file("year.epw", weather());
    home
}

fn value(json: &Value, key: &str) -> [f64; 3] {
    ["value", "low", "high"].map(|end| json[key][end].as_f64().unwrap())
}

#[test]
fn a_year_of_daylight_has_figures_with_intervals() {
    let home = home();
    let arguments = ["daylight", "room.toml", "--weather", "year.epw", "--paths", "1024"];
    let ran = home.run(&[&arguments[..], &["--json", "--csv", "points.csv"]].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let grid = &json["grids"][0];
    assert_eq!(grid["points"].as_array().unwrap().len(), 12);
    let [factor, low, high] = value(grid, "daylight_factor_mean");
    assert!(low < factor && factor < high, "{grid}");
    // Half of the sky at most, and a part of that by reflection.
    assert!(0.02 < factor && factor < 0.5, "{factor}");
    let [straight, ..] = value(grid, "sky_component_mean");
    assert!(straight < factor, "{straight} {factor}");
    let useful: f64 = (0..4).map(|k| grid["useful_daylight"][k]["value"].as_f64().unwrap()).sum();
    assert!((useful - 1.0).abs() < 1e-9, "{useful}");
    // Sun comes in on clear days.
    let sunny = |point: &Value| point["sunny_h"].as_f64().unwrap();
    let most = grid["points"].as_array().unwrap().iter().map(sunny).fold(0.0, f64::max);
    assert!((100.0..=1500.0).contains(&most), "{most}");
    let csv = std::fs::read_to_string(home.path("points.csv")).unwrap();
    assert_eq!(csv.lines().count(), 13);
    let again = home.run(&[&arguments[..], &["--json", "--threads", "1"]].concat());
    assert!(again.code == 2, "there is no such flag: {again:?}");
    let text = home.run(&arguments);
    for part in ["EN 17037", "sDA 300/50%", "ASE 1000,250h", "UDI", "blinds"] {
        assert!(text.out.contains(part), "{part}: {}", text.out);
    }
}

#[test]
fn bad_years_are_refused() {
    let home = home();
    let part: String = weather().lines().take(3000).map(|line| format!("{line}\n")).collect();
    home.file("part.epw", part);
    home.file("empty.epw", "LOCATION,Berlin,BE,DEU,Test,103840,52.47,13.40,1.0,49.0\n");
    for (weather, more, part) in [
        ("none.epw", [].as_slice(), "none.epw"),
        ("empty.epw", &[], "empty.epw"),
        ("part.epw", &[], "8760"),
        ("year.epw", &["--hours", "18..8"], "8..18"),
        ("year.epw", &["--name", "beds"], "beds"),
        ("year.epw", &["--ground-reflectance", "2"], "0.2"),
        ("year.epw", &["--paths", "3"], "256"),
    ] {
        let ran = home.run(&[&["daylight", "room.toml", "--weather", weather], more].concat());
        assert_eq!(ran.code, 2, "{weather} {more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
}

#[test]
fn requirements_are_met_or_not_or_undecided() {
    let home = home();
    let sky = "[sky]\ntype = \"overcast\"\nhorizontal_lx = 10000\n";
    home.file("lit.toml", format!("{ROOM}{sky}"));
    let solved = home.run(&["solve", "lit.toml", "-o", "map.glb", "--quality", "draft"]);
    assert!(solved.code == 0 || solved.code == 3, "{solved:?}");
    let judged = |what: &str| {
        let ran = home.run(&["grid", "map.glb", "--require", what, "--json"]);
        let json: Value = serde_json::from_str(&ran.out).unwrap();
        let first = &json["requirements"][0];
        let probability = first["probability"].as_f64().unwrap();
        (ran.code, first["verdict"].as_str().unwrap().to_owned(), probability)
    };
    let (code, verdict, probability) = judged("desks: Em >= 100");
    assert_eq!((code, verdict.as_str()), (0, "met"));
    assert!(probability > 0.99, "{probability}");
    let (code, verdict, probability) = judged("Em >= 50000 lx");
    assert_eq!((code, verdict.as_str()), (1, "not_met"));
    assert!(probability < 0.01, "{probability}");
    for (what, part) in [
        ("Em", "no condition"),
        ("beds: Em >= 1", "no grid `beds`"),
        ("EN 12464-1 1.1", "34.2"),
        ("Ex >= 3", "no figure"),
    ] {
        let ran = home.run(&["grid", "map.glb", "--require", what]);
        assert_eq!(ran.code, 2, "{what}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    // A scene is solved until a requirement is decided.
    let ran = home.run(&["grid", "lit.toml", "--require", "desks: Em >= 100"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.out.contains("Em >= 100 lx: met"), "{}", ran.out);
}

/// The daylight factor is what a grid has below an overcast sky, the ground beyond included.
#[test]
fn the_daylight_factor_is_that_of_a_grid_below_an_overcast_sky() {
    let home = home();
    let factor = |reflectance: &str| {
        let flags = ["--paths", "16384", "--ground-reflectance", reflectance, "--json"];
        let ran =
            home.run(&[&["daylight", "room.toml", "--weather", "year.epw"], &flags[..]].concat());
        value(&ran.json()["grids"][0], "daylight_factor_mean")
    };
    let [black, ..] = factor("0");
    let [grey, low, high] = factor("0.5");
    assert!(grey > 1.05 * black, "{grey} {black}");
    let sky = "overcast, horizontal_lx=1000, ground_reflectance=0.5";
    let grid = home.run(&["grid", "room.toml", "--sky", sky, "--accuracy", "1%", "--json"]);
    let [lx, from, to] = value(&grid.json()["grids"][0], "mean_lx").map(|lx| lx / 1000.0);
    assert!(low < to && from < high, "{lx} ({from} to {to}) and {grey} ({low} to {high})");
}
