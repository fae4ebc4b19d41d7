//! Plans of calculation grids, read as SVG.

use crate::ran::Home;

/// Two rooms beside each other in one box, 6 m by 4 m: a wall of solid stone at x = 4 m, a lamp in the left room, a luminous panel beside it, a
/// cupboard under a grid that fills both rooms, and a desk.
const ROOMS: &str = "name = \"Two & a half\"\n[materials.paint]\ndiffuse = 0.6\n\
    [materials.panel]\nluminance_cd_m2 = 2000\nsided = \"one\"\n\
    [[geometry]]\nbox = { min = [0, 0, 0], max = [6, 4, 3], inward = true }\nmaterial = \"paint\"\n\
    [[geometry]]\nname = \"wall\"\nbox = { min = [4, 0, 0], max = [4.1, 4, 3] }\nmaterial = \"paint\"\n\
    [[geometry]]\nname = \"desk\"\nbox = { min = [1, 2.5, 0], max = [3, 3.5, 0.7] }\nmaterial = \"paint\"\n\
    [[geometry]]\nname = \"panel\"\n\
    polygon = [[2.5, 1, 2.9], [2.5, 2, 2.9], [3.5, 2, 2.9], [3.5, 1, 2.9]]\nmaterial = \"panel\"\n\
    [[luminaire]]\nname = \"spot\"\nposition = [1, 1, 2.9]\nspot = { peak_cd = 900, inner_deg = 40, outer_deg = 70 }\n\
    [[grid]]\nname = \"left\"\ncorner = [0.5, 0.5, 0.75]\nu = [3, 0, 0]\nv = [0, 3, 0]\nspacing = 0.5\n\
    maintenance_factor = 0.8\n";

fn solved() -> Home {
    let home = Home::new();
    home.file("rooms.toml", ROOMS);
    let ran =
        home.run(&["solve", "rooms.toml", "-o", "map.glb", "--quality", "draft", "--no-audit"]);
    assert!(ran.code == 0 || ran.code == 3, "{ran:?}");
    home
}

fn drawn(home: &Home, arguments: &[&str]) -> String {
    let ran = home.run(&[&["grid", "map.glb", "-o", "plan.svg"], arguments].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    std::fs::read_to_string(home.path("plan.svg")).unwrap()
}

/// The texts of a drawing.
fn texts(svg: &str) -> Vec<&str> {
    let parts = svg.split("</text>").filter_map(|part| part.rsplit_once('>'));
    parts.map(|(_, text)| text).filter(|text| !text.trim().is_empty()).collect()
}

#[test]
fn a_plan_says_what_it_shows() {
    let home = solved();
    let svg = drawn(&home, &[]);
    let texts = texts(&svg);
    let has = |text: &str| texts.contains(&text);
    assert!(has("Two &amp; a half"), "{texts:?}");
    let about = texts.iter().find(|text| text.starts_with("Grid: left")).unwrap();
    for part in ["height 0.75 m", "6 x 6 points", "maintenance factor 0.80"] {
        assert!(about.contains(part), "{part}: {about}");
    }
    assert!(
        texts.iter().any(|text| text.starts_with("Em ") && text.contains("Emin ")),
        "{texts:?}"
    );
    assert!(texts.iter().any(|text| text.starts_with("U0 = Emin/Em 0.")), "{texts:?}");
    for text in
        ["x, m", "y, m", "Illuminance in lx", "cut at this height", "just below", "spot", "panel"]
    {
        assert!(has(text), "{text}: {texts:?}");
    }
    // A circle for the lamp, a rectangle for the panel, both named in the legend.
    assert_eq!(texts.iter().filter(|text| **text == "luminaire").count(), 2, "{texts:?}");
}

#[test]
fn a_plan_shows_the_values_of_the_table() {
    let home = solved();
    let svg = drawn(&home, &[]);
    let ran = home.run(&["grid", "map.glb", "--json"]);
    let values = ran.json()["grids"][0]["values"].clone();
    let greatest = values.as_array().unwrap().iter().map(|v| v["illuminance_lx"].as_f64().unwrap());
    let greatest = greatest.fold(0.0, f64::max).round() as i64;
    let near = |text: &&str| text.parse::<i64>().is_ok_and(|lx| (lx - greatest).abs() <= 10);
    assert!(texts(&svg).iter().any(near), "{greatest}: {:?}", texts(&svg));
}

#[test]
fn points_beyond_walls_have_no_value_on_a_plan() {
    let home = solved();
    // A quarter of it lies beyond the outer wall.
    let wide = ["--corner", "0,0,0.75", "--u", "8,0,0", "--v", "0,4,0", "--spacing", "1"];
    let svg = drawn(&home, &wide);
    let texts = texts(&svg);
    let told = texts.iter().find(|text| text.contains("outside of the room are left out"));
    assert!(told.is_some_and(|text| text.starts_with("8 points")), "{texts:?}");
    assert_eq!(texts.iter().filter(|text| **text == "0").count(), 2, "on the axes: {texts:?}");
}

#[test]
fn plans_are_pictures_too_and_are_refused_where_they_cannot_be_drawn() {
    let home = solved();
    let ran = home.run(&["grid", "map.glb", "--picture", "plan.png"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(std::fs::read(home.path("plan.png")).unwrap().starts_with(b"\x89PNG"));
    let ran = home.run(&["grid", "map.glb", "-o", "plan.jpg"]);
    assert!(ran.code == 2 && ran.err.contains(".png or .svg"), "{ran:?}");
    // Within the wall nothing is known, and a plan says so as the table does.
    let within = ["--corner", "4.02,1,0.75", "--u", "0.05,0,0", "--v", "0,1,0"];
    let table = home.run(&[&["grid", "map.glb"], &within[..]].concat());
    let drawn = home.run(&[&["grid", "map.glb", "-o", "none.svg"], &within[..]].concat());
    assert_eq!(
        (drawn.code, &drawn.out, &drawn.err),
        (0, &table.out, &table.err),
        "{drawn:?} {table:?}"
    );
    let svg = std::fs::read_to_string(home.path("none.svg")).unwrap();
    assert!(texts(&svg).contains(&"no value is known at any of its points"), "{svg}");
}

#[test]
fn a_grid_on_a_wall_has_a_plan_as_seen_from_the_room() {
    let home = solved();
    let wall = ["--corner", "0,4,0.5", "--u", "4,0,0", "--v", "0,0,2"];
    let svg = drawn(&home, &wall);
    let texts = texts(&svg);
    assert!(texts.contains(&"x, m") && texts.contains(&"z, m"), "{texts:?}");
    assert!(texts.contains(&"cut by this plane"), "{texts:?}");
    assert!(!texts.iter().any(|text| text.contains("height")), "{texts:?}");
    let about = texts.iter().find(|text| text.starts_with("Grid: grid")).unwrap();
    assert!(about.contains("on box 1/y_max"), "{about}");
    let off = ["--corner", "0,3.5,0.5", "--u", "4,0,0", "--v", "0,0,2"];
    assert!(drawn(&home, &off).contains("0.5 m before box 1/y_max"));
}

#[test]
fn an_opening_is_drawn_with_its_name() {
    let home = Home::new();
    let angles = "0 45 90\n0\n1000 700 0\n";
    home.file(
        "strip.ies",
        format!("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.3 1.2 0\n1 1 40\n{angles}"),
    );
    let scene = "[materials.m]\ndiffuse = 0.5\n\
        [[geometry]]\nmaterial = \"m\"\nbox = { min = [0, 0, 0], max = [8, 4, 3], inward = true }\n\
        [[luminaire]]\nname = \"strip\"\nposition = [2, 2, 2.9]\nies = \"strip.ies\"\n\
        array = { count = [2, 1, 1], step = [4, 0, 0] }\n\
        [[grid]]\nname = \"floor\"\ncorner = [0, 0, 0.1]\nu = [8, 0, 0]\nv = [0, 4, 0]\n";
    home.file("strips.toml", scene);
    let ran =
        home.run(&["solve", "strips.toml", "-o", "map.glb", "--accuracy", "10%", "--no-audit"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let svg = drawn(&home, &[]);
    assert_eq!(texts(&svg).iter().filter(|text| **text == "strip").count(), 2, "{svg}");
}
