//! `lint`: reports, drawings, conversions, exit codes.

use crate::ran::Home;

const IES: &str = "IES:LM-63-2019\n[TEST] 1\n[TESTLAB] lab\n[ISSUEDATE] today\n[MANUFAC] m\n\
                   [LUMCAT] c\n[LUMINAIRE] l\nTILT=NONE\n1 1000 1 7 1 1 2 0.1 0.2 0\n1 1.10000 20\n\
                   0 15 30 45 60 75 90\n0\n200 193 173 141 100 52 0\n";

#[test]
fn a_bad_file_ends_with_2_and_the_others_are_reported() {
    let home = Home::new();
    home.file("good.ies", IES);
    home.file("bad.ies", IES.replace("141", "x"));
    home.file("odd.ies", IES.replace("1 1000 1 7", "1 100 1 7"));
    let ran = home.run(&["lint", "bad.ies", "good.ies", "odd.ies", "gone.ldt", "--json"]);
    assert_eq!(ran.code, 2, "{ran:?}");
    let json = ran.json();
    let files = json["files"].as_array().unwrap();
    let usable: Vec<bool> = files.iter().map(|f| f["usable"].as_bool().unwrap()).collect();
    assert_eq!(usable, [false, true, true, false]);
    assert_eq!(files[0]["findings"][0]["severity"], "error");
    assert_eq!(files[0]["findings"][0]["line"], 13);
    assert_eq!(files[0]["findings"][0]["column"], 13);
    let gone = "does not exist";
    assert_eq!(files[3]["findings"][0]["what"], gone, "{json}");
    assert!(files[3]["findings"][0]["line"].is_null());
    assert!(files[0]["contents"].is_null());
    assert_eq!(files[1]["findings"].as_array().unwrap().len(), 0, "{json}");
    let ratio = files[1]["light_output_ratio"].as_f64().unwrap();
    // pi times 200 cd of a cosine, whose chords at 15 degrees lose half a per cent.
    assert!((ratio - 0.6283).abs() < 0.01, "{ratio}");
    assert_eq!(files[2]["findings"][0]["severity"], "warning");
    assert!(json["conversion"].is_null());
    let ran = home.run(&["lint", "bad.ies", "good.ies"]);
    assert_eq!(ran.code, 2, "{ran:?}");
    assert!(
        ran.out.contains("error: bad.ies: line 13, column 13: \"x\" is not a number"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("nothing found"), "{}", ran.out);
    assert_eq!(home.run(&["lint", "good.ies", "odd.ies"]).code, 0);
}

#[test]
fn a_file_cut_in_its_tilt_line_was_blamed_on_another_file() {
    let home = Home::new();
    home.file("cut.ies", &IES[..IES.find("ONE\n").unwrap()]);
    home.file("blank.ies", "\r\n");
    let scene = "[materials.m]\ndiffuse = 0.5\n[[luminaire]]\nposition = [2, 2, 2]\nies = \"cut.ies\"\n\
                 [[geometry]]\nmaterial = \"m\"\nbox = { min = [0, 0, 0], max = [4, 4, 3] }\n";
    home.file("scene.toml", scene);
    let told =
        "cut.ies: line 8: the file seems cut in this line: TILT=N names no file beside this one; ";
    let ran = home.run(&["lint", "cut.ies", "blank.ies"]);
    assert!(ran.code == 2 && ran.out.contains(&format!("error: {told}")), "{ran:?}");
    assert!(ran.out.contains("error: blank.ies: is empty; copy it again"), "{ran:?}");
    let ran = home.run(&["solve", "scene.toml", "-o", "map.glb"]);
    assert!(ran.code == 2 && ran.err.contains(told), "{ran:?}");
}

#[test]
fn drawings_go_to_a_file_and_to_the_terminal() {
    let home = Home::new();
    home.file("lamp.ies", IES);
    let ran = home.run(&["lint", "lamp.ies", "--polar", "lamp.svg", "--draw"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.out.contains("edge: 200 cd; C0-C180 solid, C90-C270 dotted"), "{}", ran.out);
    let svg = std::fs::read_to_string(home.path("lamp.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains("lamp.ies"), "{svg}");
}

#[test]
fn conversions_state_their_loss() {
    let home = Home::new();
    home.file("lamp.ies", IES);
    let ran = home.run(&["lint", "lamp.ies", "--convert", "lamp.ldt", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let conversion = &ran.json()["conversion"];
    assert_eq!(conversion["file"], "lamp.ldt");
    assert!(
        conversion["losses"]
            .as_array()
            .unwrap()
            .iter()
            .any(|l| { l.as_str().unwrap().contains("TESTLAB") })
    );
    // Six digits of 200 cd.
    assert!(conversion["largest_difference_cd"].as_f64().unwrap() < 1e-3);
    let ran = home.run(&["lint", "lamp.ldt", "--convert", "back.ies"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.out.contains("read back: intensities differ by at most"), "{}", ran.out);
    let info = home.run(&["info", "back.ies", "--json"]).json();
    assert_eq!(info["lamp_flux_lm"], 1000.0);
}

#[test]
fn what_cannot_be_written_is_refused_before_anything_is() {
    let home = Home::new();
    home.file("lamp.ies", IES);
    home.file("bad.ies", "nothing");
    for (arguments, says) in [
        (&["lint", "lamp.ies", "bad.ies", "--polar", "a.svg"][..], "--polar takes one file, not 2"),
        (&["lint", "lamp.ies", "--polar", "a.png"], "end its name in .svg"),
        (&["lint", "lamp.ies", "--convert", "a.xml"], "end its name in .ies or .ldt"),
        (&["lint", "lamp.ies", "--convert", "lamp.ies"], "is the input, too"),
        (&["lint", "lamp.ies", "--convert", "a.ies"], "has that format already"),
    ] {
        let ran = home.run(arguments);
        assert_eq!(ran.code, 2, "{ran:?}");
        assert!(ran.err.contains(says), "{ran:?}");
        assert_eq!(ran.out, "", "{ran:?}");
    }
    let ran = home.run(&["lint", "bad.ies", "--convert", "a.ldt", "--polar", "a.svg"]);
    assert_eq!(ran.code, 2, "{ran:?}");
    assert_eq!(home.names(), ["bad.ies", "lamp.ies"]);
}

/// A cosine of 637 cd, 0.6 x 0.6 m, is a luminance of 1768 cd/m2 everywhere.
#[test]
fn the_table_of_ratings() {
    let home = Home::new();
    home.file("panel.ies", IES.replace("0.1 0.2 0", "0.6 0.6 0"));
    home.file("point.ies", IES.replace("0.1 0.2 0", "0 0 0"));
    home.file("small.ies", IES.replace("0.1 0.2 0", "0.05 0.05 0"));
    let ran = home.run(&["lint", "panel.ies", "point.ies", "small.ies", "--ugr", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    let [panel, point, small] = [0, 1, 2].map(|k| &json["files"][k]["ugr"]);
    assert!(
        panel["refused"].is_null() && panel["remarks"].as_array().unwrap().is_empty(),
        "{panel}"
    );
    assert_eq!(panel["spacing_to_height"], 0.25);
    let rooms = panel["rooms"].as_array().unwrap();
    assert_eq!(rooms.len(), 19);
    assert_eq!(rooms[10]["room"], serde_json::json!([4, 8]));
    let ugr =
        |of: &serde_json::Value, room: usize| of["rooms"][room]["crosswise"][0].as_f64().unwrap();
    // A luminaire with symmetry about its axis: whichever way it hangs.
    assert_eq!(rooms[10]["crosswise"], rooms[10]["endwise"]);
    // The background is the same, luminance 144 times as high from an area that much smaller.
    let by_area = 8.0 * 144.0_f64.log10();
    assert!((ugr(small, 10) - ugr(panel, 10) - by_area).abs() < 1e-9, "{small}");
    assert!(small["remarks"][0].as_str().unwrap().contains("0.0025 m2"), "{small}");
    assert!(point["refused"].as_str().unwrap().contains("no luminous area"), "{point}");
    assert_eq!(point["rooms"], serde_json::json!([]));
    let ran = home.run(&["lint", "small.ies", "point.ies", "--ugr"]);
    assert!(ran.out.contains("S/H 0.25") && ran.out.contains("12H 8H"), "{}", ran.out);
    assert!(ran.out.contains("no UGR table: it has no luminous area"), "{}", ran.out);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80), "{}", ran.out);
    assert!(!home.run(&["lint", "small.ies"]).out.contains("UGR"));
    for (more, part) in [
        (["--ugr", "--spacing-to-height", "0.4"].as_slice(), "do not fill rooms"),
        (&["--ugr", "--spacing-to-height", "-1"], "not a ratio"),
        (&["--spacing-to-height", "0.5"], "--ugr"),
    ] {
        let ran = home.run(&[&["lint", "panel.ies"], more].concat());
        assert!(ran.code == 2 && ran.err.contains(part), "{part}: {ran:?}");
    }
    let wide =
        home.run(&["lint", "panel.ies", "--ugr", "--spacing-to-height", "1", "--json"]).json();
    assert_eq!(wide["files"][0]["ugr"]["spacing_to_height"], 1.0);
    assert_ne!(wide["files"][0]["ugr"]["rooms"][10], rooms[10]);
}
