//! Glare of observers, against ratings by hand.

use crate::ran::Home;
use serde_json::Value;

/// A panel of 0.2 x 0.2 m and 10,000 cd/m2 in the ceiling of a room, above the line of sight.
const ROOM: &str = "name = \"room\"\n[materials.paint]\ndiffuse = 0.5\n\
    [materials.panel]\nluminance_cd_m2 = 10000\nsided = \"one\"\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 6, 3], inward = true }\nmaterial = \"paint\"\n\
    [[geometry]]\nname = \"panel\"\n\
    polygon = [[1.9, 4.9, 2.99], [1.9, 5.1, 2.99], [2.1, 5.1, 2.99], [2.1, 4.9, 2.99]]\nmaterial = \"panel\"\n\
    [[camera]]\nname = \"ahead\"\nposition = [2, 1, 1.2]\ntarget = [2, 5, 1.2]\n\
    [[camera]]\nname = \"away\"\nposition = [2, 3, 1.2]\ntarget = [2, 0, 1.2]\n";

/// A floor plan of eyes in that room.
const GRID: &str = "[[grid]]\nname = \"floor\"\ncorner = [0.5, 0.5, 0.75]\nu = [3, 0, 0]\nv = [0, 4, 0]\nspacing = 1\n";

fn rated(home: &Home, more: &[&str]) -> Vec<Value> {
    let ran = home.run(&[&["glare", "map.glb", "--json"], more].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    json["observers"].as_array().unwrap().clone()
}

/// What is required of glare on a grid is judged by its worst view, and refused where luminaires have no luminance.
#[test]
fn glare_may_be_required() {
    let home = Home::new();
    let grid = "[[grid]]\nname = \"seats\"\ncorner = [1, 1, 0.75]\nu = [2, 0, 0]\nv = [0, 3, 0]\n";
    home.file("room.toml", format!("{ROOM}{grid}"));
    let solved = home.run(&["solve", "room.toml", "-o", "map.glb", "--accuracy", "2%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    let ran = home.run(&["glare", "map.glb", "--grid", "seats", "--json"]);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let worst = json["grids"][0]["worst"]["ugr"].clone();
    let ran = home.run(&["grid", "map.glb", "--require", "UGR <= 60, UGR <= 5", "--json"]);
    assert_eq!(ran.code, 1, "{ran:?}");
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let judged = json["requirements"].as_array().unwrap();
    assert_eq!(judged[0]["value"], worst["value"]);
    assert_eq!([&judged[0]["verdict"], &judged[1]["verdict"]], ["met", "not_met"]);
    let point = "[[luminaire]]\nposition = [2, 3, 2]\nisotropic = { flux_lm = 1000 }\n";
    home.file("points.toml", format!("{ROOM}{grid}{point}"));
    let ran = home.run(&["grid", "points.toml", "--accuracy", "10%", "--require", "UGR <= 19"]);
    assert_eq!(ran.code, 2, "{ran:?}");
    assert!(ran.err.contains("no luminous area"), "{}", ran.err);
}

#[test]
fn a_rating_is_that_by_hand() {
    let home = Home::new();
    home.file("room.toml", ROOM);
    let solved = home.run(&["solve", "room.toml", "-o", "map.glb", "--accuracy", "2%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    let found = rated(&home, &[]);
    let [ahead, away] = &found[..] else { panic!("{found:?}") };
    // 4 m ahead and 1.79 m up, straight above the line of sight.
    let way = (4.0_f64 * 4.0 + 1.79 * 1.79).sqrt();
    let steradians = 0.04 * (1.79 / way) / (way * way);
    let sigma = (1.79_f64 / 4.0).atan().to_degrees();
    let index = (33.98e-3 * sigma + 21e-5 * sigma * sigma).exp();
    let background = ahead["background_cd_m2"].as_f64().unwrap();
    let by_hand = 8.0 * (0.25 / background * 1e8 * steradians / (index * index)).log10();
    let ugr = |end: &str| ahead["ugr"][end].as_f64().unwrap();
    assert!((ugr("value") - by_hand).abs() < 0.05, "{} {by_hand}", ugr("value"));
    assert!(ugr("low") < ugr("value") && ugr("value") < ugr("high"), "{ahead}");
    assert!(ugr("high") - ugr("low") < 1.0, "{ahead}");
    assert!(away["ugr"].is_null(), "what is behind does not glare: {away}");
    let eye = rated(&home, &["--eye", "2,1,1.2", "--target", "2,5,1.2"]);
    assert_eq!(eye[0]["ugr"], ahead["ugr"]);
    let text = home.run(&["glare", "map.glb"]).out;
    assert!(text.contains("ahead") && text.contains("UGR"), "{text}");
    for (more, part) in [
        (["--eye", "2,1,1.2"].as_slice(), "--target"),
        (&["--eye", "2,1,1.2", "--target", "2,1,3"], "look ahead"),
        (&["--camera", "none"], "choose one"),
    ] {
        let ran = home.run(&[&["glare", "map.glb"], more].concat());
        assert_eq!(ran.code, 2, "{more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
}

#[test]
fn grids_are_rated_at_their_worst() {
    let home = Home::new();
    home.file("room.toml", format!("{ROOM}{GRID}"));
    let solved = home.run(&["solve", "room.toml", "-o", "map.glb", "--accuracy", "2%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    let ran = home.run(&["glare", "map.glb", "--grid", "floor", "--csv", "views.csv", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let floor = &ran.json()["grids"][0];
    let csv = std::fs::read_to_string(home.path("views.csv")).unwrap();
    // 3 x 4 points, four ways to look, and the header.
    assert_eq!(floor["points"], 12);
    assert_eq!(csv.lines().count(), 49);
    let worst = &floor["worst"];
    let [eye, way] = ["position", "direction"].map(|key| {
        worst[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<f64>>()
    });
    assert_eq!(eye[2], 1.2, "eyes are above the floor, not above the grid: {worst}");
    // The panel hangs at y = 5: whoever looks along +y sees it.
    assert_eq!(way, [0.0, 1.0, 0.0], "{worst}");
    let ugr = worst["ugr"]["value"].as_f64().unwrap();
    let values = csv.lines().skip(1).filter_map(|line| line.split(',').nth(7)?.parse::<f64>().ok());
    let greatest = values.fold(0.0, f64::max);
    assert!((greatest - ugr).abs() < 1e-3, "{greatest} {ugr}");
    // One observer is rated as by itself.
    let target = format!("{},{},1.2", eye[0], eye[1] + 1.0);
    let one = rated(&home, &["--eye", &format!("{},{},1.2", eye[0], eye[1]), "--target", &target]);
    let same = one[0]["ugr"]["value"].as_f64().unwrap();
    assert!((same - ugr).abs() < 1e-9, "{same} {ugr}");
    // All points keep a limit above the worst, and the one at the worst does not keep one below.
    let share = |limit: f64| {
        let limit = limit.to_string();
        let json =
            home.run(&["glare", "map.glb", "--all-grids", "--limit", &limit, "--json"]).json();
        let share = &json["grids"][0]["share_within_limit"];
        [share["low"].as_f64().unwrap(), share["high"].as_f64().unwrap()]
    };
    assert_eq!(share(ugr + 3.0), [1.0, 1.0]);
    assert!(share(ugr - 3.0)[1] < 1.0);
    let text = home.run(&["glare", "map.glb", "--grid", "floor", "--direction", "0,-2,0"]).out;
    assert!(text.contains("floor") && text.contains("UGR <= 19"), "{text}");
    for (more, part) in [
        (["--grid", "none"].as_slice(), "choose one of floor"),
        (&["--grid", "floor", "--direction", "0,0,1"], "look ahead"),
        (&["--direction", "1,0,0"], "--grid"),
        (&["--grid", "floor", "--camera", "ahead"], "cannot be used"),
        (&["--grid", "floor", "--limit", "200"], "from 5 to 40"),
        (&["--grid", "floor", "--csv", "views.txt"], ".csv"),
    ] {
        let ran = home.run(&[&["glare", "map.glb"], more].concat());
        assert_eq!(ran.code, 2, "{more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
}

/// A dark room, 4 x 6 x 3 m, with an opening of 2 x 1 m in the far wall, above the eye, to a sky of 5000 cd/m2.
fn room_with_an_opening() -> String {
    let walls = [
        "[[0,0,0],[4,0,0],[4,6,0],[0,6,0]]",
        "[[0,0,3],[0,6,3],[4,6,3],[4,0,3]]",
        "[[0,0,0],[0,6,0],[0,6,3],[0,0,3]]",
        "[[4,0,0],[4,0,3],[4,6,3],[4,6,0]]",
        "[[0,0,0],[0,0,3],[4,0,3],[4,0,0]]",
        "[[0,6,0],[4,6,0],[4,6,1.4],[0,6,1.4]]",
        "[[0,6,2.4],[4,6,2.4],[4,6,3],[0,6,3]]",
        "[[0,6,1.4],[1,6,1.4],[1,6,2.4],[0,6,2.4]]",
        "[[3,6,1.4],[4,6,1.4],[4,6,2.4],[3,6,2.4]]",
    ];
    let walls: String = walls
        .iter()
        .map(|polygon| format!("[[geometry]]\npolygon = {polygon}\nmaterial = \"paint\"\n"))
        .collect();
    format!(
        "name = \"room\"\n[sky]\ntype = \"uniform\"\nhorizontal_lx = {}\n[materials.paint]\ndiffuse = 0.2\n{walls}\
         [[camera]]\nname = \"out\"\nposition = [2, 2, 1.2]\ntarget = [2, 6, 1.2]\n\
         [[camera]]\nname = \"in\"\nposition = [2, 2, 1.2]\ntarget = [2, 0, 1.2]\n",
        5000.0 * std::f64::consts::PI
    )
}

#[test]
#[ignore = "slow: cargo xtask test --all"]
fn a_probability_is_that_by_hand() {
    let home = Home::new();
    home.file("room.toml", room_with_an_opening());
    let solved = home.run(&["solve", "room.toml", "-o", "map.glb", "--accuracy", "5%"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    let found = rated(&home, &["--metric", "dgp"]);
    let [out, back] = &found[..] else { panic!("{found:?}") };
    let number = |of: &Value| of.as_f64().unwrap();
    let [source] = &out["sources"].as_array().unwrap()[..] else { panic!("{out}") };
    // 4 m away, from 0.2 to 1.2 m above the eye: atan(a b / (d sqrt(a^2 + b^2 + d^2))) of each corner.
    let corner = |a: f64, b: f64| (a * b / (4.0 * (a * a + b * b + 16.0_f64).sqrt())).atan();
    let steradians = 2.0 * (corner(1.0, 1.2) - corner(1.0, 0.2));
    let sigma = (0.7_f64 / 4.0).atan().to_degrees();
    let index = (33.98e-3 * sigma + 21e-5 * sigma * sigma).exp();
    // The sky is even; its border is found to an eighth of a pixel of 0.6 degrees; its middle is a little below 0.7 m.
    assert!((number(&source["luminance_cd_m2"]) / 5000.0 - 1.0).abs() < 0.01, "{source}");
    assert!(
        (number(&source["solid_angle_sr"]) / steradians - 1.0).abs() < 0.02,
        "{source} {steradians}"
    );
    assert!((number(&source["position_index"]) / index - 1.0).abs() < 0.02, "{source} {index}");
    let lx = number(&out["illuminance_at_eye_lx"]["value"]);
    let glare = 25e6 * steradians / (index * index) / lx.powf(1.87);
    let dim = (0.024 * lx - 4.0).exp();
    let by_hand = (5.87e-5 * lx + 0.0918 * (1.0 + glare).log10() + 0.16) * dim / (1.0 + dim);
    let dgp = |end: &str| number(&out["dgp"][end]);
    assert!((dgp("value") - by_hand).abs() < 0.002, "{out} {by_hand}");
    assert!(dgp("low") <= dgp("value") && dgp("value") <= dgp("high"), "{out}");
    assert!(dgp("high") - dgp("low") < 0.02, "{out}");
    assert_eq!(out["class"], "imperceptible", "{out}");
    assert_eq!(back["sources"], serde_json::json!([]), "{back}");
    assert!(number(&back["dgp"]["value"]) < dgp("value"), "{back}");
    // Twenty times the mean is more than the sky has, or less.
    let mean = number(&out["mean_luminance_cd_m2"]);
    let by_mean = rated(&home, &["--metric", "dgp", "--camera", "out", "--threshold", "20x"]);
    assert_eq!(by_mean[0]["sources"].as_array().unwrap().len(), usize::from(20.0 * mean < 5000.0));
    let text = home.run(&["glare", "map.glb", "--metric", "dgp", "--camera", "in"]).out;
    assert!(text.contains("DGP") && text.contains("imperceptible"), "{text}");
    for (more, part) in [
        (["--threshold", "5"].as_slice(), "5x is five times"),
        (&["--threshold", "2000"], "--metric dgp"),
        (&["--all-grids"], "one view at a time"),
    ] {
        let metric = if more[1..] == ["2000"] { "ugr" } else { "dgp" };
        let ran = home.run(&[&["glare", "map.glb", "--metric", metric], more].concat());
        assert_eq!(ran.code, 2, "{more:?}: {ran:?}");
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
}
