//! Cylindrical, semi-cylindrical and hemispherical illuminance, and modelling, on grids.

use crate::ran::Home;
use serde_json::Value;
use std::f64::consts::PI;

/// Walls that reflect nothing, and a lamp of 1000 cd at 2 m over a desk.
const ROOM: &str = "name = \"black\"\n[materials.black]\ndiffuse = 0\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 4, 3], inward = true }\nmaterial = \"black\"\n\
    [[luminaire]]\nposition = [2, 2, 2.75]\nisotropic = { intensity_cd = 1000 }\n\
    [[grid]]\nname = \"seats\"\ncorner = [0.5, 0.5, 0.75]\nu = [2, 0, 0]\nv = [0, 1, 0]\n\
    spacing = 0.5\nmaintenance_factor = 0.8\n";

/// The same with y up: (x, y, z) is (x, z, -y).
const ROOM_Y: &str = "name = \"black\"\nup = \"y\"\n[materials.black]\ndiffuse = 0\n\
    [[geometry]]\nbox = { min = [0, 0, -4], max = [4, 3, 0], inward = true }\nmaterial = \"black\"\n\
    [[luminaire]]\nposition = [2, 2.75, -2]\nisotropic = { intensity_cd = 1000 }\n\
    [[grid]]\nname = \"seats\"\ncorner = [0.5, 0.75, -0.5]\nu = [2, 0, 0]\nv = [0, 0, -1]\n\
    spacing = 0.5\nmaintenance_factor = 0.8\n";

fn solved(room: &str) -> Home {
    let home = Home::new();
    home.file("room.toml", room);
    let ran = home.run(&["solve", "room.toml", "-o", "map.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home
}

fn read(home: &Home, more: &[&str]) -> Value {
    let ran = home.run(&[&["grid", "map.glb", "--json", "--quantity"], more].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    ran.json()["grids"][0].clone()
}

/// From a point on the grid to the lamp: the level parts along x and to the left of it, the height, and the distance.
fn way(value: &Value, is_y_up: bool) -> ([f64; 3], f64) {
    let at = |k: usize| value["position"][k].as_f64().unwrap();
    let [x, left, height] = if is_y_up { [at(0), -at(2), at(1)] } else { [at(0), at(1), at(2)] };
    let way = [2.0 - x, 2.0 - left, 2.75 - height];
    (way, way.iter().map(|c| c * c).sum::<f64>().sqrt())
}

#[test]
fn a_lamp_gives_every_quantity_by_hand() {
    for (room, is_y_up) in [(ROOM, false), (ROOM_Y, true)] {
        let home = solved(room);
        type ByHand = fn([f64; 3], f64) -> f64;
        let cases: [(&[&str], ByHand); 4] = [
            (&["cylindrical"], |[x, y, _], r| x.hypot(y) / r / PI),
            (&["semi-cylindrical", "--facing", "0deg"], |[x, y, _], r| (x.hypot(y) + x) / r / PI),
            (&["semi-cylindrical", "--facing", "-90"], |[x, y, _], r| (x.hypot(y) - y) / r / PI),
            (&["hemispherical"], |[_, _, z], r| 0.25 * (1.0 + z / r)),
        ];
        for (quantity, by_hand) in cases {
            let grid = read(&home, quantity);
            assert_eq!(grid["quantity"], quantity[0], "{grid}");
            let values = grid["values"].as_array().unwrap();
            assert_eq!(values.len(), 8);
            let mut sum = 0.0;
            for value in values {
                let (way, r) = way(value, is_y_up);
                let lx = 0.8 * 1000.0 / (r * r) * by_hand(way, r);
                let found = value["illuminance_lx"].as_f64().unwrap();
                assert!((found - lx).abs() < 1e-6 * lx + 1e-6, "{quantity:?}: {found} for {lx}");
                sum += lx;
            }
            let mean = grid["mean_lx"]["value"].as_f64().unwrap();
            assert!((mean / (sum / 8.0) - 1.0).abs() < 1e-6, "{mean}");
        }
        let grid = read(&home, &["modelling"]);
        let ratios = grid["modelling"]["values"].as_array().unwrap();
        for (value, ratio) in grid["values"].as_array().unwrap().iter().zip(ratios) {
            let ([x, y, z], _) = way(value, is_y_up);
            // sin / pi over cos.
            let expected = x.hypot(y) / z / PI;
            let found = ratio["modelling"].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
        }
        assert!(grid["modelling"]["mean"]["low"].is_f64(), "{grid}");
    }
}

#[test]
fn text_tables_and_pictures_say_what_is_read() {
    let home = solved(ROOM);
    let ran = home.run(&["grid", "map.glb", "--quantity", "modelling", "--csv", "points.csv"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.out.starts_with("Cylindrical illuminance\n"), "{}", ran.out);
    assert!(ran.out.contains("seats: modelling Ez/Eh "), "{}", ran.out);
    let csv = String::from_utf8(std::fs::read(home.path("points.csv")).unwrap()).unwrap();
    let [header, first] =
        [0, 1].map(|k| csv.lines().nth(k).unwrap().split(',').collect::<Vec<_>>());
    assert_eq!(header.len(), first.len(), "{csv}");
    let column = |name: &str| first[header.iter().position(|of| *of == name).unwrap()];
    assert_eq!(column("quantity"), "modelling");
    let number = |name: &str| column(name).parse::<f64>().unwrap();
    let ratio = number("illuminance_lx") / number("horizontal_lx");
    // Exact numbers have nine digits or so.
    assert!((number("modelling") / ratio - 1.0).abs() < 1e-4, "{csv}");
    for (quantity, told) in
        [("modelling", "Modelling Ez/Eh"), ("cylindrical", "Cylindrical illuminance")]
    {
        let ran = home.run(&["grid", "map.glb", "--quantity", quantity, "-o", "plan.svg"]);
        assert_eq!(ran.code, 0, "{ran:?}");
        let svg = String::from_utf8(std::fs::read(home.path("plan.svg")).unwrap()).unwrap();
        assert!(svg.contains(told), "{quantity}");
    }
    let judged = ["grid", "map.glb", "--quantity", "cylindrical", "--require", "Em >= 1"];
    assert_eq!(home.run(&judged).code, 0);
    let judged = ["grid", "map.glb", "--quantity", "cylindrical", "--require", "Em >= 1000"];
    assert_eq!(home.run(&judged).code, 1);
}

#[test]
fn quantities_that_make_no_sense_are_refused() {
    let home = solved(ROOM);
    for (more, told) in [
        (&["semi-cylindrical"][..], "add --facing DEG"),
        (&["cylindrical", "--facing", "10"], "leave it out"),
        (&["semi-cylindrical", "--facing", "south"], "is no angle"),
        (&["cylindrical", "--require", "EN 12464-1 34.2"], "of the illuminance of the task area"),
        (&["spherical"], "cylindrical"),
    ] {
        let ran = home.run(&[&["grid", "map.glb", "--quantity"], more].concat());
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains(told), "{more:?}: {}", ran.err);
    }
}

/// In a room that is lit from below and above alike, cylinders get what planes do. Nearly all of the light is direct, which planes
/// have exactly.
#[test]
fn a_furnace_has_a_modelling_of_1() {
    let home = Home::new();
    let room = "[materials.wall]\ndiffuse = 0.02\nluminance_cd_m2 = 98\n\
        [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 3, 3], inward = true }\nmaterial = \"wall\"\n\
        [[grid]]\nname = \"seats\"\ncorner = [1, 1, 1.2]\nu = [2, 0, 0]\nv = [0, 1, 0]\nspacing = 0.5\n";
    home.file("room.toml", room);
    let arguments = ["grid", "room.toml", "--accuracy", "3%", "--quantity", "modelling", "--json"];
    let ran = home.run(&arguments);
    assert_eq!(ran.code, 0, "{ran:?}");
    let grid = ran.json()["grids"][0].clone();
    let end = |of: &Value, name: &str| of[name].as_f64().unwrap();
    let of_grid = |name: &str| grid["modelling"][name].clone();
    assert!(end(&of_grid("mean"), "low") < 1.0 && end(&of_grid("mean"), "high") > 1.0, "{grid}");
    assert!(end(&of_grid("greatest"), "value") < 1.1 && end(&of_grid("least"), "value") > 0.9);
    let mean_lx = &grid["mean_lx"];
    let lx = 100.0 * PI;
    assert!(end(mean_lx, "low") < lx && end(mean_lx, "high") > lx, "{mean_lx}");
    assert!(end(mean_lx, "high") < 1.15 * lx, "{mean_lx}");
}
