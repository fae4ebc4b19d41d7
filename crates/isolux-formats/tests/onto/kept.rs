//! What stays, stays as it is.

use crate::build::{FLOAT, File, I8, floats};
use crate::grafted::{Glb, number};
use crate::light::{ONE_PAGE, lit};
use crate::scene;
use isolux_formats::gltf;
use isolux_formats::lightmap::Target;
use serde_json::{Value, json};

/// The part that was read, with what was written.
fn both() -> (Value, Glb) {
    let file = scene::file();
    let glb = lit(&file, Target::Three, ONE_PAGE);
    (file.json, glb)
}

#[test]
fn all_but_meshes_materials_and_data_is_the_same() {
    let (old, new) = both();
    for key in ["asset", "scene", "scenes", "cameras", "animations", "extensions"] {
        assert_eq!(new.json[key], old[key], "{key}");
    }
    assert_eq!(new.json["extras"]["made"], "by hand");
    assert_eq!(new.json["extras"]["isolux_lightmap"]["onto"], "scene.glb");
    // Lists go on behind what was there.
    for key in ["samplers", "textures"] {
        let [old, new] = [&old[key], &new.json[key]].map(|list| list.as_array().unwrap());
        assert_eq!(&new[..old.len()], &old[..], "{key}");
    }
    let [old_nodes, new_nodes] =
        [&old["nodes"], &new.json["nodes"]].map(|list| list.as_array().unwrap());
    for (old, new) in old_nodes.iter().zip(new_nodes) {
        for member in ["name", "translation", "rotation", "scale", "extras", "camera", "matrix"] {
            assert_eq!(new.get(member), old.get(member), "{member} of {old}");
        }
    }
    assert_eq!(new.node("room")["children"], json!([1, 2, 3, 4, 5, 6]));
    assert_eq!(
        new.view(&new.json["images"][0]["bufferView"]),
        &crate::build::png(&[[200, 120, 60], [90, 60, 30]])
    );
}

#[test]
fn materials_get_a_lightmap_beside_all_they_have() {
    let (old, new) = both();
    for (index, old) in old["materials"].as_array().unwrap().iter().enumerate() {
        let mut new = new.json["materials"][index].clone();
        let name = old["name"].as_str().unwrap();
        // Wood and paint are those of a panel in another scene, too, glass carries no map.
        let is_lit = name == "cloth";
        let light =
            new.get_mut("extensions").and_then(|e| e.as_object_mut()?.remove("MOZ_lightmap"));
        assert_eq!(light.is_some(), is_lit, "{name}");
        let mut expected = old.clone();
        if is_lit {
            expected["extensions"] = json!({});
            // Its back has light of its own.
            expected["doubleSided"] = json!(false);
            assert_eq!(light.unwrap()["texCoord"], 2);
        }
        assert_eq!(new, expected);
    }
    let wood = new.mesh_of("left")["primitives"][0]["material"].clone();
    let mut wood = new.json["materials"][number(&wood)].clone();
    // The second set is that of the occlusion of the cloth; a page has one in three.js.
    assert_eq!(wood["extensions"]["MOZ_lightmap"]["texCoord"], 2);
    wood.as_object_mut().unwrap().remove("extensions");
    assert_eq!(wood, old["materials"][0]);
    assert!(new.json["extensionsUsed"].as_array().unwrap().contains(&json!("MOZ_lightmap")));
}

#[test]
fn meshes_are_one_for_every_place_and_those_in_the_dark_stay() {
    let (old, new) = both();
    assert_eq!(new.mesh_of("elsewhere"), &old["meshes"][0]);
    assert_ne!(new.node("left")["mesh"], new.node("right")["mesh"]);
    for side in ["left", "right"] {
        let mesh = new.mesh_of(side);
        assert_eq!(mesh["name"], "panel");
        assert_eq!(mesh["weights"], json!([0.0]));
        assert_eq!(mesh["extras"], json!({"targetNames": ["lift"]}));
        let [wood, pane] = [0, 1].map(|k| &mesh["primitives"][k]);
        assert_eq!(wood["extras"], json!({"part": 1}));
        assert_eq!(pane, &old["meshes"][0]["primitives"][1]);
        assert_eq!(new.numbers(&wood["targets"][0]["POSITION"]), [[0.0, 0.5, 0.0]; 4]);
        // Painted it has the same light.
        let painted = &wood["extensions"]["KHR_materials_variants"]["mappings"][0];
        let painted = &new.json["materials"][number(&painted["material"])];
        assert_eq!(painted["name"], "paint");
        assert!(painted["extensions"]["MOZ_lightmap"].is_object());
    }
}

#[test]
fn vertices_keep_what_they_carry_in_its_type() {
    let (old, new) = both();
    let old = Glb::of(&{
        let mut file = scene::file();
        file.json = old;
        file.glb()
    });
    let square = &old.json["meshes"][0]["primitives"][0]["attributes"];
    let mut checked = 0;
    for name in ["left", "right", "cloth", "stools[0]", "stools[1]", "stools[2]"] {
        for (part, primitive) in
            new.mesh_of(name)["primitives"].as_array().unwrap().iter().enumerate()
        {
            let is_back = name == "cloth" && part == 1;
            let attributes = primitive["attributes"].as_object().unwrap();
            let numbers = new.numbers(&attributes["_NUMBER"]);
            for (attribute, accessor) in attributes.iter().filter(|(a, _)| square.get(*a).is_some())
            {
                let source = &square[attribute];
                let [stored, meant] = [
                    &new.json["accessors"][number(accessor)],
                    &old.json["accessors"][number(source)],
                ];
                // The lightmap is a first set where there was none.
                if attribute == "TEXCOORD_0" && name.starts_with("stools") {
                    continue;
                }
                for member in ["type", "componentType", "normalized", "name"] {
                    assert_eq!(stored.get(member), meant.get(member), "{member} of {attribute}");
                }
                let (found, expected) = (new.numbers(accessor), old.numbers(source));
                for (vertex, value) in found.iter().enumerate() {
                    let mut expected = expected[numbers[vertex][0] as usize].clone();
                    if is_back && matches!(attribute.as_str(), "NORMAL" | "TANGENT") {
                        expected.iter_mut().for_each(|c| *c = -*c);
                    }
                    assert_eq!(value, &expected, "{attribute} of {name}");
                    checked += 1;
                }
            }
        }
    }
    // Panels with their panes, both sides of the cloth, stools.
    assert_eq!(checked, 4 * (4 * 6 + 2 * 6 + 3 * 3));
}

/// Nothing that is replaced stays in the file as dead weight.
#[test]
fn what_was_replaced_is_gone() {
    let mut file = File::triangle();
    file.primitive()["attributes"]["_TEMPERATURE"] = json!(0);
    let temperatures = file.accessor(&floats(&[1.5, 2.5, 3.5]), "SCALAR", FLOAT, 3);
    file.primitive()["attributes"]["_TEMPERATURE"] = json!(temperatures);
    let glb = lit(&file, Target::Bevy, ONE_PAGE);
    let used = glb.json["accessors"].as_array().unwrap().len();
    // Places, temperatures, lightmap, corners.
    assert_eq!(used, 4);
    assert_eq!(glb.json["bufferViews"].as_array().unwrap().len(), 5);
    let primitive = &glb.json["meshes"][0]["primitives"][0];
    assert_eq!(primitive["attributes"]["TEXCOORD_0"], primitive["attributes"]["TEXCOORD_1"]);
    let mut found = glb.numbers(&primitive["attributes"]["_TEMPERATURE"]).concat();
    found.sort_by(f64::total_cmp);
    assert_eq!(found, [1.5, 2.5, 3.5]);
}

/// Normals in eight bits, in elements of four bytes, and the least of them, which has no opposite.
#[test]
fn quantized_normals_of_backs_are_turned() {
    let mut file = File::triangle();
    let normal = file.accessor(&[0, 0, 127, 0, 1, 255, 128, 0, 0, 0, 127, 0], "VEC3", I8, 3);
    file.json["accessors"][normal]["normalized"] = json!(true);
    let view = number(&file.json["accessors"][normal]["bufferView"]);
    file.json["bufferViews"][view]["byteStride"] = json!(4);
    file.primitive()["attributes"]["NORMAL"] = json!(normal);
    file.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    file.json["materials"][0]["doubleSided"] = json!(true);
    let glb = lit(&file, Target::Three, ONE_PAGE);
    let primitives = glb.json["meshes"][0]["primitives"].as_array().unwrap();
    let normals = |k: usize| {
        let mut all = glb.numbers(&primitives[k]["attributes"]["NORMAL"]);
        all.sort_by(|a: &Vec<f64>, b| a[0].total_cmp(&b[0]).then(a[2].total_cmp(&b[2])));
        all
    };
    assert_eq!(normals(0), [[0.0, 0.0, 127.0], [0.0, 0.0, 127.0], [1.0, -1.0, -128.0]]);
    assert_eq!(normals(1), [[-1.0, 1.0, 127.0], [0.0, 0.0, -127.0], [0.0, 0.0, -127.0]]);
}

/// What isolux reads of the new file is what it read of the old, its places in the lightmap besides.
#[test]
fn the_file_is_still_the_scene_that_it_was() {
    let mut file = scene::file();
    // A back would be a surface of its own.
    file.json["materials"][1]["doubleSided"] = json!(false);
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("scene.glb");
    std::fs::write(&path, file.glb()).unwrap();
    let old = gltf::read(&path).unwrap().value;
    let light = crate::written::Lit::of(&path, ONE_PAGE);
    let options = isolux_formats::onto::Options::default();
    let (bytes, _) = light.onto(&path, (Target::Three, options)).unwrap();
    let again = home.path().join("again.glb");
    std::fs::write(&again, &bytes).unwrap();
    let new = gltf::read(&again).unwrap().value;
    assert_eq!(new.luminaires, old.luminaires);
    assert_eq!(new.cameras, old.cameras);
    assert_eq!(new.textures, old.textures);
    let mut names: [Vec<&str>; 2] =
        [&old, &new].map(|parts| parts.shapes.iter().map(|s| s.name.as_str()).collect());
    names.iter_mut().for_each(|names| names.sort_unstable());
    assert_eq!(names[0], names[1]);
    for shape in &old.shapes {
        let found = new.shapes.iter().find(|s| s.name == shape.name).unwrap();
        let bodies =
            [(&old, shape), (&new, found)].map(|(parts, s)| &parts.materials[s.material as usize]);
        assert_eq!(bodies[0], bodies[1], "{}", shape.name);
        let corners = |s: &isolux::scene::Shape| -> Vec<[f64; 3]> {
            s.triangles.iter().flatten().map(|&v| s.positions[v as usize]).collect()
        };
        assert_eq!(corners(shape), corners(found), "{}", shape.name);
    }
    // It can be solved, and light goes onto it, once more.
    let light = crate::written::Lit::of(&again, ONE_PAGE);
    let (twice, _) = light.onto(&again, (Target::Three, options)).unwrap();
    assert_eq!(Glb::of(&twice).check_light(1.0), 2 * (2 + 1 + 3));
}
