//! Installed power, for every square metre of floor, and for 100 lx.

use crate::ran::Home;
use serde_json::Value;

const BOX: &str = "[materials.white]\ndiffuse = 0.5\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [6, 5, 3], inward = true }\nmaterial = \"white\"\n";

fn lamp(place: &str, more: &str) -> String {
    format!("[[luminaire]]\nposition = {place}\nisotropic = {{ flux_lm = 3000 }}\n{more}\n")
}

fn info(scene: &str) -> Value {
    let home = Home::new();
    home.file("room.toml", scene);
    let ran = home.run(&["info", "room.toml", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    ran.json()
}

#[test]
fn floors_end_at_walls_and_furniture_stands_on_them() {
    let lamps = lamp("[1, 1, 2.8]", "power_w = 30") + &lamp("[2, 1, 2.8]", "power_w = 60");
    let desk =
        "[[geometry]]\nbox = { min = [1, 1, 0], max = [3, 2, 0.75] }\nmaterial = \"white\"\n";
    let wall = "[[geometry]]\nbox = { min = [3, 0, 0], max = [3.2, 5, 3] }\nmaterial = \"white\"\n";
    let garden =
        "[[geometry]]\nbox = { min = [-6, 0, -0.2], max = [0, 5, -0.1] }\nmaterial = \"white\"\n";
    for (more, floor_m2) in [("", 30.0), (desk, 30.0), (wall, 15.0), (garden, 30.0)] {
        let found = info(&(BOX.to_owned() + more + &lamps));
        assert_eq!(found["installed_power_w"], 90.0, "{found}");
        let m2 = found["floor_m2"].as_f64().unwrap();
        // Half a cell along each side.
        assert!((m2 / floor_m2 - 1.0).abs() < 0.01, "{m2} for {floor_m2}");
        let w_m2 = found["power_density_w_m2"].as_f64().unwrap();
        assert!((w_m2 - 90.0 / m2).abs() < 1e-9, "{found}");
    }
    let found = info(&(BOX.to_owned() + &lamps));
    assert!((found["floor_m2"].as_f64().unwrap() - 30.0).abs() < 1e-4, "a room alone is exact");
}

#[test]
fn unknown_power_is_told_and_is_not_zero() {
    let home = Home::new();
    home.file(
        "room.toml",
        BOX.to_owned() + &lamp("[1, 1, 2.8]", "power_w = 30") + &lamp("[2, 1, 2.8]", ""),
    );
    for command in ["info", "check"] {
        let json = home.run(&[command, "room.toml", "--json"]).json();
        assert!(json["installed_power_w"].is_null() && json["power_density_w_m2"].is_null());
        assert_eq!(
            (&json["known_power_w"], &json["luminaires_without_power"]),
            (&30.0.into(), &1.into())
        );
        let ran = home.run(&[command, "room.toml"]);
        let line = ran.out.lines().find(|line| line.trim_start().starts_with("power "));
        assert!(line.is_some_and(|line| line.contains("not known: 30")), "{}", ran.out);
    }
}

#[test]
fn grids_tell_it_for_100_lx_and_maps_keep_it() {
    let home = Home::new();
    let grid = "[[grid]]\nname = \"desk\"\ncorner = [1, 1, 0.75]\nu = [4, 0, 0]\nv = [0, 3, 0]\nspacing = 1\n";
    home.file("room.toml", BOX.to_owned() + &lamp("[3, 2.5, 2.8]", "power_w = 60") + grid);
    let solve = ["solve", "room.toml", "-o", "map.glb", "--quality", "draft"];
    assert_eq!(home.run(&solve).code, 0);
    let json = home.run(&["grid", "map.glb", "--json"]).json();
    let [grid, w_m2] = [&json["grids"][0], &json["power_density_w_m2"]];
    let mean = |end: &str| grid["mean_lx"][end].as_f64().unwrap();
    let per = |end: &str| grid["power_density_w_m2_per_100_lx"][end].as_f64().unwrap();
    let w_m2 = w_m2.as_f64().unwrap();
    assert!((w_m2 - 2.0).abs() < 1e-4, "{json}");
    assert!((per("value") - 100.0 * w_m2 / mean("value")).abs() < 1e-9, "{json}");
    assert!((per("low") - 100.0 * w_m2 / mean("high")).abs() < 1e-9, "{json}");
    let text = home.run(&["grid", "map.glb"]).out;
    assert!(
        text.contains("W/m2 of 30.0 m2 floor") && text.contains("for 100 lx on desk"),
        "{text}"
    );
    // Not of light that comes from all sides.
    let all_round = home.run(&["grid", "map.glb", "--json", "--quantity", "cylindrical"]).json();
    assert!(all_round["grids"][0]["power_density_w_m2_per_100_lx"].is_null());
}
