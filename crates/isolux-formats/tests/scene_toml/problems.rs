//! Many problems at once, each where it is.

use super::{FLOOR, problems, read};

#[test]
fn all_problems_come_together_with_their_places() {
    let text = "nam = 'x'
units = 'yard'
[materials.a]
diffuse = 2
[materials.b]
diffuse = 'blue'
mirrow = 0.1
[[geometry]]
box = { min = [0,0,0], max = [0,0,0] }
material = 'b'
[[geometry]]
polygon = [[0,0,0], [1,0,0], [1,1,0]]
material = 'nowhere'
[[luminaire]]
position = [0, 0, 'up']
isotropic = { intensity = 1 }
colour = 'warm'
[[camera]]
position = [0, 0, 0]
";
    let places: Vec<String> = problems(text)
        .iter()
        .map(|p| p.split_once(": ").unwrap().0.replace("line ", "").replace("column ", ""))
        .collect();
    let expected = [
        "1, 1", "2, 9", "4, 11", "6, 11", "7, 1", "9, 7", "13, 12", "15, 19", "16, 15", "17, 10",
        "18, 1",
    ];
    assert_eq!(places, expected);
}

#[test]
fn text_that_is_not_toml() {
    for (text, place) in [
        ("name = ", "line 1, column 8"),
        ("[[geometry]\n", "line 1"),
        ("a = 1\na = 2\n", "line 2"),
        ("x = \"\u{1}\"", "line 1"),
        ("\n\n   [materials\ny = 3", "line 3"),
    ] {
        let found = problems(text);
        assert!(found[0].starts_with(place), "{text:?}: {found:?}");
    }
}

#[test]
fn tables_where_lists_are_wanted() {
    for (text, expected) in [
        ("[luminaire]\nposition = [0,0,0]", "write `[[luminaire]]` in double brackets"),
        ("geometry = 3", "`[[geometry]]`"),
        ("camera = [1, 2]", "write `[[camera]]` in double brackets"),
        ("materials = { paint = 3 }", "write `[materials.paint]` and its keys below"),
        ("materials = 3", "`[materials.NAME]`"),
        ("[[materials]]\nname = 'x'", "`[materials.NAME]`"),
        ("up = 'x'", "`y` or `z`"),
        ("name = 5", "expected a string"),
    ] {
        let found = problems(&format!("{text}\n"));
        assert!(found.iter().any(|p| p.contains(expected)), "{text:?}: {found:?}");
    }
}

#[test]
fn a_scene_needs_geometry() {
    assert_eq!(problems(""), ["line 1, column 1: the scene has no geometry; add a [[geometry]]"]);
}

#[test]
fn name_up_and_byte_order_mark() {
    let parts = read(&format!("\u{feff}name = 'Büro'\nup = 'y'\n{FLOOR}"));
    assert_eq!((parts.name.as_str(), parts.up), ("Büro", isolux::scene::UpAxis::Y));
    assert_eq!(read(FLOOR).name, "scene");
}
