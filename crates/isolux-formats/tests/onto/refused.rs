//! What cannot be done is said.

use crate::build::{FLOAT, File, floats};
use crate::light::ONE_PAGE;
use crate::scene;
use crate::written::Lit;
use isolux_formats::lightmap::Target;
use isolux_formats::onto::Options;
use serde_json::{Value, json};

/// What is said of a file that is not as it was solved.
fn refused(change: impl Fn(&mut File), target: Target) -> String {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    let mut file = scene::file();
    std::fs::write(&path, file.glb()).unwrap();
    let light = Lit::of(&path, ONE_PAGE);
    change(&mut file);
    std::fs::write(&path, file.glb()).unwrap();
    match light.onto(&path, (target, Options::default())) {
        Ok(_) => "nothing".to_owned(),
        Err(problems) => problems.to_string(),
    }
}

type Change<'a> = &'a dyn Fn(&mut File);

#[test]
fn other_scenes_are_refused_by_the_place_where_they_differ() {
    let cases: [(Change<'_>, &str); 5] = [
        (
            &|file| file.json["nodes"][3]["translation"] = json!([0, 2.001, 0]),
            "scene.glb: nodes[3], meshes[1].primitives[0]: `cloth` is not what the map was made of: triangle 0 of 2",
        ),
        (
            &|file| file.json["accessors"][6]["count"] = json!(3),
            "nodes[1], meshes[0].primitives[0]: `left [0]` is not what the map was made of: it has 1 triangle, in the map 2",
        ),
        (&|file| file.json["nodes"][0]["children"] = json!([1]), "is not what the map was made of"),
        (
            &|file| file.json["nodes"][0]["children"] = json!([1, 2, 3, 4, 5, 6, 7]),
            "it has 10 surfaces, the scene of the map 8",
        ),
        (
            &|file| file.json["scene"] = json!(1),
            "`elsewhere [0]` is not what the map was made of: triangle 0 of 2",
        ),
    ];
    for (change, words) in cases {
        let said = refused(|file| change(file), Target::Three);
        assert!(said.contains(words), "{words}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
}

#[test]
fn sets_of_coordinates_that_a_target_does_not_read_are_refused() {
    let said = refused(|_| {}, Target::Bevy);
    assert!(
        said.contains("meshes[1].primitives[0]: textures are read by TEXCOORD_1, and Bevy"),
        "{said}"
    );
    let crowded = |file: &mut File| {
        for set in 1..4 {
            file.json["materials"][3][format!("_{set}")] = json!({"texCoord": set});
        }
    };
    let said = refused(crowded, Target::Three);
    assert!(said.contains("TEXCOORD_1, TEXCOORD_2, TEXCOORD_3, and three.js"), "{said}");
}

/// Readers of JSON take lists for objects; whoever writes them again must not.
#[test]
fn hostile_forms_are_refused_without_panic() {
    let lists: [(&str, Value); 4] = [
        ("nodes", json!([])),
        ("extras", json!([1, 2])),
        ("samplers", json!([[9728, 9728, null, 10497, 10497]])),
        ("images", json!([[]])),
    ];
    for (key, value) in lists {
        let said = refused(|file| file.json[key] = value.clone(), Target::Three);
        assert_ne!(said, "nothing", "{key}");
    }
    // Attributes that nobody looked at until they are written.
    let short = |file: &mut File| {
        let accessor = file.accessor(&floats(&[1.0]), "SCALAR", FLOAT, 1);
        file.primitive()["attributes"]["_HEAT"] = json!(accessor);
    };
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    let mut file = scene::file();
    short(&mut file);
    std::fs::write(&path, file.glb()).unwrap();
    let said = Lit::of(&path, ONE_PAGE).refused(&path);
    assert!(said.contains("meshes[0].primitives[0]._HEAT: has 1 elements"), "{said}");
}
