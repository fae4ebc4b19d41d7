//! Geometry, nodes, cameras, and where the bytes come from.

use crate::build::{FLOAT, File, I8, I16, U8, U16, U32, assert_warns, floats, push, read_in};
use isolux::geometry::{Point, Triangle, Vector};
use isolux::scene::{Scene, Shape, UpAxis};
use serde_json::json;

/// Half a unit in the last place of numbers up to two, thrice over: sums of three products.
const ROUNDING: f64 = 1e-15;
/// `f32` numbers in the file: angles and quaternions are only so good.
const SINGLE_ROUNDING: f64 = 1e-6;

fn normal_of(shape: &Shape, triangle: usize) -> Vector {
    let corners = shape.triangles[triangle].map(|v| Point::from(shape.positions[v as usize]));
    Triangle { corners }.normal().unwrap().to_vector()
}

#[track_caller]
fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let far = found.iter().zip(expected).any(|(a, b)| (a - b).abs() > tolerance);
    assert!(!far, "{found:?} is not {expected:?}");
}

#[test]
fn one_triangle() {
    let parts = File::triangle().parts();
    let shape = &parts.shapes[0];
    assert_eq!(shape.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(shape.triangles, [[0, 1, 2]]);
    assert_eq!((&shape.normals, &shape.uvs), (&None, &None));
    assert_eq!((shape.name.as_str(), parts.materials[0].name.as_str()), ("node 0", "material 0"));
    assert_eq!((parts.name.as_str(), parts.up), ("scene", UpAxis::Y));
    Scene::assemble(parts).unwrap();
}

#[test]
fn index_types() {
    let corners: [u32; 3] = [2, 0, 1];
    let bytes = |size: usize| -> Vec<u8> {
        corners.iter().flat_map(|c| c.to_le_bytes()[..size].to_vec()).collect()
    };
    for (component, size) in [(U8, 1), (U16, 2), (U32, 4)] {
        let mut file = File::triangle();
        let indices = file.accessor(&bytes(size), "SCALAR", component, 3);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(file.shape().triangles, [corners]);
    }
}

#[test]
fn strips_fans_points() {
    let square = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    let mut file = File::triangle();
    let positions = file.accessor(&square, "VEC3", FLOAT, 4);
    file.primitive()["attributes"]["POSITION"] = json!(positions);
    file.primitive()["mode"] = json!(5);
    let strip = file.shape();
    assert_eq!(strip.triangles.len(), 2);
    assert_eq!([normal_of(&strip, 0).z, normal_of(&strip, 1).z], [1.0, 1.0]);
    file.primitive()["mode"] = json!(6);
    assert_eq!(file.shape().triangles, [[1, 2, 0], [2, 3, 0]]);
    file.primitive()["mode"] = json!(4);
    let loaded = file.load();
    assert_eq!(loaded.value.shapes[0].triangles, [[0, 1, 2]]);
    assert_warns(&loaded, "meshes[0].primitives[0]", "too few corners");
    for mode in 0..4 {
        file.primitive()["mode"] = json!(mode);
        let loaded = file.load();
        assert_eq!(loaded.value.shapes, []);
        assert_warns(&loaded, "meshes[0].primitives[0]", "points and lines");
    }
}

#[test]
fn interleaved_with_offsets() {
    let mut file = File::triangle();
    // Four bytes of something else, then position and normal of each vertex.
    let mut data = floats(&[9.0]);
    for p in [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0_f32]] {
        data.extend(floats(&p));
        data.extend(floats(&[0.0, 0.0, 1.0]));
    }
    let positions = file.accessor(&data, "VEC3", FLOAT, 3);
    file.json["bufferViews"][1]["byteStride"] = json!(24);
    file.json["accessors"][positions]["byteOffset"] = json!(4);
    let mut normal = file.json["accessors"][positions].clone();
    normal["byteOffset"] = json!(16);
    let normals = push(&mut file.json["accessors"], normal);
    file.primitive()["attributes"] = json!({"POSITION": positions, "NORMAL": normals});
    let shape = file.shape();
    assert_eq!(shape.positions[1..], [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    assert_eq!(shape.normals.unwrap(), [[0.0, 0.0, 1.0]; 3]);
}

#[test]
fn sparse_positions() {
    let mut file = File::triangle();
    let indices = file.view(&[1, 0, 2, 0]);
    let values = file.view(&floats(&[5.0, 0.0, 0.0, 0.0, 7.0, 0.0]));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": indices, "componentType": U16},
        "values": {"bufferView": values},
    });
    assert_eq!(file.shape().positions, [[0.0; 3], [5.0, 0.0, 0.0], [0.0, 7.0, 0.0]]);
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(file.shape().positions, [[0.0; 3], [5.0, 0.0, 0.0], [0.0, 7.0, 0.0]]);
}

#[test]
fn quantized() {
    let mut file = File::triangle();
    let i16s = |list: &[i16]| -> Vec<u8> { list.iter().flat_map(|v| v.to_le_bytes()).collect() };
    let positions = i16s(&[0, 0, 0, 32767, 0, 0, 0, -32768, 0]);
    let positions = file.accessor(&positions, "VEC3", I16, 3);
    file.json["accessors"][positions]["normalized"] = json!(true);
    let normals = file.accessor(&[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0], "VEC3", I8, 3);
    file.json["accessors"][normals]["normalized"] = json!(true);
    file.json["bufferViews"][2]["byteStride"] = json!(4);
    file.primitive()["attributes"] = json!({"POSITION": positions, "NORMAL": normals});
    assert!(file.read().is_err());
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let shape = file.shape();
    assert_eq!(shape.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]);
    assert_eq!(shape.normals.unwrap(), [[0.0, 0.0, 1.0]; 3]);
    file.json["accessors"][positions]["normalized"] = json!(false);
    assert_eq!(file.shape().positions[2], [0.0, -32768.0, 0.0]);
}

#[test]
fn translation_rotation_scale() {
    let mut file = File::triangle();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // A quarter turn about z; the quaternion is three times too long.
    file.json["nodes"][0] = json!({
        "mesh": 0, "translation": [10, 0, 0], "rotation": [0, 0, 3.0 * half, 3.0 * half],
        "scale": [2, 1, 1],
    });
    let shape = file.shape();
    assert_near(shape.positions[1], [10.0, 2.0, 0.0], 10.0 * ROUNDING);
    assert_near(shape.positions[2], [9.0, 0.0, 0.0], 10.0 * ROUNDING);
}

#[test]
fn matrices_of_parents_come_first() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([
        {"children": [1], "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]},
        {"mesh": 0, "translation": [1, 0, 0]},
    ]);
    let shape = file.shape();
    assert_eq!(shape.positions, [[5.0, 1.0, 0.0], [5.0, 2.0, 0.0], [4.0, 1.0, 0.0]]);
    assert_eq!(shape.name, "node 1");
}

#[test]
fn instances_and_mirror_images() {
    let mut file = File::triangle();
    let normals = file.accessor(&floats(&[0.0, 0.6, 0.8].repeat(3)), "VEC3", FLOAT, 3);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    file.json["meshes"][0]["name"] = json!("sail");
    file.json["nodes"] = json!([
        {"mesh": 0},
        {"mesh": 0, "scale": [-1, 1, 1], "name": "mirrored"},
        {"mesh": 0, "scale": [1, 2, 1]},
    ]);
    file.json["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let parts = file.parts();
    let names: Vec<&str> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["sail", "mirrored", "sail"]);
    for shape in &parts.shapes {
        assert_eq!(normal_of(shape, 0).z, 1.0, "{}", shape.name);
        let shading = shape.normals.as_ref().unwrap()[0];
        assert!(shading[2] > 0.0 && shading[1] > 0.0, "{}", shape.name);
    }
    assert_eq!(parts.shapes[1].positions[1], [-1.0, 0.0, 0.0]);
    // By the inverse transpose: (0, 0.6 / 2, 0.8) made of length one.
    let length = (0.3_f64 * 0.3 + 0.8 * 0.8).sqrt();
    let stretched = parts.shapes[2].normals.as_ref().unwrap()[0];
    assert_near(stretched, [0.0, 0.3 / length, 0.8 / length], SINGLE_ROUNDING);
}

#[test]
fn normals_that_are_no_numbers() {
    let mut file = File::triangle();
    let stored = [f32::NAN, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, f32::INFINITY];
    let normals = file.accessor(&floats(&stored), "VEC3", FLOAT, 3);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    let loaded = file.load();
    assert_eq!(loaded.warnings.len(), 1);
    assert_warns(&loaded, "meshes[0].primitives[0]", "no finite numbers");
    let expected = [[0.0; 3], [0.0, 0.0, 1.0], [0.0; 3]];
    assert_eq!(loaded.value.shapes[0].normals.as_deref(), Some(&expected[..]));
    Scene::assemble(loaded.value).unwrap();
}

#[test]
fn only_the_default_scene() {
    let mut file = File::triangle();
    file.json["nodes"] = json!([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}]);
    file.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1], "name": "second"}]);
    file.json["scene"] = json!(1);
    let loaded = file.load();
    assert_eq!((loaded.value.shapes.len(), loaded.value.name.as_str()), (1, "second"));
    assert_eq!(loaded.value.shapes[0].name, "b");
    assert_warns(&loaded, "scenes", "only scenes[1]");
    file.json.as_object_mut().unwrap().remove("scene");
    let loaded = file.load();
    assert_eq!(loaded.value.shapes.len(), 2);
    assert_warns(&loaded, "scenes", "none of 2 scenes");
    file.json.as_object_mut().unwrap().remove("scenes");
    assert_eq!(file.parts().shapes.len(), 2);
}

#[test]
fn several_primitives_are_several_shapes() {
    let mut file = File::triangle();
    let primitive = file.primitive().clone();
    push(&mut file.json["meshes"][0]["primitives"], primitive);
    let parts = file.parts();
    let names: Vec<&str> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["node 0 [0]", "node 0 [1]"]);
    assert_eq!(parts.materials.len(), 1);
}

#[test]
fn left_out_with_a_warning() {
    let mut file = File::triangle();
    file.primitive()["attributes"]["_CUSTOM"] = json!(0);
    file.json["animations"] = json!([{"channels": [], "samplers": []}]);
    file.json["extensionsUsed"] = json!(["X_unknown", "KHR_lights_punctual"]);
    let loaded = file.load();
    assert_warns(&loaded, "animations", "animations");
    assert_warns(&loaded, "extensionsUsed", "X_unknown");
    assert_eq!(loaded.warnings.len(), 2);
}

#[test]
fn the_same_warning_once() {
    let mut file = File::triangle();
    let mut primitive = file.primitive().clone();
    primitive["mode"] = json!(1);
    for _ in 0..5 {
        push(&mut file.json["meshes"][0]["primitives"], primitive.clone());
    }
    let loaded = file.load();
    assert_eq!(loaded.warnings.len(), 1);
    assert_eq!(loaded.warnings[0].place, "meshes[0].primitives[1] and 4 more");
}

#[test]
fn cameras() {
    let mut file = File::triangle();
    file.json["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}},
        {"type": "perspective", "name": "wide", "perspective": {"yfov": 4, "znear": 0.1}},
    ]);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    file.json["nodes"] = json!([
        {"mesh": 0},
        // Turned about y by a quarter: it looks along -x.
        {"camera": 0, "name": "door", "translation": [1, 2, 3], "rotation": [0, half, 0, half]},
        {"camera": 1},
        {"camera": 2},
        {"camera": 0, "scale": [0, 0, 0]},
    ]);
    file.json["scenes"] = json!([{"nodes": [0, 1, 2, 3, 4]}]);
    let loaded = file.load();
    let [camera] = &loaded.value.cameras[..] else { panic!("{:?}", loaded.value.cameras) };
    assert_eq!((camera.name.as_str(), camera.position), ("door", Point::new(1.0, 2.0, 3.0)));
    assert_eq!(camera.vertical_fov_rad, 0.5);
    assert_near(camera.direction.to_vector().into(), [-1.0, 0.0, 0.0], SINGLE_ROUNDING);
    assert_near(camera.up.to_vector().into(), [0.0, 1.0, 0.0], SINGLE_ROUNDING);
    assert_warns(&loaded, "cameras[1]", "without perspective");
    assert_warns(&loaded, "cameras[2]", "opening angle of 4");
    assert_warns(&loaded, "cameras[0]", "points nowhere");
    Scene::assemble(loaded.value).unwrap();
}

#[test]
fn data_uris_and_files_beside() {
    let mut file = File::triangle();
    let expected = file.parts();
    let directory = tempfile::tempdir().unwrap();
    std::fs::create_dir(directory.path().join("sub")).unwrap();
    std::fs::write(directory.path().join("sub/a b%é.bin"), &file.binary).unwrap();
    for uri in ["sub/a%20b%25%C3%A9.bin", "./sub/a b%25é.bin"] {
        file.json["buffers"][0]["uri"] = json!(uri);
        let read = read_in(directory.path(), "scene.gltf", file.json.to_string().as_bytes());
        assert_eq!(read.unwrap().value, expected, "{uri}");
    }
    // 36 bytes: x and y are 1.0 (00 00 80 3f) at bytes 12 and 28.
    let coded = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    for head in ["data:application/octet-stream;base64,", "data:;base64,", "DATA:;base64,"] {
        file.json["buffers"][0]["uri"] = json!(format!("{head}{coded}"));
        let read = read_in(directory.path(), "scene.gltf", file.json.to_string().as_bytes());
        assert_eq!(read.unwrap().value, expected, "{head}");
    }
    let with_mark = format!("\u{feff}{}", file.json);
    assert!(read_in(directory.path(), "scene.gltf", with_mark.as_bytes()).is_ok());
}

#[test]
fn a_size_that_another_unit_would_explain_is_warned_of() {
    let mut file = File::triangle();
    let corners = floats(&[0.0, 0.0, 0.0, 556.0, 0.0, 0.0, 0.0, 548.0, 0.0]);
    let positions = file.accessor(&corners, "VEC3", FLOAT, 3);
    file.primitive()["attributes"]["POSITION"] = json!(positions);
    assert_warns(&file.load(), "", "556 m large");
}
