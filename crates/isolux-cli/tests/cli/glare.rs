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

fn rated(home: &Home, more: &[&str]) -> Vec<Value> {
    let ran = home.run(&[&["glare", "map.glb", "--json"], more].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    json["observers"].as_array().unwrap().clone()
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
