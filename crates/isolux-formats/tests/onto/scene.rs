//! A file with all that should come through.

use crate::build::{FLOAT, File, U8, U16, floats, png, push};
use serde_json::{Value, json};

/// Positions, normals and other attributes of a square metre in the plane y = 0, seen from above.
pub(crate) fn square(file: &mut File) -> Value {
    let positions = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let uvs = [[0_u16, 0], [0, 65535], [65535, 65535], [65535, 0]];
    let uvs: Vec<u8> = uvs.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    let tangents = [1.0, 0.0, 0.0, 1.0_f32].repeat(4);
    let accessor = |file: &mut File, bytes: &[u8], kind, of| file.accessor(bytes, kind, of, 4);
    let position = accessor(file, &floats(positions.as_flattened()), "VEC3", FLOAT);
    file.json["accessors"][position]["name"] = json!("places");
    let normal = accessor(file, &floats(&[0.0, 1.0, 0.0].repeat(4)), "VEC3", FLOAT);
    let tangent = accessor(file, &floats(&tangents), "VEC4", FLOAT);
    let uv = accessor(file, &uvs, "VEC2", U16);
    file.json["accessors"][uv]["normalized"] = json!(true);
    let colour = accessor(file, &[255; 16], "VEC4", U8);
    file.json["accessors"][colour]["normalized"] = json!(true);
    // Numbers of the vertices, two bytes of every four.
    let number = accessor(file, &[0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0], "SCALAR", U16);
    let view = file.json["accessors"][number]["bufferView"].as_u64().unwrap() as usize;
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    json!({
        "POSITION": position, "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": uv, "COLOR_0": colour,
        "_NUMBER": number,
    })
}

fn textures(file: &mut File) {
    let view = file.view(&png(&[[200, 120, 60], [90, 60, 30]]));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png", "name": "boards"}]);
    file.json["samplers"] = json!([{"magFilter": 9728}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0, "name": "boards"}]);
}

fn materials() -> Value {
    json!([
        {
            "name": "wood",
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0},
            "normalTexture": {"index": 0, "scale": 0.5},
            "extras": {"of": "oak"},
        },
        {
            "name": "cloth",
            "doubleSided": true,
            "alphaMode": "MASK",
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0},
            "occlusionTexture": {"index": 0, "texCoord": 1},
        },
        {
            "name": "glass",
            "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
            "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}},
        },
        {"name": "paint", "pbrMetallicRoughness": {"metallicFactor": 0}},
    ])
}

/// Panels with a pane, one of them turned into its mirror image, a cloth, and stools that are copies; one more panel in
/// another scene.
pub(crate) fn file() -> File {
    let mut file = File::empty();
    textures(&mut file);
    file.json["materials"] = materials();
    let square_of = square(&mut file);
    let short = |corners: [u16; 6]| corners.map(u16::to_le_bytes).concat();
    let indices = file.accessor(&short([0, 1, 2, 0, 2, 3]), "SCALAR", U16, 6);
    let lifted = file.accessor(&floats(&[0.0, 0.5, 0.0].repeat(4)), "VEC3", FLOAT, 4);
    for (accessor, height) in [(square_of["POSITION"].as_u64().unwrap(), 0.0), (lifted as u64, 0.5)]
    {
        let most = if height > 0.0 { [0.0, height, 0.0] } else { [1.0, 0.0, 1.0] };
        let accessor = &mut file.json["accessors"][accessor as usize];
        accessor["min"] = json!([0.0, height, 0.0]);
        accessor["max"] = json!(most);
    }
    let mut of_cloth = square_of.clone();
    of_cloth["TEXCOORD_1"] = of_cloth["TEXCOORD_0"].clone();
    // A strip of two triangles: 0 1 3, 3 1 2.
    let strip = file.accessor(&[0, 1, 3, 2], "SCALAR", U8, 4);
    let variants =
        json!({"KHR_materials_variants": {"mappings": [{"material": 3, "variants": [0]}]}});
    let (wood, pane) = (square_of.clone(), square_of);
    file.json["meshes"] = json!([
        {
            "name": "panel", "weights": [0.0], "extras": {"targetNames": ["lift"]},
            "primitives": [
                {
                    "attributes": wood, "indices": indices, "material": 0, "extras": {"part": 1},
                    "targets": [{"POSITION": lifted}], "extensions": variants,
                },
                {"attributes": pane, "indices": indices, "material": 2, "targets": [{"POSITION": lifted}]},
            ],
        },
        {"name": "cloth", "primitives": [
            {"attributes": of_cloth, "indices": strip, "mode": 5, "material": 1},
        ]},
        {"name": "stool", "primitives": [
            {"attributes": {"POSITION": 0, "NORMAL": 1, "_NUMBER": 5}, "indices": indices, "material": 3},
        ]},
    ]);
    nodes(&mut file);
    file
}

fn nodes(file: &mut File) {
    let places =
        file.accessor(&floats(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0, 0.0, 1.0]), "VEC3", FLOAT, 3);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let copies = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}});
    file.json["cameras"] =
        json!([{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.1}}]);
    file.json["nodes"] = json!([
        {"name": "room", "children": [1, 2, 3, 4, 5, 6], "extras": {"floor": 2}},
        {"name": "left", "mesh": 0, "translation": [-1.5, 0, 0]},
        {"name": "right", "mesh": 0, "translation": [2, 1, 0], "rotation": [half, 0, 0, half], "scale": [-1, 2, 1]},
        {"name": "cloth", "mesh": 1, "translation": [0, 2, 0]},
        {"name": "stools", "mesh": 2, "translation": [0, -1, 3], "extensions": copies},
        {"name": "lamp", "translation": [0, 9, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        {"name": "view", "camera": 0, "translation": [0, 5, 9]},
        {"name": "elsewhere", "mesh": 0},
    ]);
    file.json["scenes"] = json!([{"name": "here", "nodes": [0]}, {"name": "there", "nodes": [7]}]);
    file.json["scene"] = json!(0);
    let times = file.accessor(&floats(&[0.0, 1.0]), "SCALAR", FLOAT, 2);
    file.json["accessors"][times]["min"] = json!([0.0]);
    file.json["accessors"][times]["max"] = json!([1.0]);
    let moves = file.accessor(&floats(&[0.0, 9.0, 0.0, 0.0, 9.0, 1.0]), "VEC3", FLOAT, 2);
    file.json["animations"] = json!([{
        "name": "swing", "samplers": [{"input": times, "output": moves}],
        "channels": [{"sampler": 0, "target": {"node": 5, "path": "translation"}}],
    }]);
    // Dim, so that all light is that of the map.
    let lamp = json!({"type": "point", "intensity": 1e-9, "name": "bulb"});
    file.json["extensions"] = json!({
        "KHR_lights_punctual": {"lights": [lamp]},
        "KHR_materials_variants": {"variants": [{"name": "painted"}]},
    });
    file.json["extensionsUsed"] = json!([
        "KHR_lights_punctual",
        "KHR_materials_variants",
        "KHR_materials_transmission",
        "EXT_mesh_gpu_instancing",
    ]);
    file.json["extras"] = json!({"made": "by hand"});
    push(&mut file.json["samplers"], json!({"name": "used by nothing"}));
}
