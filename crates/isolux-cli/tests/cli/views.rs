//! Views: several cameras and files of one call, projections, scenes without a map, and views of nothing.

use crate::ran::{Home, Ran};

/// A lit room with two cameras, a solid in the middle, and nothing around it.
const ROOM: &str = r#"
name = "room"
[materials.paint]
diffuse = 0.7
[[geometry]]
name = "room"
box = { min = [0, 0, 0], max = [4, 5, 2.8], inward = true }
material = "paint"
[[geometry]]
name = "block"
box = { min = [1.5, 2, 0], max = [2.5, 3, 1] }
material = "paint"
[[luminaire]]
position = [2, 2.5, 2.5]
spot = { peak_cd = 1500, inner_deg = 30, outer_deg = 60 }
[[camera]]
name = "door"
position = [0.4, 0.4, 1.6]
target = [3, 4, 0.8]
[[camera]]
name = "far/corner"
position = [3.6, 4.6, 1.6]
target = [1, 1, 0.8]
"#;

fn room() -> Home {
    let home = Home::new();
    home.file("room.toml", ROOM);
    home
}

fn solved() -> Home {
    let home = room();
    let ran = home.run(&["solve", "room.toml", "-o", "m.glb", "--quality", "draft", "--no-audit"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home
}

/// Draws small views of the interpolated map.
fn draw(home: &Home, flags: &[&str]) -> Ran {
    home.run(&[&["render", "m.glb", "--size", "32x18", "--interpolated"], flags].concat())
}

fn pixels(home: &Home, name: &str) -> Vec<[u8; 3]> {
    let bytes = std::fs::read(home.path(name)).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels.as_chunks().0.to_vec()
}

#[test]
fn several_cameras_and_files_come_of_one_call() {
    let home = solved();
    let both = ["-o", "v-{camera}.png", "-o", "{camera}.exr", "--all-cameras", "--json"];
    let told = draw(&home, &both);
    assert_eq!(told.code, 0, "{told:?}");
    let views = told.json()["views"].clone();
    assert_eq!(views[1]["camera"], "far/corner");
    assert_eq!(views[1]["files"], serde_json::json!(["v-far-corner.png", "far-corner.exr"]));
    for name in ["v-door.png", "door.exr", "v-far-corner.png", "far-corner.exr"] {
        assert!(home.path(name).exists(), "{name}");
    }
    let alone = draw(&home, &["-o", "alone.png", "--camera", "far/corner"]);
    assert_eq!(alone.code, 0, "{alone:?}");
    let bytes = |name| std::fs::read(home.path(name)).unwrap();
    assert_eq!(bytes("alone.png"), bytes("v-far-corner.png"), "the same view");
    for (flags, word) in [
        (&["-o", "v.png", "--all-cameras"][..], "'view-{camera}.png'"),
        (&["-o", "v-{camera}.png", "--camera", "door", "--camera", "door"], "v-door.png"),
        (&["-o", "v.png", "-o", "v.png"], "v.png: two pictures"),
        (&["-o", "v.png", "--camera", "nobody"], "`nobody`"),
        (&["-o", "v.png", "-o", "v.jpg"], ".png, .exr or .hdr"),
        (&["-o", "v.exr", "--false-colour"], "--false-colour"),
        (&["-o", "v.png", "--false-colour-output", "lux.exr"], "lux.exr"),
        (&["-o", "v.png", "--contours"], "--false-colour-output"),
    ] {
        let ran = draw(&home, flags);
        assert!(ran.code == 2 && ran.err.contains(word), "{flags:?}: {ran:?}");
    }
}

#[test]
fn a_picture_its_chart_and_its_luminances_are_of_one_view() {
    let home = solved();
    let files = ["-o", "v.png", "-o", "v.hdr", "-o", "v.exr", "--false-colour-output", "lux.png"];
    let all = draw(&home, &files);
    assert_eq!(all.code, 0, "{all:?}");
    let chart = ["-o", "chart.png", "--false-colour"];
    assert_eq!(draw(&home, &chart).code, 0);
    assert_eq!(pixels(&home, "lux.png"), pixels(&home, "chart.png"));
    let image = exr::prelude::read_first_rgba_layer_from_file(
        home.path("v.exr"),
        |size, _| vec![[0.0_f32; 3]; size.area()],
        |image, at, (r, g, b, _): (f32, f32, f32, f32)| image[at.y() * 32 + at.x()] = [r, g, b],
    )
    .unwrap();
    let luminances = image.layer_data.channel_data.pixels;
    let mean = luminances.iter().map(|rgb| f64::from(rgb[1])).sum::<f64>() / (32.0 * 18.0);
    // Some 200 lx on paint of 0.7 are 45 cd/m2.
    assert!((5.0..500.0).contains(&mean), "{mean} cd/m2");
    // The eighteen codes of the first row of the picture rise with the luminances.
    let codes = pixels(&home, "v.png");
    for (a, b) in (0..32).flat_map(|a| (0..32).map(move |b| (a, b))) {
        if luminances[a][1] > 1.1 * luminances[b][1] {
            assert!(codes[a][1] >= codes[b][1], "{a} {b}");
        }
    }
    let hdr = std::fs::read(home.path("v.hdr")).unwrap();
    let head = String::from_utf8_lossy(&hdr[..300]).into_owned();
    assert!(head.starts_with("#?RADIANCE\n") && head.contains("\nEXPOSURE=179\n"), "{head}");
}

#[test]
fn projections_have_shapes_of_their_own() {
    let home = solved();
    let at = ["-vp", "2", "1", "1.6"];
    for (flags, size) in [
        (&["--eye", "2,1,1.6", "--panorama"][..], (32, 16)),
        // Straight above the middle.
        (&["--eye", "2,2.5,2", "--panorama"], (32, 16)),
        (&["--camera", "door", "--panorama"], (32, 16)),
        (&[&at[..], &["-vta", "-vh", "360", "-vv", "360"]].concat(), (18, 18)),
        (
            &[
                &at[..],
                &["-vth", "-vd", "0", "0", "1", "-vu", "0", "1", "0", "-vh", "180", "-vv", "180"],
            ]
            .concat(),
            (18, 18),
        ),
        (&[&at[..], &["-vtc", "-vh", "360", "-vv", "90"]].concat(), (32, 10)),
        (
            &[
                &at[..],
                &["-vtl", "-vd", "0", "0", "-1", "-vu", "0", "1", "0", "-vh", "3", "-vv", "1.5"],
            ]
            .concat(),
            (32, 16),
        ),
        (&[&at[..], &["-vd", "0", "1", "-.2", "-vv", "60"]].concat(), (32, 18)),
    ] {
        let ran = draw(&home, &[&["-o", "v.png", "--json"], flags].concat());
        assert_eq!(ran.code, 0, "{flags:?}: {ran:?}");
        let told = ran.json();
        let found = (told["width"].as_u64().unwrap(), told["height"].as_u64().unwrap());
        assert_eq!(found, size, "{flags:?}");
    }
    home.file("fish.vf", "rvu -vta -vp 2 1 1.6 -vd 0 1 0 -vu 0 0 1 -vh 180 -vv 180\n");
    let file = draw(&home, &["-o", "a.png", "-vf", "fish.vf"]);
    assert_eq!(file.code, 0, "{file:?}");
    let turned = draw(&home, &["-o", "b.png", "-vf", "fish.vf", "-vd", "1", "0", "0"]);
    assert_eq!(turned.code, 0, "{turned:?}");
    assert_ne!(pixels(&home, "a.png"), pixels(&home, "b.png"));
    for (flags, word) in [
        (&["-vts", "-vp", "1", "1", "1"][..], "v, l, h, a, c"),
        (&["-vp", "1", "1"], "--vp"),
        (&["-vth", "-vh", "200"], "up to 180"),
        (&["-vp", "1", "1", "1", "--camera", "door"], "cannot be used with"),
        (&["--eye", "1,1,1", "--fov", "60", "--panorama"], "cannot be used with"),
    ] {
        let ran = draw(&home, &[&["-o", "v.png"], flags].concat());
        assert!(ran.code == 2 && ran.err.contains(word), "{flags:?}: {ran:?}");
    }
}

#[test]
fn a_scene_is_solved_first_and_that_is_said() {
    let home = room();
    let ran =
        home.run(&["render", "room.toml", "-o", "v.png", "--size", "32x18", "--accuracy", "10%"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.err.contains("isolux solve room.toml -o map.glb"), "{ran:?}");
    assert_eq!(home.names(), ["room.toml", "v.png"], "no map is kept");
    let dark = ROOM.split("[[luminaire]]").next().unwrap().to_owned();
    home.file("dark.toml", dark);
    let ran = home.run(&["render", "dark.toml", "-o", "dark.png"]);
    assert!(ran.code == 2 && ran.err.contains("dark.toml: the scene has no light"), "{ran:?}");
    assert!(!home.path("dark.png").exists());
}

#[test]
fn views_of_nothing_are_no_pictures() {
    let home = solved();
    for (flags, word) in [
        (&["--eye", "2,2.5,9", "--target", "2,9,20"][..], "sees no surface"),
        (&["--eye", "2,2.5,0.5", "--target", "2,4,0.6"], "inside of a solid"),
    ] {
        let ran = draw(&home, &[&["-o", "v.png", "-o", "v.exr"], flags].concat());
        assert!(ran.code == 2 && ran.err.contains(word), "{flags:?}: {ran:?}");
        assert!(!home.path("v.png").exists() && !home.path("v.exr").exists());
    }
}

#[test]
fn the_other_cameras_are_drawn_where_one_sees_nothing() {
    let home = room();
    let out = "[[camera]]\nname = \"out\"\nposition = [2, 2, 9]\ntarget = [2, 9, 20]\n";
    home.file("room.toml", format!("{ROOM}{out}"));
    let ran = home.run(&["solve", "room.toml", "-o", "m.glb", "--quality", "draft", "--no-audit"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let ran = draw(&home, &["-o", "{camera}.png", "--all-cameras"]);
    assert!(ran.code == 2 && ran.err.contains("camera `out` sees no surface"), "{ran:?}");
    assert!(home.path("door.png").exists() && !home.path("out.png").exists());
}

#[test]
fn rooms_look_lit_and_white_walls_neutral() {
    let home = Home::new();
    home.file("room.toml", ROOM.replace("spot =", "cct_k = 2700\nspot ="));
    let ran = home.run(&["solve", "room.toml", "-o", "m.glb", "--quality", "draft", "--no-audit"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let mean = |flags: &[&str]| {
        let ran = draw(&home, &[&["-o", "v.png"], flags].concat());
        assert_eq!(ran.code, 0, "{ran:?}");
        let pixels = pixels(&home, "v.png");
        [0, 1, 2].map(|k| pixels.iter().map(|p| f64::from(p[k])).sum::<f64>() / pixels.len() as f64)
    };
    let [r, g, b] = mean(&[]);
    // The log-average is shown at 0.45, which is code 179.
    assert!((140.0..230.0).contains(&g), "{g}");
    assert!(r > b && r - b < 50.0, "white by and large, and a little warm: {r} {b}");
    let [r, _, b] = mean(&["--white", "none"]);
    assert!(r - b > 80.0, "as it is: {r} {b}");
    let [r, _, b] = mean(&["--white", "2700K"]);
    assert!((r - b).abs() < 12.0, "white: {r} {b}");
}
