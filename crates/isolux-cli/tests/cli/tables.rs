//! Tables: how wide they are, and how many digits they have.

use crate::ran::{Home, Ran};

/// A room with names longer than a terminal is wide, and two grids.
fn scene() -> String {
    let long = "a cupboard with a name that goes on and on, as those of exporters often do, and on";
    format!(
        "name = \"{long}\"\n[materials.paint]\ndiffuse = 0.6\n[materials.\"{long}\"]\ndiffuse = 0.3\n\
         [[geometry]]\nbox = {{ min = [0, 0, 0], max = [4, 4, 3], inward = true }}\nmaterial = \"paint\"\n\
         [[geometry]]\nname = \"{long}\"\nbox = {{ min = [1, 1, 0], max = [2, 2, 0.7] }}\nmaterial = \"{long}\"\n\
         [[luminaire]]\nname = \"{long}\"\nposition = [2, 2, 2.9]\nspot = {{ peak_cd = 900, inner_deg = 40, outer_deg = 70 }}\n\
         [[grid]]\nname = \"{long}\"\ncorner = [0.5, 0.5, 0.75]\nu = [3, 0, 0]\nv = [0, 3, 0]\n\
         [[grid]]\nname = \"floor\"\ncorner = [2.5, 0.5, 0]\nu = [1, 0, 0]\nv = [0, 3, 0]\n"
    )
}

fn solved() -> (Home, Ran) {
    let home = Home::new();
    home.file("room.toml", scene());
    let ran = home.run(&["solve", "room.toml", "-o", "map.glb", "--quality", "draft"]);
    assert!(ran.code == 0 || ran.code == 3, "{ran:?}");
    (home, ran)
}

#[track_caller]
fn check_width(arguments: &[&str], out: &str) {
    // Findings are sentences, one a line.
    let is_finding = |line: &&str| line.starts_with("note: ") || line.starts_with("warning: ");
    for line in out.lines().filter(|line| !is_finding(line)) {
        assert!(line.chars().count() <= 80, "{arguments:?}: {line}");
    }
}

#[test]
fn tables_fit_eighty_columns() {
    let (home, solved) = solved();
    check_width(&["solve"], &solved.out);
    for arguments in [
        &["info", "map.glb"][..],
        &["info", "room.toml"],
        &["check", "room.toml"],
        &["audit", "map.glb", "--places", "64"],
        &["grid", "map.glb"],
        &["grid", "map.glb", "--name", "floor"],
        &["validate", "--case", "cube", "--method", "hybrid"],
    ] {
        let ran = home.run(arguments);
        assert!(ran.code < 2 && !ran.out.is_empty(), "{ran:?}");
        check_width(arguments, &ran.out);
    }
}

#[test]
fn long_names_are_cut_with_an_ellipsis() {
    let (home, _) = solved();
    let ran = home.run(&["grid", "map.glb"]);
    let cut = ran.out.lines().filter(|line| line.contains("a cupboard with") && line.contains('…'));
    // A part of the table each.
    assert!(cut.count() >= 2, "{}", ran.out);
    assert!(ran.out.contains(" floor "), "{}", ran.out);
}

/// The columns of the rows after the header, by name.
fn column<'a>(csv: &'a str, name: &str) -> Vec<&'a str> {
    let index = csv.lines().next().unwrap().split(',').position(|known| known == name).unwrap();
    // Names between quotes may hold commas: counted from the end.
    let from_end = csv.lines().next().unwrap().split(',').count() - 1 - index;
    csv.lines().skip(1).map(|line| line.rsplit(',').nth(from_end).unwrap()).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// Values written beside those of JSON: half of the last digit off, which lies two below the first of the error.
#[track_caller]
fn check_digits(csv: &str, values: &[serde_json::Value]) {
    let written = column(csv, "illuminance_lx");
    let errors = column(csv, "standard_error_lx");
    assert_eq!(written.len(), values.len());
    for ((written, error), value) in written.iter().zip(errors).zip(values) {
        let (exact, error_lx) = (
            value["illuminance_lx"].as_f64().unwrap(),
            value["standard_error_lx"].as_f64().unwrap(),
        );
        assert!(
            (number(written) - exact).abs() <= 0.005 * error_lx,
            "{written} for {exact}, {error_lx}"
        );
        assert!((number(error) - error_lx).abs() <= 0.005 * error_lx, "{error} for {error_lx}");
        assert!(written.len() <= 9, "{written} with an error of {error_lx} lx");
    }
}

#[test]
fn tables_for_programs_keep_what_is_significant() {
    let (home, _) = solved();
    let ran = home.run(&["grid", "map.glb", "--name", "floor", "--csv", "floor.csv", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let read = |name: &str| std::fs::read_to_string(home.path(name)).unwrap();
    check_digits(&read("floor.csv"), ran.json()["grids"][0]["values"].as_array().unwrap());
    home.file("p.pts", "3 1 0 0 0 1\n2.5 3 0 0 0 1\n");
    let json = home.run(&["probe", "map.glb", "--points", "p.pts", "--json"]).json();
    let table = home.run(&["probe", "map.glb", "--points", "p.pts"]);
    check_digits(&table.out, json["points"].as_array().unwrap());
}

#[test]
fn digits_may_be_asked_for() {
    let (home, _) = solved();
    home.file("p.pts", "3 1 0 0 0 1\n");
    let exact = home.run(&["probe", "map.glb", "--points", "p.pts", "--json"]).json();
    let exact = exact["points"][0]["illuminance_lx"].as_f64().unwrap();
    let probed = |digits: &str| {
        let ran = home.run(&["probe", "map.glb", "--points", "p.pts", "--digits", digits]);
        assert_eq!(ran.code, 0, "{ran:?}");
        number(column(&ran.out, "illuminance_lx")[0])
    };
    assert_eq!(probed("17"), exact);
    assert!((probed("2") / exact - 1.0).abs() <= 0.05 && probed("9") != probed("2"));
    let run = |arguments: &[&str]| home.run(&[arguments, &["--digits", "17"]].concat());
    assert_eq!(run(&["grid", "map.glb", "--name", "floor", "--csv", "all.csv"]).code, 0);
    assert_eq!(run(&["export", "map.glb", "-o", "map.csv"]).code, 0);
    let csv = std::fs::read_to_string(home.path("map.csv")).unwrap();
    assert!(column(&csv, "illuminance_lx").iter().any(|text| text.len() > 16), "{csv:.400}");
    for (arguments, told) in [
        (&["grid", "map.glb", "--digits", "4"][..], "--csv"),
        (&["export", "map.glb", "-o", "map.wrl", "--digits", "4"], "--digits is for .csv"),
        (&["probe", "map.glb", "--points", "p.pts", "--digits", "0"], "whole number from 1 to 17"),
    ] {
        let ran = home.run(arguments);
        assert!(ran.code == 2 && ran.err.contains(told), "{arguments:?}: {ran:?}");
    }
}
