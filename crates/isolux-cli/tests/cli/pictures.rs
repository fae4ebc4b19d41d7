//! Pictures for displays: what the file says of its colours, and flags that do not go together.

use crate::ran::{Home, Ran};

fn solved() -> Home {
    let home = Home::new();
    let ran = home.run(&["solve", "builtin:cube", "-o", "m.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home
}

/// Draws a small picture of the interpolated map.
fn draw(home: &Home, flags: &[&str]) -> Ran {
    let mut all = vec!["render", "m.glb", "-o", "v.png", "--size", "16x12", "--interpolated"];
    all.extend(flags);
    home.run(&all)
}

/// The bytes of the picture.
fn drawn(home: &Home, flags: &[&str]) -> Vec<u8> {
    let ran = draw(home, flags);
    assert_eq!(ran.code, 0, "{flags:?}: {ran:?}");
    std::fs::read(home.path("v.png")).unwrap()
}

fn has(png: &[u8], chunk: &[u8; 4]) -> bool {
    png.windows(4).any(|w| w == chunk)
}

#[test]
fn a_picture_says_what_its_colours_are() {
    let home = solved();
    let srgb = drawn(&home, &[]);
    assert!(has(&srgb, b"sRGB") && !has(&srgb, b"iCCP"));
    assert_eq!(drawn(&home, &["--profile", "srgb"]), srgb);
    let p3 = drawn(&home, &["--profile", "display-p3"]);
    assert!(has(&p3, b"iCCP") && !has(&p3, b"sRGB"));
    assert_eq!(drawn(&home, &["--profile", "display-p3"]), p3, "the same picture, the same bytes");
    let told = draw(&home, &["--profile", "display-p3", "--json"]).json();
    assert_eq!(told["profile"], "Display P3");
    assert_eq!(draw(&home, &["--false-colour", "--json"]).json()["profile"], "sRGB");
}

#[test]
fn flags_of_a_picture_change_it() {
    let home = solved();
    let plain = drawn(&home, &["--tone", "linear"]);
    let unturned = ["--tone", "linear", "--brightness", "0", "--contrast", "1"];
    assert_eq!(drawn(&home, &unturned), plain);
    for flags in [
        &["--tone", "linear", "--brightness", "0.1"][..],
        &["--tone", "linear", "--contrast", "1.2"],
        &["--tone", "ward"],
        &["--tone", "ward", "--display-white", "400cd/m2"],
        &["--tone", "tumblin-rushmeier"],
        &["--tone", "linear", "--white", "2700K"],
        &["--tone", "linear", "--exposure", "map"],
        &["--tone", "linear", "--exposure", "99%"],
    ] {
        assert_ne!(drawn(&home, flags), plain, "{flags:?}");
    }
    // All surfaces of CUBE are grey.
    assert_eq!(drawn(&home, &["--tone", "linear", "--white", "scene"]), plain);
}

#[test]
fn rounds_are_added_until_the_noise_is_as_asked_for() {
    let home = solved();
    let render = ["render", "m.glb", "-o", "v.png", "--size", "64x48", "--json"];
    let looked = |flags: &[&str]| home.run(&[&render[..], flags].concat());
    let usual = looked(&[]).json();
    let [noise, goal] = ["noise_cie94", "noise_goal_cie94"].map(|key| usual[key].as_f64().unwrap());
    assert!(goal == 0.5 && noise > 0.0 && noise <= goal, "{usual}");
    assert_eq!(usual["rounds"], 2, "as few as can be compared");
    let half = (0.4 * noise).to_string();
    let less = looked(&["--picture-accuracy", &half]).json();
    assert!(less["noise_cie94"].as_f64().unwrap() <= 0.4 * noise, "{less} and {usual}");
    assert!(less["rounds"].as_u64().unwrap() > 6, "{less} and {usual}");
    for (wrong, message) in
        [("0", "from 0.001 to 100"), ("NaN", "from 0.001"), ("1%", "not a number")]
    {
        let ran = looked(&["--picture-accuracy", wrong]);
        assert!(ran.code == 2 && ran.err.contains(message), "{wrong}: {ran:?}");
    }
    let ran = looked(&["--picture-accuracy", "1", "--interpolated"]);
    assert!(ran.code == 2 && ran.err.contains("cannot be used with"), "{ran:?}");
}

#[test]
fn a_picture_of_more_memory_than_allowed_is_refused_in_words() {
    let home = solved();
    let large = ["render", "m.glb", "-o", "v.png", "--size", "4000x3000", "--max-memory", "100MB"];
    let ran = home.run(&large);
    assert_eq!(ran.code, 4, "{ran:?}");
    assert!(ran.err.contains("more than the 95.4 MiB of --max-memory; raise it"), "{}", ran.err);
    let ran = home.run(&[&large[..], &["--json"]].concat());
    assert_eq!((ran.code, &ran.json()["error"]["exit_code"]), (4, &4.into()), "{ran:?}");
    assert!(!home.names().contains(&"v.png".to_owned()));
}

#[test]
fn what_does_not_go_together_is_refused() {
    let home = solved();
    home.file("text.icc", "no profile");
    home.file("huge.icc", vec![0; (8 << 20) + 2]);
    for (flags, message) in [
        (&["--contrast", "1.2"][..], "--contrast: other tone operators than linear have none"),
        (&["--tone", "ward", "--brightness", "0.1"], "add --tone linear"),
        (&["--display-white", "100cd/m2"], "add --tone ward or tumblin-rushmeier"),
        (&["--tone", "linear", "--contrast", "-1"], "0 to 100"),
        (&["--tone", "linear", "--brightness", "NaN"], "-1 to 1"),
        (&["--tone", "ward", "--display-white", "0cd/m2"], "from 1cd/m2"),
        (&["--white", "500K"], "1000K to 25000K"),
        (&["--exposure", "grey"], "grey 90cd/m2"),
        (
            &["--profile", "missing.icc"],
            "--profile missing.icc: does not exist; give srgb, display-p3",
        ),
        (&["--profile", "."], "not a regular file"),
        (&["--profile", "text.icc"], "text.icc: is no ICC profile"),
        (&["--profile", "huge.icc"], "huge.icc: an ICC profile of 8388609 bytes"),
        (&["--profile", "display-p3", "--false-colour"], "cannot be used with"),
        (&["--white", "scene", "--false-colour"], "cannot be used with"),
    ] {
        let ran = draw(&home, flags);
        assert_eq!(ran.code, 2, "{flags:?}: {ran:?}");
        assert!(ran.err.contains(message), "{flags:?}: {}", ran.err);
    }
    let cached = ["render", "builtin:cube", "--cache", "c", "-o", "v.png", "--exposure", "map"];
    let ran = home.run(&cached);
    assert!(ran.code == 2 && ran.err.contains("--exposure map: with --cache no map"), "{ran:?}");
    assert!(!home.names().contains(&"v.png".to_owned()));
}
