//! Skies that are asked for, and weather files.

use crate::ran::Home;

/// A floor of an OBJ, in the open.
const FLOOR: &str = "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\nf 1 2 3 4\n";

const WEATHER: &str = "LOCATION,Berlin,-,DEU,Test,103840,52.47,13.40,1.0,49.0\nDATA PERIODS,1,1,Data,Sunday,6/21,6/21\n\
    2001,6,21,12,0,?9,20,11,50,101325,0,0,300,700,500,200,0,0,0,0\n\
    2001,6,21,13,0,?9,20,11,50,101325,0,0,300,700,100,200,0,0,0,0\n";

const CLEAR: &str =
    "clear, horizontal_lx=12000, sun.azimuth_deg=180, sun.elevation_deg=40, sun_normal_lx=80000";

fn home() -> Home {
    let home = Home::new();
    home.file("floor.obj", FLOOR);
    home.file("place.epw", WEATHER);
    home
}

#[test]
fn a_scene_without_light_is_lit_by_a_sky() {
    let home = home();
    let dark = home.run(&["check", "floor.obj", "--json"]);
    assert!(dark.out.contains("there is no light"), "{dark:?}");
    let lit = home.run(&["check", "floor.obj", "--sky", CLEAR, "--json"]);
    assert!(!lit.out.contains("there is no light"), "{lit:?}");
    let json = lit.json();
    assert_eq!(json["skies"][0]["kind"], "formula", "{json}");
    let near = |value: &serde_json::Value, due: f64| {
        let value = value.as_f64().unwrap();
        // A few roundings, of sines of degrees among them.
        assert!((value / due - 1.0).abs() < 1e-9, "{value} {due}");
    };
    near(&json["skies"][0]["horizontal_lx"], 12_000.0);
    let sun = &json["suns"][0];
    near(&sun["normal_lx"], 80_000.0);
    near(&sun["elevation_deg"], 40.0);
    near(&sun["azimuth_deg"], 180.0);
    near(&sun["angle_deg"], 0.533);
    // Without a wall between, sky and sun are all: 12 000 lx and 80 000 lx times the sine of 40 degrees.
    let probe = home.run_with_input(
        &["probe", "floor.obj", "--points", "-", "--json", "--sky", CLEAR],
        "2 0 2 0 1 0\n",
    );
    let point = &probe.json()["points"][0];
    let (lx, error_lx) =
        (point["illuminance_lx"].as_f64().unwrap(), point["standard_error_lx"].as_f64().unwrap());
    let due = 12_000.0 + 80_000.0 * 40_f64.to_radians().sin();
    assert!((lx - due).abs() < 5.0 * error_lx + 1e-4 * due, "{lx} {error_lx} {due}");
}

#[test]
fn skies_in_words_are_told_in_words() {
    let home = home();
    let info = home.run(&["info", "floor.obj", "--sky", CLEAR]);
    assert_eq!(info.code, 0, "{info:?}");
    let words = info.out.split_whitespace().collect::<Vec<_>>().join(" ");
    for expected in
        ["12000 lx on open ground", "40.0 degrees above the horizon", "a disc of 0.533 degrees"]
    {
        assert!(words.contains(expected), "{expected}: {info:?}");
    }
    let weather = home.run(&["check", "floor.obj", "--sky", "place.epw, time=2026-06-21T12:00:00"]);
    assert!(weather.out.contains("sun "), "{weather:?}");
    let wrong = home.run(&["check", "floor.obj", "--sky", "cloudy"]);
    assert_eq!(wrong.code, 2, "{wrong:?}");
    assert!(wrong.err.contains("there is no sky `cloudy`"), "{wrong:?}");
    assert!(!wrong.err.contains("line"), "words have no lines: {wrong:?}");
    let idle = home.run(&["new", "empty", "-o", "room.toml", "--sky", "overcast"]);
    assert!(idle.err.contains("no scene was read"), "{idle:?}");
}

#[test]
fn weather_files_are_told() {
    let home = home();
    let info = home.run(&["info", "place.epw", "--json"]).json();
    assert_eq!((&info["place"], &info["hours"]), (&"Berlin, DEU".into(), &2.into()), "{info}");
    assert_eq!((&info["sunshine_h"], &info["diffuse_horizontal_kwh_m2"]), (&1.into(), &0.4.into()));
    assert!(info["most_global_horizontal_lx"].is_null());
    let text = home.run(&["info", "place.epw"]);
    assert!(text.out.contains("52.47 north") && text.err.contains("has 2 hours"), "{text:?}");
}

#[test]
fn maps_keep_their_light() {
    let home = home();
    let ran = home.run(&[
        "solve",
        "floor.obj",
        "--sky",
        "uniform,horizontal_lx=1000",
        "--accuracy",
        "10%",
        "-o",
        "map.glb",
    ]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let info = home.run(&["info", "map.glb", "--sky", "overcast"]);
    assert!(info.err.contains("`--sky` is left out"), "{info:?}");
}
