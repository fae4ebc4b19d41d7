//! Meshes that stand otherwise than stored: copies, morph targets, skins.

use crate::build::{FLOAT, File, I16, U8, U16, assert_warns, floats};
use isolux::scene::Shape;
use serde_json::json;

/// Rounding of products of a few numbers near one that were stored as `f32`.
const SINGLE_ROUNDING: f64 = 1e-6;

#[track_caller]
fn assert_near(shape: &Shape, expected: &[[f64; 3]]) {
    assert_eq!(shape.positions.len(), expected.len());
    let pairs = shape.positions.as_flattened().iter().zip(expected.as_flattened());
    let far = pairs.fold(0.0, |far: f64, (a, b)| far.max((a - b).abs()));
    assert!(far < SINGLE_ROUNDING, "{:?} is not {expected:?}", shape.positions);
}

fn instanced() -> File {
    let mut file = File::triangle();
    let shifts = file.accessor(&floats(&[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]), "VEC3", FLOAT, 2);
    // No turn, and a quarter turn about z.
    let half: i16 = 23170;
    let turns: Vec<u8> =
        [0, 0, 0, i16::MAX, 0, 0, half, half].iter().flat_map(|c| c.to_le_bytes()).collect();
    let turns = file.accessor(&turns, "VEC4", I16, 2);
    file.json["accessors"][turns]["normalized"] = json!(true);
    let scales = file.accessor(&floats(&[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]), "VEC3", FLOAT, 2);
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    file.json["nodes"][0] = json!({
        "name": "desk", "mesh": 0, "translation": [0, 0, 10],
        "extensions": {"EXT_mesh_gpu_instancing": {
            "attributes": {"TRANSLATION": shifts, "ROTATION": turns, "SCALE": scales, "_ID": shifts},
        }},
    });
    file
}

#[test]
fn copies_of_a_mesh() {
    let parts = instanced().parts();
    let [first, second] = &parts.shapes[..] else { panic!("{} shapes", parts.shapes.len()) };
    assert_eq!((first.name.as_str(), second.name.as_str()), ("desk[0]", "desk[1]"));
    assert_near(first, &[[1.0, 0.0, 10.0], [2.0, 0.0, 10.0], [1.0, 1.0, 10.0]]);
    assert_near(second, &[[0.0, 2.0, 10.0], [0.0, 4.0, 10.0], [-2.0, 2.0, 10.0]]);
}

#[test]
fn copies_that_cannot_be_read() {
    let path = |file: &File| file.read().expect_err("read").0[0].place.clone();
    let mut file = instanced();
    let attributes = "EXT_mesh_gpu_instancing";
    file.json["nodes"][0]["extensions"][attributes]["attributes"]["SCALE"] = json!(0);
    assert!(path(&file).ends_with("attributes.SCALE"), "{}", path(&file));
    file.json["nodes"][0]["extensions"][attributes]["attributes"]["SCALE"] = json!("many");
    assert!(path(&file).ends_with("attributes.SCALE"), "{}", path(&file));
    file.json["nodes"][0]["extensions"][attributes]["attributes"]["SCALE"] = json!(99);
    assert!(file.read().is_err());
    let mut file = instanced();
    let zero = file.accessor(&[0; 16], "VEC4", I16, 2);
    file.json["nodes"][0]["extensions"][attributes]["attributes"]["ROTATION"] = json!(zero);
    assert!(path(&file).ends_with("attributes.ROTATION"), "{}", path(&file));
}

/// Many nodes, each of which asks for as many copies as a file may hold.
#[test]
fn copies_without_end() {
    let mut file = File::triangle();
    file.json["accessors"][0]["count"] = json!(3);
    let places = file.view(&[0]);
    let none = file.view(&[0; 12]);
    let sparse = json!({
        "type": "VEC3", "componentType": FLOAT, "count": 1 << 20,
        "sparse": {"count": 1, "indices": {"bufferView": places, "componentType": U8},
            "values": {"bufferView": none}},
    });
    let index = file.json["accessors"].as_array().unwrap().len();
    file.json["accessors"].as_array_mut().unwrap().push(sparse);
    let node = json!({"mesh": 0, "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": index}}}});
    file.json["nodes"] = json!([node.clone(), node]);
    file.json["scenes"][0]["nodes"] = json!([0, 1]);
    let problems = file.read().expect_err("read");
    assert!(problems.0[0].what.contains("instances in all"), "{problems}");
}

fn morphing() -> File {
    let mut file = File::triangle();
    let normals = file.accessor(&floats(&[0.0, 0.0, 1.0].repeat(3)), "VEC3", FLOAT, 3);
    let up =
        file.accessor(&floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0]), "VEC3", FLOAT, 3);
    let lean = file.accessor(&floats(&[1.0, 0.0, 0.0].repeat(3)), "VEC3", FLOAT, 3);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    file.primitive()["targets"] = json!([{"POSITION": up}, {"NORMAL": lean, "POSITION": lean}]);
    file
}

#[test]
fn morph_targets() {
    let mut file = morphing();
    // No weights: as stored.
    assert_near(&file.parts().shapes[0], &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    file.json["meshes"][0]["weights"] = json!([0.5, 0]);
    assert_near(&file.parts().shapes[0], &[[0.0, 0.0, 0.5], [1.0, 0.0, 1.0], [0.0, 1.0, 2.0]]);
    // A node's weights go before the mesh's, for that node.
    file.json["nodes"] = json!([{"mesh": 0, "weights": [0, 1]}, {"mesh": 0}]);
    file.json["scenes"][0]["nodes"] = json!([0, 1]);
    let parts = file.parts();
    assert_near(&parts.shapes[0], &[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    let [x, _, z] = parts.shapes[0].normals.as_ref().unwrap()[0];
    assert!((x - z).abs() < SINGLE_ROUNDING && x > 0.7);
    assert_near(&parts.shapes[1], &[[0.0, 0.0, 0.5], [1.0, 0.0, 1.0], [0.0, 1.0, 2.0]]);
}

#[test]
fn morph_targets_sparse_empty_and_short() {
    let mut file = morphing();
    file.json["meshes"][0]["weights"] = json!([1, 0]);
    let target = file.json["accessors"].as_array().unwrap().len() - 2;
    file.json["accessors"][target].as_object_mut().unwrap().remove("bufferView");
    assert_near(&file.parts().shapes[0], &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let (places, values) = (file.view(&[2]), file.view(&floats(&[0.0, 0.0, 3.0])));
    file.json["accessors"][target]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": places, "componentType": U8},
        "values": {"bufferView": values},
    });
    assert_near(&file.parts().shapes[0], &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 3.0]]);
    file.json["accessors"][target]["count"] = json!(4);
    let problems = file.read().expect_err("read");
    assert!(problems.0[0].place.ends_with("targets[0]"), "{problems}");
}

/// Three joints: one at rest, one lifted by 2, one turned about z by half a turn; vertex 0 follows the first,
/// vertex 1 the second, vertex 2 the second and third by halves.
fn skinned() -> File {
    let mut file = File::triangle();
    let joints = file.accessor(&[0, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0], "VEC4", U8, 3);
    let weights = floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0]);
    let weights = file.accessor(&weights, "VEC4", FLOAT, 3);
    let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let mut moved = identity;
    // The third joint is bound one metre up: brought back before it turns.
    moved[14] = -1.0;
    let matrices = file.accessor(&floats(&[identity, identity, moved].concat()), "MAT4", FLOAT, 3);
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.json["skins"] = json!([{"joints": [1, 2, 3], "inverseBindMatrices": matrices}]);
    // The place of the node itself is of no account.
    file.json["nodes"] = json!([
        {"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
        {"children": [2]}, {"translation": [0, 0, 2]}, {"rotation": [0, 0, 1, 0]},
    ]);
    file.json["scenes"][0]["nodes"] = json!([0, 1, 3]);
    file
}

#[test]
fn skin_at_rest() {
    let parts = skinned().parts();
    // Vertex 2: half of (0, 1, 2) and of the turned (0, -1, -1).
    assert_near(&parts.shapes[0], &[[0.0; 3], [1.0, 0.0, 2.0], [0.0, 0.0, 0.5]]);
    assert_eq!(parts.shapes[0].triangles, [[0, 1, 2]]);
}

/// Weights need not add up to one, may be integers, and may stand in a second set.
#[test]
fn weights_of_every_kind() {
    let mut file = skinned();
    let weights: Vec<u8> = [100_u16, 0, 0, 0, 100, 0, 0, 0, 30000, 30000, 0, 0]
        .iter()
        .flat_map(|w| w.to_le_bytes())
        .collect();
    let weights = file.accessor(&weights, "VEC4", U16, 3);
    file.json["accessors"][weights]["normalized"] = json!(true);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    assert_near(&file.parts().shapes[0], &[[0.0; 3], [1.0, 0.0, 2.0], [0.0, 0.0, 0.5]]);

    let mut file = skinned();
    let joints = file.accessor(&[1, 0, 0, 0].repeat(3), "VEC4", U8, 3);
    let weights = file.accessor(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(3)), "VEC4", FLOAT, 3);
    file.primitive()["attributes"]["JOINTS_1"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_1"] = json!(weights);
    assert_near(&file.parts().shapes[0], &[[0.0, 0.0, 1.0], [1.0, 0.0, 2.0], [0.0, 0.5, 1.25]]);
}

/// A joint that mirrors turns triangles inside out; they are turned back.
#[test]
fn mirrored_joints() {
    let mut file = skinned();
    for joint in [1, 2, 3] {
        file.json["nodes"][joint] = json!({"scale": [-1, 1, 1]});
    }
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3]);
    let shape = file.parts().shapes.remove(0);
    assert_near(&shape, &[[0.0; 3], [-1.0, 0.0, 0.0], [0.0, 1.0, -0.5]]);
    assert_eq!(shape.triangles, [[0, 2, 1]]);
}

#[test]
fn skins_that_cannot_be_read() {
    type Change = fn(&mut File);
    let table: [(&str, Change, &str); 5] = [
        ("no skin", |f| f.json["nodes"][0]["skin"] = json!(4), "nodes[0].skin"),
        (
            "outside the scene",
            |f| f.json["scenes"][0]["nodes"] = json!([0, 1]),
            "skins[0].joints[2]",
        ),
        (
            "too few matrices",
            |f| f.json["accessors"][3]["count"] = json!(2),
            "skins[0].inverseBindMatrices",
        ),
        ("vectors", |f| f.json["skins"][0]["inverseBindMatrices"] = json!(0), "accessors[0]"),
        (
            "joint 2 of 2",
            |f| f.json["skins"][0]["joints"] = json!([1, 2]),
            "primitives[0].attributes",
        ),
    ];
    for (name, change, place) in table {
        let mut file = skinned();
        change(&mut file);
        let problems = file.read().expect_err(name);
        assert!(problems.0[0].place.contains(place), "{name}: {problems}");
    }
    let mut file = skinned();
    file.primitive()["attributes"].as_object_mut().unwrap().remove("WEIGHTS_0");
    assert_warns(&file.load(), "meshes[0].primitives[0]", "without JOINTS_0");
}

#[test]
fn hidden_nodes() {
    let mut file = File::triangle();
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    file.json["nodes"] = json!([
        {"name": "shown", "mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}},
        {"children": [2], "extensions": hidden}, {"mesh": 0},
    ]);
    file.json["scenes"][0]["nodes"] = json!([0, 1]);
    let loaded = file.load();
    assert_warns(&loaded, "nodes[1]", "hidden");
    let names: Vec<&str> = loaded.value.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["shown"]);
}
