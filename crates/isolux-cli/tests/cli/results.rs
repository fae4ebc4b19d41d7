//! Good input: values, JSON and exit codes.

use crate::ran::{Home, Ran};

fn solved(home: &Home, more: &[&str]) -> Ran {
    let arguments = ["solve", "builtin:cube", "-o", "cube.glb", "--quality", "draft", "--json"];
    home.run(&[&arguments, more].concat())
}

#[test]
fn solve_ends_with_one_object_that_says_how_good_it_is() {
    let home = Home::new();
    let ran = solved(&home, &[]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let report = ran.json();
    for number in [
        "accuracy_reached",
        "accuracy_statistical",
        "accuracy_discretization",
        "accuracy_interpolated",
        "reference_lx",
        "time_s",
        "increments",
        "rays",
        "receivers",
        "seed",
    ] {
        assert!(report[number].is_number(), "{number}: {report}");
    }
    assert_eq!(report["method"], "hybrid");
    assert_eq!(report["map"], "cube.glb");
    assert!(report["accuracy_reached"].as_f64().unwrap() <= 0.05, "{report}");
    assert_eq!(home.names(), ["cube.glb"]);
}

/// Few of the sixty, of as many kinds: all are assembled where they are made.
#[test]
fn scenes_to_be_judged_are_checked() {
    let home = Home::new();
    for number in ["04", "32", "40", "52", "57"] {
        let scene = format!("builtin:truth-{number}");
        let ran = home.run(&["check", &scene, "--json"]);
        assert_eq!(ran.code, 0, "{scene}: {ran:?}");
        let found = ran.json();
        assert!(found["mean_illuminance_lx"].as_f64().unwrap() > 1.0, "{scene}: {found}");
        assert!(found["triangles"].as_u64().unwrap() > 0, "{scene}");
    }
    let unknown = home.run(&["check", "builtin:truth-60"]);
    assert!(unknown.code == 2 && unknown.err.contains("truth-59"), "{unknown:?}");
}

#[test]
fn radiosity_says_what_is_unshot() {
    let home = Home::new();
    let ran = solved(&home, &["--method", "radiosity", "--explain"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let report = ran.json();
    assert_eq!(report["method"], "radiosity");
    let unshot = report["unshot"].as_f64().unwrap();
    assert!(unshot < 0.5, "{report}");
    // All that a quality sets can be set by hand, and --explain says how.
    for flag in ["--form-factor-tolerance", "--unshot", "--min-element", "--max-receivers"] {
        assert!(ran.err.contains(flag), "{flag}: {}", ran.err);
    }
    let info = home.run(&["info", "cube.glb", "--json"]).json();
    assert_eq!(info["provenance"]["unshot"]["share"].as_f64(), Some(unshot));
    assert!(home.run(&["info", "cube.glb"]).out.contains("ambient"));
}

#[test]
fn a_map_can_leave_mirrors_out_and_says_so() {
    let home = Home::new();
    let arguments = ["solve", "builtin:sphere", "-o", "sphere.glb", "--method", "radiosity"];
    let coarse = ["--diffuse-only", "--quality", "draft", "--time-limit", "20s", "--json"];
    let ran = home.run(&[&arguments[..], &coarse].concat());
    assert!([0, 3].contains(&ran.code), "{ran:?}");
    assert!(home.run(&["info", "sphere.glb"]).out.contains("--diffuse-only"));
    let at = 1.0 / 3.0_f64.sqrt();
    let point = format!("{at} {at} {at} {0} {0} {0}\n", -at);
    let probe = ["probe", "sphere.glb", "--points", "-", "--json"];
    let lx = home.run_with_input(&probe, &point).json()["points"][0]["illuminance_lx"].clone();
    // With its mirrors 1353 lx. Without, the luminaire alone: 100 cd from 0.43 m away, nearly upright,
    // make up to 540 lx, and one wall in eight of a sphere reflects little more.
    let lx = lx.as_f64().unwrap();
    assert!(lx > 300.0 && lx < 800.0, "{lx}");
}

#[test]
fn probe_answers_in_the_order_asked_and_null_where_nothing_is_known() {
    let home = Home::new();
    assert_eq!(solved(&home, &[]).code, 0);
    let points = "0 0 -5 0 0 1\n99 99 99 0 0 1\n5 0 0 -1 0 0\n";
    let ran = home.run_with_input(&["probe", "cube.glb", "--points", "-", "--json"], points);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    let lx: Vec<Option<f64>> =
        json["points"].as_array().unwrap().iter().map(|p| p["illuminance_lx"].as_f64()).collect();
    // pi x 892.8 cd/m2 / (2/3) at the middle of every wall; a draft is good to 5 %.
    let expected = std::f64::consts::PI * 892.8 * 1.5;
    for (index, value) in [(0, lx[0]), (2, lx[2])] {
        let value = value.unwrap_or_else(|| panic!("point {index} is not known: {json}"));
        assert!((value / expected - 1.0).abs() < 0.1, "point {index}: {value} lx");
    }
    assert_eq!(lx[1], None);
    assert!(ran.err.contains("1 of 3 points"), "{}", ran.err);
    let csv = home.run_with_input(&["probe", "cube.glb", "--points", "-"], points);
    assert_eq!(csv.out.lines().count(), 4, "{}", csv.out);
}

/// The middle of the floor of CUBE, and a place in the open.
#[test]
fn probe_of_a_scene_traces_paths() {
    let home = Home::new();
    let arguments = ["probe", "builtin:cube", "--points", "-", "--json", "--paths", "4096"];
    let points = "0 0 -5 0 0 1\n0 0 -2.5 0 0 1\n";
    let ran = home.run_with_input(&arguments, points);
    assert_eq!(ran.code, 0, "{ran:?}");
    let point = &ran.json()["points"][0];
    let number = |key: &str| point[key].as_f64().unwrap();
    let (found_lx, error_lx) = (number("illuminance_lx"), number("standard_error_lx"));
    // pi x 892.8 cd/m2 / (2/3), printed to a tenth of cd/m2; the chance of five standard errors by 16
    // replicates is 1.6e-4, and the numbers are the same in every run.
    let lx = |luminance: f64| std::f64::consts::PI * luminance * 1.5;
    assert!(error_lx > 0.0 && error_lx < 0.005 * found_lx, "{point}");
    assert!((found_lx - lx(892.8)).abs() < 5.0 * error_lx + lx(0.05), "{point}");
    // 50,000 cd at 2.5 m, where no map has a value.
    let direct_lx = ran.json()["points"][1]["direct_lx"].as_f64().unwrap();
    assert!((direct_lx / 8000.0 - 1.0).abs() < 1e-9, "{direct_lx}");
    let other = home.run_with_input(&[&arguments[..], &["--seed", "2"]].concat(), points);
    assert_ne!(other.out, ran.out);
}

#[test]
fn probe_of_the_bare_map_interpolates_direct_light_too() {
    let home = Home::new();
    assert_eq!(solved(&home, &[]).code, 0);
    let direct_lx = |flags: &[&str]| {
        let arguments = [&["probe", "cube.glb", "--points", "-", "--json"], flags].concat();
        let ran = home.run_with_input(&arguments, "1.1 2.3 -5 0 0 1\n");
        ran.json()["points"][0]["direct_lx"].as_f64().unwrap()
    };
    // 50,000 cd, five metres above.
    let exact_lx = 50_000.0 * 5.0 / (1.1_f64.powi(2) + 2.3_f64.powi(2) + 25.0).powf(1.5);
    let (fresh_lx, bare_lx) = (direct_lx(&[]), direct_lx(&["--interpolated"]));
    assert!((fresh_lx / exact_lx - 1.0).abs() < 1e-4, "{fresh_lx} for {exact_lx}");
    // A draft promises 5 % of the interpolated map, too.
    assert!(bare_lx != fresh_lx && (bare_lx / exact_lx - 1.0).abs() < 0.2, "{bare_lx}");
    let refused = home.run(&["probe", "cube.glb", "--points", "-", "--paths", "64"]);
    assert_eq!(refused.code, 2, "{refused:?}");
}

#[test]
fn a_run_out_of_time_has_a_valid_map() {
    let home = Home::new();
    let ran = home.run(&[
        "solve",
        "builtin:cube",
        "-o",
        "m.glb",
        "--accuracy",
        "0.001%",
        "--time-limit",
        "2s",
        "--json",
    ]);
    assert_eq!(ran.code, 3, "{ran:?}");
    assert_eq!(ran.json()["complete"], false);
    assert_eq!(home.run(&["info", "m.glb"]).code, 0);
}

#[test]
fn too_little_memory_is_refused() {
    let home = Home::new();
    let ran = home.run(&["solve", "builtin:cube", "-o", "m.glb", "--max-memory", "1kB"]);
    assert_eq!(ran.code, 4, "{ran:?}");
    assert!(ran.err.contains("for its triangles alone"), "{}", ran.err);
    // What is checked says so, too, and what would do.
    let ran = home.run(&["check", "builtin:hall", "--max-memory", "40MB"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("give --max-memory 90MiB"), "{}", ran.out);
    assert_eq!(home.names(), Vec::<String>::new());
}

#[test]
fn the_same_seed_gives_the_same_values_on_any_number_of_threads() {
    let home = Home::new();
    let values = |threads: &str| {
        assert_eq!(solved(&home, &["--threads", threads]).code, 0);
        home.run_with_input(&["probe", "cube.glb", "--points", "-"], "1 2 -5 0 0 1\n").out
    };
    let (one, two) = (values("1"), values("2"));
    assert!(one.lines().count() == 2);
    assert_eq!(one, two);
}

#[test]
fn a_dry_run_writes_nothing_and_explains() {
    let home = Home::new();
    let ran = home.run(&["solve", "builtin:cube", "--dry-run", "--explain", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    assert!(json["receivers"].is_number() && json["memory_bytes"].is_number(), "{json}");
    assert!(ran.err.contains("stops at an error of 1.0 %"), "{}", ran.err);
    assert_eq!(home.names(), Vec::<String>::new());
}

#[test]
fn check_finds_the_cube_in_order() {
    let home = Home::new();
    let json = home.run(&["check", "builtin:cube", "--json"]).json();
    assert_eq!(json["open_edges"], 0, "{json}");
    // 4 pi x 50 000 cd.
    let flux = json["luminous_flux_lm"].as_f64().unwrap();
    assert!((flux / (4.0 * std::f64::consts::PI * 50_000.0) - 1.0).abs() < 1e-9, "{flux}");
    let warnings = json["findings"].as_array().unwrap().iter();
    assert_eq!(warnings.filter(|f| f["severity"] == "warning").count(), 0, "{json}");
}

#[test]
fn lamps_that_reflect_nothing_carry_no_map() {
    let home = Home::new();
    let room = |diffuse: f64| {
        format!(
            "[materials.lamp]\nluminance_cd_m2 = 100.0\n[materials.wall]\nluminance_cd_m2 = 1.0\n\
             diffuse = {diffuse:?}\n[[geometry]]\nname = \"room\"\nmaterial = \"wall\"\n\
             box = {{ min = [0, 0, 0], max = [4, 4, 3], inward = true }}\n[[geometry]]\nname = \"lamp\"\n\
             material = \"lamp\"\nbox = {{ min = [1, 1, 1], max = [1.2, 1.2, 1.2] }}\n"
        )
    };
    home.file("room.toml", room(0.5));
    assert_eq!(home.run(&["solve", "room.toml", "-o", "m.glb", "--accuracy", "5%"]).code, 0);
    let json = home.run(&["info", "m.glb", "--json"]).json();
    let lit = json["surfaces"].as_array().unwrap().iter();
    let names: Vec<&str> = lit.map(|surface| surface["shape"].as_str().unwrap()).collect();
    assert!(names.len() == 6 && names.iter().all(|name| name.starts_with("room/")), "{names:?}");
    home.file("lamps.toml", room(0.0));
    let refused = home.run(&["solve", "lamps.toml", "-o", "l.glb"]);
    assert!(refused.code == 2 && refused.err.contains("lamps that reflect nothing"), "{refused:?}");
    assert!(home.run(&["check", "lamps.toml"]).out.contains("no surface can carry a map"));
}

/// A room with an unknown material and a glossy one, written as an OBJ file.
const WARNED: &str = "mtllib w.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 2 0\nv 1 2 0\nv 0 2 1\n\
                      usemtl nowhere\nf 1 3 2\nusemtl lamp\nf 4 5 6\n";

#[test]
fn with_json_progress_every_line_of_standard_error_is_an_object() {
    let home = Home::new();
    home.file("w.obj", WARNED);
    home.file("w.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 10 10 10\nKs 0.1 0.1 0.1\n");
    let keys = |arguments: &[&str], code: i32| -> Vec<String> {
        let ran = home.run(arguments);
        assert_eq!(ran.code, code, "{ran:?}");
        let object = |line: &str| -> serde_json::Map<String, serde_json::Value> {
            serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"))
        };
        ran.err.lines().filter_map(|line| object(line).keys().next().cloned()).collect()
    };
    let flags = ["--quality", "draft", "--explain", "--progress", "json"];
    let found = keys(&[&["solve", "w.obj", "-o", "w.glb"], &flags[..]].concat(), 0);
    for key in ["warning", "note", "accuracy"] {
        assert!(found.iter().any(|k| k == key), "{key}: {found:?}");
    }
    let missing = keys(&[&["solve", "no.obj", "-o", "w.glb"], &flags[..]].concat(), 2);
    assert_eq!(missing, ["error"]);
    let refused =
        keys(&[&["solve", "w.obj", "-o", "w.glb", "--max-memory", "1kB"], &flags[..]].concat(), 4);
    assert_eq!(refused.last().map(String::as_str), Some("refused"), "{refused:?}");
}

#[test]
fn exports_agree_with_what_probe_reads() {
    let home = Home::new();
    assert_eq!(solved(&home, &[]).code, 0);
    let ran = home.run(&["export", "cube.glb", "-o", "cube.csv", "--digits", "17"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let csv = String::from_utf8(std::fs::read(home.path("cube.csv")).unwrap()).unwrap();
    let rows = csv.lines().skip(1).map(|line| line.split(',').collect::<Vec<&str>>());
    // In the middle of walls: on edges, a point alone does not say which wall is meant.
    let inside = |row: &Vec<&str>| {
        let on_wall = |k: usize| row[k].parse::<f64>().unwrap().abs() == 5.0;
        (0..3).filter(|&k| on_wall(k)).count() == 1
    };
    let rows: Vec<Vec<&str>> = rows.filter(inside).collect();
    assert!(rows.len() > 100, "{}", rows.len());
    let points: String = rows.iter().map(|row| row[..6].join(" ") + "\n").collect();
    let arguments = ["probe", "cube.glb", "--points", "-", "--interpolated", "--json"];
    let probed = home.run_with_input(&arguments, &points).json();
    for (row, point) in rows.iter().zip(probed["points"].as_array().unwrap()) {
        let (written, read) =
            (row[7].parse::<f64>().unwrap(), point["illuminance_lx"].as_f64().unwrap());
        // Points are found again to a ten-millionth of their triangle by single-precision rays.
        assert!((written / read - 1.0).abs() < 1e-5, "{row:?}: {read}");
    }
    let refused = home.run(&["export", "cube.glb", "-o", "cube.obj"]);
    assert!(refused.code == 2 && refused.err.contains(".wrl"), "{refused:?}");
    assert_eq!(home.names(), ["cube.csv", "cube.glb"]);
}

/// A floor below a sun of Radiance: luminance times solid angle, and nothing to reflect it back.
const SUNNY: &str = "!xform -n here -t 1 0 0 floor.rad\nvoid light solar 0 0 3 1e6 1e6 1e6\n\
                     solar source sun 0 0 4 0 0 1 .533\n";

#[test]
fn a_radiance_scene_is_solved_from_its_file() {
    let home = Home::new();
    home.file("sunny.rad", SUNNY);
    home.file(
        "floor.rad",
        "void plastic m 0 0 5 .5 .5 .5 0 0\nm polygon f 0 0 12\n 0 0 0 2 0 0 2 2 0 0 2 0\n",
    );
    home.file("p.pts", "2 1 0 0 0 1\n");
    let solved = home.run(&["solve", "sunny.rad", "-o", "sunny.glb", "--quality", "draft"]);
    assert_eq!(solved.code, 0, "{solved:?}");
    assert!(solved.err.contains("179 lm/W"), "{solved:?}");
    let probed = home.run(&["probe", "sunny.glb", "--points", "p.pts"]);
    let row = probed.out.lines().nth(1).unwrap_or_else(|| panic!("{probed:?}"));
    let lux: f64 = row.split(',').nth(6).unwrap().parse().unwrap();
    let due = 179e6 * std::f64::consts::PI * 0.2665_f64.to_radians().sin().powi(2);
    // The map keeps single precision.
    assert!((lux / due - 1.0).abs() < 1e-6, "{lux} {due}");
}

#[test]
fn irradiances_are_written_as_rtrace_does() {
    let home = Home::new();
    home.file("sunny.rad", SUNNY);
    home.file(
        "floor.rad",
        "void plastic m 0 0 5 .5 .5 .5 0 0\nm polygon f 0 0 12\n 0 0 0 2 0 0 2 2 0 0 2 0\n",
    );
    home.file("p.pts", "2 1 0 0 0 1\n1.5 1 0 0 0 1\n");
    let arguments = ["probe", "sunny.rad", "--points", "p.pts", "-o", "p.res", "--paths", "64"];
    let ran = home.run(&arguments);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{ran:?}");
    let lines = std::fs::read_to_string(home.path("p.res")).unwrap();
    // 1e6 W/(sr m2) in the projected solid angle of the sun.
    let due = 1e6 * std::f64::consts::PI * 0.2665_f64.to_radians().sin().powi(2);
    assert_eq!(lines.lines().count(), 2, "{lines}");
    for word in lines.split_whitespace() {
        assert!((word.parse::<f64>().unwrap() / due - 1.0).abs() < 1e-6, "{lines}: {due}");
    }
    for (name, expected) in [("p.csv", ".res"), ("missing/p.res", "missing")] {
        let refused = home.run(&["probe", "sunny.rad", "--points", "p.pts", "-o", name]);
        assert!(refused.code == 2 && refused.err.contains(expected), "{refused:?}");
    }
}

#[test]
fn a_mesh_without_light_is_solved_from_a_scene_that_gives_it_some() {
    let home = Home::new();
    let facet = |corners: [&str; 3]| {
        let vertices: String = corners.iter().map(|c| format!("vertex {c}\n")).collect();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let floor =
        facet(["0 0 0", "2000 0 0", "2000 2000 0"]) + &facet(["0 0 0", "2000 2000 0", "0 2000 0"]);
    home.file("room.stl", format!("solid floor\n{floor}endsolid floor\n"));
    let dark = home.run(&["solve", "room.stl", "-o", "m.glb"]);
    assert_eq!(dark.code, 2, "{dark:?}");
    for expected in [
        "no light; give it a sky by --sky, or name the file in a scene.toml",
        "taken as grey 0.5",
        "2000 m large",
    ] {
        assert!(dark.err.contains(expected), "{expected}: {dark:?}");
    }
    home.file(
        "room.toml",
        "[materials.paint]\ndiffuse = 0.7\n[[geometry]]\nfile = 'room.stl'\nunits = 'mm'\nmaterial = 'paint'\n\
         [[luminaire]]\nposition = [1, 1, 2]\nisotropic = { intensity_cd = 400 }\n",
    );
    let solved = home.run(&["solve", "room.toml", "-o", "m.glb", "--quality", "draft"]);
    assert_eq!((solved.code, solved.err.contains("warning")), (0, false), "{solved:?}");
    let probed = home.run_with_input(&["probe", "m.glb", "--points", "-", "--json"], "1 1 0 0 0 1");
    let lux = probed.json()["points"][0]["illuminance_lx"].as_f64().unwrap();
    // 400 cd two metres above, and nothing to reflect it back; the map keeps single precision.
    assert!((lux - 100.0).abs() < 1e-3, "{lux}");
}

#[test]
fn sides_without_light_are_left_out_of_what_a_map_tells() {
    let home = Home::new();
    // Walls of a material for both sides, in a room that no light leaves.
    let room = "name = \"room\"\n[materials.paint]\ndiffuse = 0.5\n\
        [[geometry]]\nbox = { min = [0, 0, 0], max = [4, 4, 3], inward = true }\nmaterial = \"paint\"\n\
        [[luminaire]]\nposition = [2, 2, 2.75]\nisotropic = { intensity_cd = 1000 }\n";
    home.file("room.toml", room);
    let ran = home.run(&["solve", "room.toml", "-o", "map.glb", "--quality", "draft", "--resume"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.err.contains("solving from the beginning"), "{}", ran.err);
    let json = home.run(&["info", "map.glb", "--json"]).json();
    let surfaces = json["surfaces"].as_array().unwrap();
    for surface in surfaces {
        assert_eq!(surface["unlit_side_m2"], surface["area_m2"], "{surface}");
        assert!(surface["min_lx"].as_f64().unwrap() > 0.0, "{surface}");
    }
    let area_m2: f64 = surfaces.iter().map(|surface| surface["area_m2"].as_f64().unwrap()).sum();
    assert!((area_m2 - 80.0).abs() < 1e-6, "{area_m2}");
    assert!(home.run(&["info", "map.glb"]).out.contains("only that side counts"));
}

#[test]
fn names_from_files_leave_the_terminal_alone() {
    let home = Home::new();
    let name = format!("\u{1b}[31m\n{}", "n".repeat(1000));
    let written = name.replace('\u{1b}', "\\u001b").replace('\n', "\\n");
    let scene = format!(
        "name = \"{written}\"\n[materials.\"{written}\"]\ndiffuse = 0.99\n[[geometry]]\nname = \"{written}\"\n\
         material = \"{written}\"\nbox = {{ min = [0, 0, 0], max = [4, 4, 3], inward = true }}\n"
    );
    home.file("room.toml", scene);
    for command in ["info", "check"] {
        let said = home.run(&[command, "room.toml"]);
        assert_eq!(said.code, 0, "{said:?}");
        assert!(
            !said.out.contains('\u{1b}') && !said.out.contains(&"n".repeat(201)),
            "{}",
            said.out
        );
        assert!(said.out.contains("\\u{1b}[31m\\nnn") && said.out.contains('…'), "{}", said.out);
    }
    assert_eq!(home.run(&["info", "room.toml", "--json"]).json()["name"], name);
}

#[test]
fn a_picture_that_shows_nothing_is_told() {
    let home = Home::new();
    assert_eq!(home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]).code, 0);
    for (exposure, told) in [
        (
            "ev99",
            Some("100 % of what is lit in the picture is black; --exposure auto (here about ev"),
        ),
        (
            "ev-20",
            Some(
                "100 % of what is lit in the picture is burnt out; --exposure auto (here about ev",
            ),
        ),
        ("auto", None),
    ] {
        let ran = home.run(&[
            "render",
            "m.glb",
            "--size",
            "32x24",
            "--exposure",
            exposure,
            "-o",
            "v.png",
        ]);
        assert_eq!(ran.code, 0, "{ran:?}");
        match told {
            Some(told) => assert!(ran.err.contains(told), "{}", ran.err),
            None => assert!(!ran.err.contains("of what is lit"), "{}", ran.err),
        }
    }
}

/// A closed room of reflectance 1 has no solution. What both say of it is what is solved: 400 pi cd sr over 94 m2 and 1 - 0.99.
#[test]
fn a_room_that_absorbs_nothing_is_bounded_and_told() {
    let home = Home::new();
    home.file(
        "white.toml",
        r#"
            [materials.p]
            diffuse = 1.0
            [[geometry]]
            box = { min = [0, 0, 0], max = [4, 5, 3], inward = true }
            material = "p"
            [[luminaire]]
            position = [2, 2, 2]
            isotropic = { intensity_cd = 100 }
        "#,
    );
    let told = "white.toml: material `p`: reflects 1.000 of the light and is taken to reflect 0.99";
    let checked = home.run(&["check", "white.toml"]);
    assert!([&checked.out, &checked.err].iter().any(|text| text.contains(told)), "{checked:?}");
    let ran = home.run(&["solve", "white.toml", "-o", "w.glb", "--accuracy", "1%", "--json"]);
    assert!(ran.code == 0 && ran.err.contains(told), "{ran:?}");
    home.file("p.pts", "1 1 0 0 0 1\n");
    let probed = home.run(&["probe", "w.glb", "--points", "p.pts"]);
    let row = probed.out.lines().nth(1).expect("one reading");
    let lx: f64 = row.split(',').nth(6).expect("a column").parse().unwrap();
    // All but the light that comes straight, a thirtieth of it here, is as good as even.
    let expected = 400.0 * std::f64::consts::PI / (94.0 * 0.01);
    assert!((lx / expected - 1.0).abs() < 0.05, "{lx} for {expected}");
}
