//! Luminaires whose light never comes to the scene.

use crate::ran::Home;

/// A closed room whose walls reflect inside, a lamp in it, and one 10 cm above its ceiling.
const ROOM: &str = r#"
[materials.wall]
diffuse = 0.5
sided = "one"
[[geometry]]
name = "room"
box = { min = [0, 0, 0], max = [4, 5, 3], inward = true }
material = "wall"
"#;

fn lamp(name: &str, height_m: f64) -> String {
    format!(
        "[[luminaire]]\nname = \"{name}\"\nposition = [2, 2, {height_m}]\nisotropic = {{ intensity_cd = 100 }}\n"
    )
}

#[test]
fn solve_names_luminaires_of_which_nothing_arrives() {
    let home = Home::new();
    let scene = home.file("room.toml", format!("{ROOM}{}{}", lamp("in", 2.0), lamp("above", 3.1)));
    let solve = ["solve", scene.as_str(), "-o", "room.glb", "--quality", "draft"];
    let ran = home.run(&[&solve[..], &["--json"]].concat());
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.err.contains("`above`") && !ran.err.contains("`in`"), "{}", ran.err);
    let lost = &ran.json()["flux_lost"];
    assert_eq!(lost["share"].as_f64(), Some(0.5), "{lost}");
    assert_eq!(lost["luminaires"].as_array().map(Vec::len), Some(1), "{lost}");
    assert_eq!(lost["luminaires"][0]["name"], "above");
    assert_eq!(lost["luminaires"][0]["share"].as_f64(), Some(1.0));
    assert_eq!(lost["luminaires"][0]["lights_nothing"], true);
    let text = home.run(&solve).out;
    assert!(text.contains("light that reaches no surface") && text.contains("50 %"), "{text}");
}

#[test]
fn solve_says_so_where_all_light_is_lost_and_is_silent_where_none_is() {
    let home = Home::new();
    let dark = home.file("dark.toml", format!("{ROOM}{}", lamp("above", 3.1)));
    let ran = home.run(&["solve", &dark, "-o", "dark.glb", "--quality", "draft", "--json"]);
    assert!(ran.err.contains("`above`"), "{}", ran.err);
    assert_eq!(ran.json()["flux_lost"]["share"].as_f64(), Some(1.0));
    let lit = home.file("lit.toml", format!("{ROOM}{}", lamp("in", 2.0)));
    let ran = home.run(&["solve", &lit, "-o", "lit.glb", "--quality", "draft", "--json"]);
    assert!(!ran.err.contains("warning"), "{}", ran.err);
    assert_eq!(ran.json()["flux_lost"]["share"].as_f64(), Some(0.0));
}
