//! Groups of luminaires, solved once and re-dimmed.

use crate::ran::Home;

/// A room with a lamp at either end; `dimming` is that of the right one.
fn room(dimming: f64) -> String {
    format!(
        "name = \"two lamps\"\n[materials.grey]\ndiffuse = 0.5\n\
         [[geometry]]\nbox = {{ min = [0, 0, 0], max = [4, 3, 2.5], inward = true }}\nmaterial = \"grey\"\n\
         [[luminaire]]\ngroup = \"left\"\nposition = [1, 1.5, 2]\nisotropic = {{ intensity_cd = 100 }}\n\
         [[luminaire]]\ngroup = \"right/low\"\nposition = [3, 1.5, 1]\nisotropic = {{ intensity_cd = 60 }}\n\
         dimming = {dimming}\n"
    )
}

const POINTS: &str =
    "0.3 0.4 0 0 0 1\n2 1.5 0 0 0 1\n3.6 1 0 0 0 1\n4 1.5 1.2 -1 0 0\n0 0.7 2 1 0 0\n";

fn solved() -> Home {
    let home = Home::new();
    home.file("room.toml", room(1.0));
    home.file("p.pts", POINTS);
    let arguments =
        ["solve", "room.toml", "-o", "map.glb", "--group", "--accuracy", "3%", "--json"];
    let ran = home.run(&arguments);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    assert_eq!(json["groups"][1]["group"], "right/low", "{json}");
    assert_eq!(json["groups"][1]["map"], "map.right-low.glb", "{json}");
    assert!(json["accuracy_reached"].as_f64().unwrap() < 0.05, "{json}");
    home
}

/// Readings of a map and their errors, lx.
fn readings(home: &Home, map: &str) -> Vec<(f64, f64)> {
    let ran = home.run(&["probe", map, "--points", "p.pts", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let json = ran.json();
    let points = json["points"].as_array().unwrap().iter();
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    points.map(|p| (number(&p["illuminance_lx"]), number(&p["standard_error_lx"]))).collect()
}

#[test]
fn a_mix_is_the_map_of_the_dimmed_scene() {
    let home = solved();
    assert_eq!(
        home.names(),
        ["map.glb", "map.left.glb", "map.right-low.glb", "p.pts", "room.toml"]
    );
    let ran = home.run(&["mix", "map.glb", "--dim", "right/low=25%", "-o", "dim.glb", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home.file("dimmed.toml", room(0.25));
    let ran = home.run(&["solve", "dimmed.toml", "-o", "dimmed.glb", "--accuracy", "3%"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    let (mixed, solved) = (readings(&home, "dim.glb"), readings(&home, "dimmed.glb"));
    for (a, b) in mixed.iter().zip(&solved) {
        // Once in two million trials.
        assert!((a.0 - b.0).abs() < 5.0 * f64::hypot(a.1, b.1), "{mixed:?} and {solved:?}");
    }
    let off = home.run(&["mix", "map.glb", "--dim", "right/low=0", "-o", "left.glb"]);
    assert_eq!(off.code, 0, "{off:?}");
    // With the other off, it is the map of one group: values to the bit, errors but for rounding.
    let values = |map: &str| readings(&home, map);
    for (a, b) in values("left.glb").iter().zip(&values("map.left.glb")) {
        assert!(a.0 == b.0 && (a.1 / b.1 - 1.0).abs() < 1e-12, "{a:?} {b:?}");
    }
    let by_hand = ["mix", "map.left.glb", "map.right-low.glb=0.25", "-o", "hand.glb"];
    assert_eq!(home.run(&by_hand).code, 0);
    assert_eq!(values("hand.glb"), mixed);
    let contents = home.run(&["info", "dim.glb"]);
    assert!(contents.out.contains("right/low 25 %"), "{}", contents.out);
}

#[test]
fn what_cannot_be_mixed_is_refused_with_its_reason() {
    let home = solved();
    home.file("other.toml", room(1.0).replace("0.5\n[[geometry]]", "0.2\n[[geometry]]"));
    let ran = home.run(&["solve", "other.toml", "-o", "other.glb", "--quality", "draft"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    home.file(
        "plain.toml",
        room(1.0).replace("group = \"left\"\n", "").replace("group = \"right/low\"\n", ""),
    );
    for (arguments, said) in [
        (vec!["mix", "map.glb", "--dim", "middle=50%"], "left, right/low"),
        (vec!["mix", "map.glb", "--dim", "left=-1"], "no dimming"),
        (vec!["mix", "map.glb", "--dim", "left"], "GROUP=30%"),
        (vec!["mix", "map.glb=bright"], "no dimming"),
        (vec!["mix", "map.glb=0"], "nothing is left"),
        (vec!["mix", "map.left.glb", "other.glb"], "other surfaces"),
        (vec!["mix", "other.glb", "--dim", "left=50%"], "several groups"),
        (vec!["mix", "missing.glb"], "missing.glb"),
        (vec!["solve", "plain.toml", "--group"], "has no groups"),
    ] {
        let ran = home.run(&[&arguments[..], &["-o", "out.glb"]].concat());
        assert!(ran.code == 2 && ran.err.contains(said), "{arguments:?}: {ran:?}");
    }
    let onto_itself = home.run(&["mix", "map.left.glb", "-o", "map.left.glb"]);
    assert!(onto_itself.code == 2 && onto_itself.err.contains("is the input"), "{onto_itself:?}");
    assert!(!home.names().contains(&"out.glb".to_owned()));
}

#[test]
fn finished_groups_are_not_solved_again() {
    let home = solved();
    let bytes = |name: &str| std::fs::read(home.path(name)).unwrap();
    let whole = bytes("map.glb");
    std::fs::remove_file(home.path("map.right-low.glb")).unwrap();
    std::fs::remove_file(home.path("map.glb")).unwrap();
    let arguments =
        ["solve", "room.toml", "-o", "map.glb", "--group", "--accuracy", "3%", "--resume"];
    let ran = home.run(&arguments);
    assert!(ran.code == 0 && ran.err.contains("map.left.glb: is complete already"), "{ran:?}");
    assert!(bytes("map.glb") == whole, "the sums differ");
}

#[test]
fn lux_is_exported_with_that_of_each_group() {
    let home = solved();
    let ran = home.run(&["export", "map.glb", "-o", "light.glb", "--lux", "--json"]);
    assert_eq!(ran.code, 0, "{ran:?}");
    assert_eq!(ran.json()["groups"], serde_json::json!(["left", "right/low"]));
    let light = Light::read(&home, "light.glb");
    let whole = light.numbers("_ILLUMINANCE_LX");
    let [left, right] = ["_GROUP_0_LX", "_GROUP_1_LX"].map(|name| light.numbers(name));
    assert!(whole.len() > 1000 && left.iter().chain(&right).all(|lx| *lx >= 0.0));
    for ((all, left), right) in whole.iter().zip(&left).zip(&right) {
        // Three roundings to 32 bits.
        assert!(
            (all - left - right).abs() <= 2.0 * f32::EPSILON * all,
            "{all} of {left} and {right}"
        );
    }
    let errors = light.numbers("_STDERR_LX");
    let [left, right] =
        ["_GROUP_0_STDERR_LX", "_GROUP_1_STDERR_LX"].map(|name| light.numbers(name));
    for ((all, left), right) in errors.iter().zip(&left).zip(&right) {
        assert!(
            (all - left.hypot(*right)).abs() <= 2.0 * f32::EPSILON * all,
            "{all} of {left} and {right}"
        );
    }
    let alone = home.run(&["export", "map.left.glb", "-o", "alone.glb", "--lux", "--json"]);
    assert_eq!(alone.json()["groups"], serde_json::json!([]));
    assert!(
        home.run(&["export", "map.glb", "-o", "bare.glb", "--json"]).json()["groups"].is_null()
    );
}

/// A file with light at vertices.
struct Light {
    json: serde_json::Value,
    binary: Vec<u8>,
}

impl Light {
    fn read(home: &Home, name: &str) -> Self {
        let bytes = std::fs::read(home.path(name)).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Self { json, binary: bytes[28 + length..].to_vec() }
    }

    /// An attribute of all primitives; each of them says how it reflects.
    fn numbers(&self, attribute: &str) -> Vec<f32> {
        let at = |value: &serde_json::Value| value.as_u64().unwrap() as usize;
        let meshes = self.json["meshes"].as_array().unwrap().iter();
        let primitives = meshes.flat_map(|mesh| mesh["primitives"].as_array().unwrap());
        let bytes = primitives.flat_map(|primitive| {
            assert_eq!(primitive["extras"]["reflectance"], serde_json::json!([0.5, 0.5, 0.5]));
            let accessor = &self.json["accessors"][at(&primitive["attributes"][attribute])];
            let view = &self.json["bufferViews"][at(&accessor["bufferView"])];
            self.binary[at(&view["byteOffset"])..][..at(&view["byteLength"])].to_vec()
        });
        let bytes: Vec<u8> = bytes.collect();
        bytes.as_chunks::<4>().0.iter().map(|word| f32::from_le_bytes(*word)).collect()
    }
}
