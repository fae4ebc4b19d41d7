//! Parts that may be absent are absent, and parts that are not read say anything: neither refuses a file.

use crate::build::{FLOAT, File, U16, floats, png, push};
use serde_json::{Value, json};

/// A file that uses every kind of object, with every property that glTF 2.0 calls optional.
#[expect(clippy::too_many_lines, reason = "a file, member by member")]
fn full() -> File {
    let mut file = File::triangle();
    let picture = file.view(&png(&[[200; 3]]));
    let uvs = file.accessor(&floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]), "VEC2", FLOAT, 3);
    let index_bytes: Vec<u8> = [0_u16, 1, 2].iter().flat_map(|k| k.to_le_bytes()).collect();
    let indices = file.accessor(&index_bytes, "SCALAR", U16, 3);
    let joints = file.accessor(&[0; 24], "VEC4", U16, 3);
    let weights = file.accessor(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(3)), "VEC4", FLOAT, 3);
    let still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1].map(|c| c as f32);
    let bind = file.accessor(&floats(&still), "MAT4", FLOAT, 1);
    let moved = file.accessor(&floats(&[0.0; 9]), "VEC3", FLOAT, 3);
    let json = &mut file.json;
    json["asset"] =
        json!({"version": "2.0", "minVersion": "2.0", "copyright": "", "generator": "test"});
    json["buffers"][0]["name"] = json!("b");
    for (list, members) in [
        ("bufferViews", json!({"name": "v", "target": 34962, "byteOffset": 0})),
        ("accessors", json!({"name": "a", "byteOffset": 0, "normalized": false, "min": [0, 0, 0]})),
    ] {
        for (key, value) in members.as_object().unwrap() {
            if !(list == "bufferViews" && key == "byteOffset") {
                json[list][0][key] = value.clone();
            }
        }
    }
    json["images"] = json!([{"bufferView": picture, "mimeType": "image/png", "name": "i"}]);
    json["samplers"] = json!([
        {"magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497, "name": "s"},
    ]);
    json["textures"] = json!([{"source": 0, "sampler": 0, "name": "t"}]);
    let of_texture = json!({"index": 0, "texCoord": 0, "extras": {}, "extensions": {}});
    json["materials"] = json!([{
        "name": "m", "doubleSided": true, "alphaMode": "OPAQUE", "emissiveFactor": [0, 0, 0],
        "emissiveTexture": of_texture, "normalTexture": {"index": 0, "scale": 1, "texCoord": 0},
        "occlusionTexture": {"index": 0, "strength": 1, "texCoord": 0},
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 1,
            "baseColorTexture": of_texture, "metallicRoughnessTexture": of_texture,
        },
    }]);
    json["meshes"] = json!([{
        "name": "mesh", "weights": [0],
        "primitives": [{
            "attributes": {"POSITION": 0, "TEXCOORD_0": uvs, "JOINTS_0": joints, "WEIGHTS_0": weights},
            "indices": indices, "material": 0, "mode": 4, "targets": [{"POSITION": moved}],
        }],
    }]);
    json["cameras"] = json!([
        {"type": "perspective", "name": "c",
         "perspective": {"yfov": 1, "znear": 0.1, "zfar": 9, "aspectRatio": 1}},
        {"type": "orthographic",
         "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 0}},
    ]);
    json["skins"] = json!([
        {"joints": [1], "inverseBindMatrices": bind, "skeleton": 1, "name": "skin"},
    ]);
    json["nodes"] = json!([
        {"name": "n", "mesh": 0, "skin": 0, "weights": [0], "translation": [0, 0, 0],
         "rotation": [0, 0, 0, 1], "scale": [1, 1, 1], "children": [2]},
        {"name": "joint", "matrix": still},
        {"camera": 0}, {"camera": 1},
    ]);
    json["scenes"] = json!([{"name": "one", "nodes": [0, 1, 3]}, {"nodes": []}]);
    json["animations"] = json!([{
        "name": "a", "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}],
        "samplers": [{"input": 0, "output": 0, "interpolation": "LINEAR"}],
    }]);
    json["extensionsUsed"] = json!(["X_of_nobody"]);
    json["extensionsRequired"] = json!([]);
    file
}

/// Members that glTF 2.0 requires, by the list or member that holds them.
const REQUIRED: &[(&str, &[&str])] = &[
    ("", &["asset"]),
    ("asset", &["version"]),
    ("accessors", &["componentType", "count", "type"]),
    ("bufferViews", &["buffer", "byteLength", "byteOffset"]),
    ("buffers", &["byteLength"]),
    ("cameras", &["type"]),
    ("perspective", &["yfov", "znear"]),
    ("orthographic", &["xmag", "ymag", "zfar", "znear"]),
    ("channels", &["sampler", "target"]),
    ("target", &["path"]),
    ("animations", &["channels", "samplers"]),
    ("samplers", &["input", "output"]),
    ("skins", &["joints"]),
    ("meshes", &["primitives"]),
    ("primitives", &["attributes"]),
    ("attributes", &["POSITION", "JOINTS_0", "WEIGHTS_0"]),
    ("targets", &["POSITION"]),
];
/// References that leave nothing where they are, or that others refer to by number.
const REFERRED: &[&str] = &[
    "accessors",
    "bufferView",
    "bufferViews",
    "buffers",
    "cameras",
    "images",
    "index",
    "materials",
    "meshes",
    "nodes",
    "perspective",
    "samplers",
    "scenes",
    "skins",
    "targets",
    "textures",
    "indices",
    "TEXCOORD_0",
    "mesh",
    "source",
];

/// Pointers to every member of an object, with the name of what holds it.
fn members(value: &Value, pointer: &str, holder: &str, into: &mut Vec<(String, String, String)>) {
    match value {
        Value::Object(object) => {
            for (key, inner) in object {
                into.push((pointer.to_owned(), holder.to_owned(), key.clone()));
                members(inner, &format!("{pointer}/{key}"), key, into);
            }
        }
        Value::Array(list) => {
            for (k, inner) in list.iter().enumerate() {
                members(inner, &format!("{pointer}/{k}"), holder, into);
            }
        }
        _ => {}
    }
}

#[test]
fn every_optional_property_may_be_absent() {
    let file = full();
    file.load();
    let mut all = Vec::new();
    members(&file.json, "", "", &mut all);
    let mut tried = 0;
    for (pointer, holder, key) in all {
        let is_required = REQUIRED.iter().any(|(h, keys)| *h == holder && keys.contains(&&*key));
        if is_required || REFERRED.contains(&&*key) {
            continue;
        }
        let mut changed = file.clone();
        let object = changed.json.pointer_mut(&pointer).unwrap();
        object.as_object_mut().unwrap().remove(&key);
        if let Err(problems) = changed.read() {
            panic!("without {pointer}/{key}: {problems}");
        }
        tried += 1;
    }
    assert!(tried > 70, "{tried}");
}

#[test]
fn what_is_not_read_may_say_anything() {
    let odd =
        [json!([1, 2]), json!("text"), json!(7.5), json!(null), json!({"isolux": 1}), json!(true)];
    let file = full();
    let lists = [
        "accessors",
        "bufferViews",
        "cameras",
        "images",
        "materials",
        "meshes",
        "nodes",
        "samplers",
        "scenes",
        "skins",
        "textures",
        "animations",
        "buffers",
    ];
    for value in &odd {
        let mut changed = file.clone();
        for list in lists {
            changed.json[list][0]["extras"] = value.clone();
            changed.json[list][0]["extensions"] = json!({"X_of_nobody": value});
            changed.json[list][0]["member of nobody"] = value.clone();
        }
        changed.json["asset"]["extras"] = value.clone();
        changed.json["meshes"][0]["primitives"][0]["extras"] = value.clone();
        changed.json["materials"][0]["pbrMetallicRoughness"]["extras"] = value.clone();
        if value.get("isolux").is_none() {
            changed.json["extras"] = value.clone();
        }
        changed.json["animations"] = json!([value]);
        changed.load();
    }
}

type Change = fn(&mut Value);

#[test]
fn odd_parts_that_are_not_read() {
    let table: &[(&str, Change)] = &[
        ("a second scene without nodes", |json| json["scenes"][1] = json!({})),
        ("a channel without a target node", |json| {
            json["animations"][0]["channels"][0]["target"] = json!({"path": "scale"});
        }),
        ("a channel of a pointer", |json| {
            json["animations"][0]["channels"][0]["target"] = json!({"path": "pointer", "extensions":
                {"KHR_animation_pointer": {"pointer": "/nodes/0/rotation"}}});
        }),
        ("an orthographic camera without sides", |json| {
            json["cameras"][1]["orthographic"] = json!({});
        }),
        ("a camera that no node uses", |json| {
            push(&mut json["cameras"], json!({}));
        }),
        ("a skin that no node uses", |json| {
            push(&mut json["skins"], json!({}));
        }),
        ("a normal map without a picture", |json| {
            json["materials"][0]["normalTexture"] = json!({"scale": "large"});
        }),
        ("names that are numbers", |json| json["nodes"][0]["name"] = json!(5)),
        ("asset of numbers", |json| json["asset"]["generator"] = json!(5)),
        ("members that are null", |json| json["nodes"][0]["children"] = json!(null)),
        ("whole numbers as fractions", |json| {
            json["accessors"][0]["count"] = json!(3.0);
            json["nodes"][0]["mesh"] = json!(0.0);
            json["meshes"][0]["primitives"][0]["mode"] = json!(4.0);
        }),
        ("an unknown extension with a large index", |json| {
            json["nodes"][0]["extensions"] = json!({"X_of_nobody": {"index": 1_u64 << 40}});
        }),
    ];
    for (what, change) in table {
        let mut file = full();
        change(&mut file.json);
        if let Err(problems) = file.read() {
            panic!("{what}: {problems}");
        }
    }
}

/// Files that require what light at rest knows nothing of were refused.
#[test]
fn extensions_of_no_light_may_be_required() {
    for name in ["KHR_animation_pointer", "KHR_materials_variants", "EXT_structural_metadata"] {
        let mut file = File::triangle();
        file.json["extensionsUsed"] = json!([name]);
        file.json["extensionsRequired"] = json!([name]);
        let loaded = file.load();
        assert!(loaded.warnings[0].what.contains(name), "{:?}", loaded.warnings);
    }
}

#[test]
fn what_is_read_is_still_checked_beside_odd_parts() {
    let mut file = full();
    file.json["scenes"][1] = json!({});
    file.json["nodes"][0]["scale"] = json!([1, 1e39, 1]);
    let problems = file.read().unwrap_err();
    assert_eq!(problems.0[0].place, "nodes[0]");
    assert!(problems.0[0].what.contains("out of range"), "{problems}");
}
