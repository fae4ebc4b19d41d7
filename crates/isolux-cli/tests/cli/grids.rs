//! Calculation grids.

use crate::ran::Home;

/// A room whose walls reflect nothing, a lamp of 1000 cd at 2 m over a desk, and a solid box.
const ROOM: &str = "name = \"black\"\n[materials.black]\ndiffuse = 0\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 4, 3], inward = true }\nmaterial = \"black\"\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [1, 1, 1.5] }\nmaterial = \"black\"\n\
    [[luminaire]]\nposition = [2, 2, 2.75]\nisotropic = { intensity_cd = 1000 }\n\
    [[grid]]\nname = \"desk\"\ncorner = [1.5, 1.5, 0.75]\nu = [1, 0, 0]\nv = [0, 1, 0]\n\
    spacing = 0.5\nmaintenance_factor = 0.8\n";

fn solved() -> Home {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let ran = home.run(&["solve", "room.toml", "-o", "map.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home
}

#[test]
fn grids_of_the_scene_are_computed_by_hand() {
    let home = solved();
    let ran = home.run(&["grid", "map.glb", "--json", "--csv", "desk.csv"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    let desk = &json["grids"][0];
    assert_eq!((desk["name"].as_str(), desk["known"].as_u64()), (Some("desk"), Some(4)), "{desk}");
    // Four points a quarter of a metre off in both: h / d^3, and no light but this.
    let squared = 4.0 + 2.0 * 0.25 * 0.25;
    let lx = 0.8 * 1000.0 * 2.0 / (squared * f64::sqrt(squared));
    for figure in ["mean_lx", "least_lx", "greatest_lx"] {
        let found = desk[figure]["value"].as_f64().unwrap();
        assert!((found / lx - 1.0).abs() < 1e-6, "{figure}: {found} for {lx}");
    }
    assert!((desk["uniformity"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-6, "{desk}");
    assert_eq!(desk["values"].as_array().map(Vec::len), Some(4));
    let csv = String::from_utf8(std::fs::read(home.path("desk.csv")).unwrap()).unwrap();
    assert_eq!(csv.lines().count(), 5, "{csv}");
    assert!(csv.lines().nth(1).unwrap().starts_with("\"desk\",0,0,1.75,1.75,0.75,"), "{csv}");
}

#[test]
fn a_working_plane_covers_the_floor_and_leaves_solids_out() {
    let home = solved();
    let arguments = ["grid", "map.glb", "--height", "0.75", "--json", "--picture", "plane.png"];
    let ran = home.run(&arguments);
    assert_eq!(ran.code, 0, "{ran:?}");
    let plane = &ran.json()["grids"][0];
    // Half a metre of border: 3 m, 0.2 * 5^log10(3) = 0.43 m, seven points a side.
    assert_eq!(plane["counts"], serde_json::json!([7, 7]), "{plane}");
    // One point, at (0.71, 0.71), lies within the box.
    assert_eq!(plane["known"], 48, "{plane}");
    assert!(ran.err.contains("1 of 49 points"), "{}", ran.err);
    let greatest = plane["greatest_lx"]["value"].as_f64().unwrap();
    assert!((greatest / 250.0 - 1.0).abs() < 1e-6, "below the lamp 1000 / 2^2: {greatest}");
    assert!(std::fs::read(home.path("plane.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn a_maintenance_factor_of_1_is_all_of_the_light() {
    let home = solved();
    let mean_lx = |factor: &str| {
        let ran = home.run(&["grid", "map.glb", "--maintenance-factor", factor, "--json"]);
        assert_eq!(ran.code, 0, "{ran:?}");
        ran.json()["grids"][0]["mean_lx"]["value"].as_f64().unwrap()
    };
    let all_lx = mean_lx("1");
    assert_eq!(mean_lx("100%"), all_lx);
    for factor in ["0.8", "80%"] {
        // Two orders of the same products.
        assert!((mean_lx(factor) / (0.8 * all_lx) - 1.0).abs() < 1e-12, "{factor}");
    }
}

/// The same room, with the factor in the luminaire and not on the grid.
fn maintained_room() -> String {
    let of_luminaire = "isotropic = { intensity_cd = 1000 }\nmaintenance_factor = 0.8\n";
    let room = ROOM.replace("spacing = 0.5\nmaintenance_factor = 0.8\n", "spacing = 0.5\n");
    room.replace("isotropic = { intensity_cd = 1000 }\n", of_luminaire)
}

#[test]
fn a_maintenance_factor_counts_once() {
    let by_grid = solved();
    let by_luminaire = Home::new();
    by_luminaire.file("room.toml", maintained_room());
    let solve = ["solve", "room.toml", "-o", "map.glb", "--quality", "draft"];
    let told = by_luminaire.run(&solve);
    // Long values go on in the next line.
    let words: Vec<&str> = told.out.split_whitespace().collect();
    let words = words.join(" ");
    let is_told = words.contains("maintained: luminaires have a maintenance factor of 0.80");
    assert!(is_told, "{told:?}");
    let desk = |home: &Home| home.run(&["grid", "map.glb", "--json"]).json()["grids"][0].clone();
    let [one, other] = [&by_grid, &by_luminaire].map(desk);
    let [a, b] = [&one, &other].map(|desk| desk["mean_lx"]["value"].as_f64().unwrap());
    assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    assert_eq!(
        (&one["maintenance"], &other["maintenance"]),
        (&"maintained".into(), &"maintained".into())
    );
    assert_eq!(other["luminaire_maintenance"]["greatest"], 0.8);
    let initial = by_grid.run(&["grid", "map.glb", "--maintenance-factor", "1"]).out;
    let of_values = initial.lines().find(|line| line.trim_start().starts_with("values"));
    assert!(of_values.is_some_and(|line| line.ends_with("initial")), "{initial}");
    // Another factor on top is refused; 1 is none.
    let twice = by_luminaire.run(&["grid", "map.glb", "--maintenance-factor", "0.9"]);
    assert!(twice.code == 2 && twice.err.contains("counts once"), "{twice:?}");
    assert_eq!(by_luminaire.run(&["grid", "map.glb", "--maintenance-factor", "1"]).code, 0);
    by_luminaire.file("both.toml", maintained_room() + "maintenance_factor = 0.8\n");
    let both = by_luminaire.run(&["check", "both.toml"]);
    assert!(both.code == 2 && both.err.contains("grid `desk`"), "{both:?}");
    let points = ["probe", "map.glb", "--points", "-", "--json"];
    let probed = by_luminaire.run_with_input(&points, "2 2 0 0 0 1\n").json();
    assert_eq!(probed["maintenance"], "maintained");
    for arguments in [["info", "map.glb", "--json"], ["info", "room.toml", "--json"]] {
        assert_eq!(by_luminaire.run(&arguments).json()["maintenance"], "maintained");
    }
}

#[test]
fn bad_grids_are_refused_before_anything_is_computed() {
    let home = solved();
    home.file("bare.toml", &ROOM[..ROOM.find("[[grid]]").unwrap()]);
    for (arguments, told) in [
        (&["grid", "map.glb", "--name", "table"][..], "no grid `table`"),
        (&["grid", "bare.toml"], "has no calculation grids"),
        (&["grid", "map.glb", "--height", "1", "--border", "2"], "leaves nothing"),
        (&["grid", "map.glb", "--accuracy", "1%"], "is a map"),
        (&["grid", "map.glb", "--csv", "no/such/x.csv"], "no/such"),
        (&["grid", "map.glb", "--height", "high"], "is no length"),
        (&["grid", "map.glb", "--corner", "0,0,0", "--u", "1,0,0", "--v", "1,1,0"], "right angles"),
    ] {
        let ran = home.run(arguments);
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains(told), "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn a_height_outside_of_the_scene_is_refused_and_a_grid_without_light_is_told() {
    let home = solved();
    let ran = home.run(&["grid", "map.glb", "--height", "99"]);
    assert_eq!(ran.code, 2, "{ran:?}");
    assert!(ran.err.contains("--height 99") && ran.err.contains("from 0 to 3.00 m"), "{}", ran.err);
    let far = ["grid", "map.glb", "--corner", "10,10,5", "--u", "1,0,0", "--v", "0,1,0"];
    let ran = home.run(&far);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.err.contains("no light reaches any of its points"), "{}", ran.err);
}

#[test]
fn points_outside_of_the_walls_are_told() {
    let home = solved();
    // Four of eight points lie behind the wall at x = 4 m.
    let half = [
        "grid",
        "map.glb",
        "--corner",
        "2,1.5,0.75",
        "--u",
        "4,0,0",
        "--v",
        "0,2,0",
        "--spacing",
        "1",
    ];
    let ran = home.run(&half);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(
        ran.err.contains("4 of 8 points get no light and see nothing that is lit"),
        "{}",
        ran.err
    );
    assert!(ran.err.contains("all beyond the bounds of the scene"), "{}", ran.err);
    // They do not count in the figures.
    let mut with_json = half.to_vec();
    with_json.push("--json");
    let grid = home.run(&with_json).json()["grids"][0].clone();
    let lx = |value: &serde_json::Value| value["illuminance_lx"].as_f64();
    let values: Vec<Option<f64>> = grid["values"].as_array().unwrap().iter().map(lx).collect();
    assert_eq!(values.iter().flatten().count(), 4, "{values:?}");
    assert!(values.iter().flatten().all(|&lx| lx > 0.0), "{values:?}");
    // In the shadow of the box there is no light either, but what is lit is seen from there.
    let shadow =
        ["grid", "map.glb", "--corner", "0.1,1.05,0.1", "--u", "0.8,0,0", "--v", "0,0.1,0"];
    let ran = home.run(&shadow);
    assert!(ran.code == 0 && !ran.err.contains("see nothing"), "{}", ran.err);
}
