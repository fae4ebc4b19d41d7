//! Scenes at the edge of what a scene can be: each has the right light, or the right message. What is right is told by complete
//! paths, which know neither elements nor a map.

mod table;

use crate::ran::{Home, Ran};
use table::{Case, Due, cases, room};

/// Paths at each point.
const PATHS: &str = "4096";
/// Standard deviations that readings of map and paths may differ by: of forty differences one is larger in 400 tables.
const DEVIATIONS: f64 = 4.0;
/// The largest standard error of a reading that tells anything, as a share of it.
const TELLING: f64 = 0.1;
/// The share by which direct light, in single precision from an origin in the scene, may miss its formula.
const ROUNDING: f64 = 1e-6;

/// Illuminance and standard error, where they are known, lx.
type Reading = (Option<f64>, Option<f64>);

impl Case {
    fn home(&self) -> Home {
        let home = Home::new();
        home.file("scene.toml", &self.scene);
        home.file("room.obj", &self.obj);
        home
    }
}

fn solve(home: &Home) -> Ran {
    home.run(&["solve", "scene.toml", "-o", "map.glb", "--accuracy", "3%", "--seed", "1"])
}

fn readings(home: &Home, case: &Case, source: &[&str]) -> Vec<Reading> {
    let words = [&["probe"], source, &["--points", "-", "--json"]].concat();
    let ran = home.run_with_input(&words, &case.points);
    assert_eq!(ran.code, 0, "{}: {ran:?}", case.name);
    let value = |point: &serde_json::Value, key: &str| point[key].as_f64();
    let points = ran.json()["points"].as_array().unwrap().clone();
    points.iter().map(|p| (value(p, "illuminance_lx"), value(p, "standard_error_lx"))).collect()
}

fn of_map(home: &Home, case: &Case) -> Vec<Reading> {
    readings(home, case, &["map.glb"])
}

fn of_paths(home: &Home, case: &Case) -> Vec<Reading> {
    readings(home, case, &["scene.toml", "--paths", PATHS])
}

#[track_caller]
fn agree(name: &str, map: &[Reading], paths: &[Reading]) {
    for (map, paths) in map.iter().zip(paths) {
        let ((Some(map_lx), Some(map_error)), (Some(paths_lx), Some(paths_error))) = (*map, *paths)
        else {
            panic!("{name}: not known: {map:?} {paths:?}");
        };
        let error_lx = map_error.hypot(paths_error);
        assert!((map_lx - paths_lx).abs() <= DEVIATIONS * error_lx, "{name}: {map:?} {paths:?}");
        assert!(error_lx <= TELLING * paths_lx, "{name}: tells nothing: {map:?} {paths:?}");
    }
}

fn check(case: &Case, of_room: &[Reading]) {
    let (name, home) = (case.name, case.home());
    let ran = solve(&home);
    let code = match case.due {
        Due::Refused(_) => 2,
        Due::WithoutError(_) => 3,
        _ => 0,
    };
    assert_eq!(ran.code, code, "{name}: {ran:?}");
    if let Due::Refused(words) | Due::WithoutError(words) | Due::Told(words) = case.due {
        assert!(ran.err.contains(words), "{name}: {ran:?}");
    }
    if code == 2 {
        assert!(!home.path("map.glb").exists(), "{name}");
        return;
    }
    let map = of_map(&home, case);
    match case.due {
        Due::AsPaths => agree(name, &map, &of_paths(&home, case)),
        Due::AsTheRoom => assert_eq!(map, of_room, "{name}"),
        Due::Exactly(due_lx) => {
            for ((lx, _), due) in map.iter().zip(due_lx) {
                assert!(lx.is_some_and(|lx| (lx / due - 1.0).abs() < ROUNDING), "{name}: {map:?}");
            }
        }
        Due::Dark => {
            let dark = (Some(0.0), Some(0.0));
            assert!(
                map.iter().chain(&of_paths(&home, case)).all(|r| *r == dark),
                "{name}: {map:?}"
            );
        }
        Due::Told(_) => assert!(map.iter().all(|r| r.0.is_none()), "{name}: {map:?}"),
        Due::WithoutError(_) => assert!(map.iter().all(|r| r.1.is_none()), "{name}: {map:?}"),
        Due::Refused(_) => {}
    }
}

#[test]
fn scenes_at_the_edge_are_right_or_told() {
    let room = room();
    let home = room.home();
    assert_eq!(solve(&home).code, 0);
    let of_room = of_map(&home, &room);
    agree(room.name, &of_room, &of_paths(&home, &room));
    cases().iter().for_each(|case| check(case, &of_room));
}

/// Two rooms, one of them askew, with a lamp of a million candela each, inside of a large box: no vertex of the box gets light.
#[test]
fn no_light_comes_out_of_watertight_rooms() {
    let askew = "[[geometry]]\nmaterial = 'm'\nbox = { min = [-1, -1, -1], max = [1, 1, 1], inward = true }\n\
                 transform = { rotate_deg = [11, 23, 37], translate = [8, 1, 1] }\n\
                 [[luminaire]]\nposition = [8.2, 1.1, 1.3]\nisotropic = { intensity_cd = 1e6 }\n";
    let plain = "[[luminaire]]\nposition = [0.05, 0.05, 2.4]\nisotropic = { intensity_cd = 1e6 }\n";
    let around = "[[geometry]]\nmaterial = 'm'\nbox = { min = [-5, -5, -5], max = [15, 10, 10], inward = true }\n";
    let home = Home::new();
    home.file("scene.toml", format!("{}{askew}{plain}{around}", table::ROOM));
    let ran = home.run(&["solve", "scene.toml", "-o", "map.glb", "--accuracy", "20%"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert_eq!(home.run(&["export", "map.glb", "-o", "map.csv"]).code, 0);
    let text = std::fs::read_to_string(home.path("map.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|known| *known == name).unwrap();
    let place = ["x", "y", "z"].map(column);
    let illuminance = column("illuminance_lx");
    let (mut outside, mut inside) = (0, 0);
    for line in lines {
        let values: Vec<&str> = line.split(',').collect();
        let on = |axis: usize, at: [f64; 2]| at.contains(&values[place[axis]].parse().unwrap());
        if on(0, [-5.0, 15.0]) || on(1, [-5.0, 10.0]) || on(2, [-5.0, 10.0]) {
            outside += 1;
            // Nothing, or not known.
            assert!(matches!(values[illuminance], "0" | ""), "{line}");
        } else {
            inside += usize::from(values[illuminance].parse().is_ok_and(|lx: f64| lx > 0.0));
        }
    }
    // The corners of the box on each of its faces, and of the rooms.
    assert!(outside >= 24 && inside >= 48, "{outside} {inside}");
}
