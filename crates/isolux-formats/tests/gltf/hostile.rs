//! Files made to harm: each is refused, with its reason, without a panic.
// size: tables of files, a few lines each

use crate::build::{FLOAT, File, I16, U8, U16, floats, png, push, read_bytes, read_in};
use isolux_formats::{Problems, gltf};
use serde_json::json;

/// That a file is refused at a place for a reason.
#[track_caller]
fn assert_refused(name: &str, read: Result<impl Sized, Problems>, place: &str, words: &str) {
    let Err(problems) = read else { panic!("{name}: accepted") };
    let found = problems.0.iter().any(|p| p.place.contains(place) && p.what.contains(words));
    assert!(found, "{name}: no `{words}` at `{place}` in {:#?}", problems.0);
}

type Change = fn(&mut File);

#[expect(clippy::too_many_lines, reason = "a table")]
#[test]
fn accessors() {
    let table: &[(&str, Change, &str, &str)] = &[
        (
            "count of 2^64 - 1",
            |f| f.json["accessors"][0]["count"] = json!(u64::MAX),
            "accessors[0]",
            "18446744073709551615 elements",
        ),
        (
            "count longer than the view",
            |f| f.json["accessors"][0]["count"] = json!(4),
            "accessors[0]",
            "past the end of their view",
        ),
        (
            "count at the limit, nothing behind it",
            |f| f.json["accessors"][0]["count"] = json!(3 << 25),
            "meshes[0].primitives[0]",
            "exceed",
        ),
        (
            "offset near 2^64",
            |f| f.json["accessors"][0]["byteOffset"] = json!(u64::MAX - 4),
            "accessors[0]",
            "past the end of their view",
        ),
        (
            "view offset near 2^64",
            |f| f.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX - 4),
            "bufferViews[0]",
            "past the end of buffers[0]",
        ),
        (
            "view length near 2^64",
            |f| f.json["bufferViews"][0]["byteLength"] = json!(u64::MAX),
            "bufferViews[0]",
            "past the end of buffers[0]",
        ),
        (
            "stride smaller than an element",
            |f| f.json["bufferViews"][0]["byteStride"] = json!(8),
            "accessors[0]",
            "elements of 12 bytes every 8",
        ),
        (
            "stride of zero",
            |f| f.json["bufferViews"][0]["byteStride"] = json!(0),
            "accessors[0]",
            "every 0 bytes",
        ),
        (
            "stride near 2^64",
            |f| f.json["bufferViews"][0]["byteStride"] = json!(u64::MAX),
            "accessors[0]",
            "past the end of their view",
        ),
        (
            "POSITION of bytes",
            |f| f.json["accessors"][0]["componentType"] = json!(U8),
            "attributes.POSITION",
            "VEC3 of unsigned bytes",
        ),
        (
            "POSITION of two numbers",
            |f| f.json["accessors"][0]["type"] = json!("VEC2"),
            "attributes.POSITION",
            "VEC2 of floats",
        ),
        (
            "POSITION of matrices",
            |f| f.json["accessors"][0]["type"] = json!("MAT3"),
            "accessors[0]",
            "matrices",
        ),
        (
            "unknown component type",
            |f| f.json["accessors"][0]["componentType"] = json!(5130),
            "accessors[0]",
            "unknown componentType",
        ),
        (
            "component type that is right in its lower 32 bits",
            |f| f.json["accessors"][0]["componentType"] = json!((1_u64 << 32) + 5126),
            "line 1",
            "does not fit 32 bits",
        ),
        (
            "index that is right in its lower 32 bits",
            |f| f.json["nodes"][0]["mesh"] = json!(1_u64 << 32),
            "line 1",
            "does not fit 32 bits",
        ),
        (
            "attribute that is right in its lower 32 bits",
            |f| f.primitive()["attributes"]["POSITION"] = json!(1_u64 << 32),
            "line 1",
            "does not fit 32 bits",
        ),
        (
            "accessor without data",
            |f| {
                f.json["accessors"][0] = json!({"type": "VEC3", "componentType": FLOAT, "count": 3})
            },
            "accessors[0]",
            "without a bufferView",
        ),
        (
            "missing accessor",
            |f| f.primitive()["attributes"]["POSITION"] = json!(7),
            "meshes[0].primitives[0]",
            "accessors[7] does not exist",
        ),
        (
            "missing view",
            |f| f.json["accessors"][0]["bufferView"] = json!(4294967295_u64),
            "meshes[0].primitives[0]",
            "bufferViews[4294967295] does not exist",
        ),
        (
            "missing buffer",
            |f| f.json["bufferViews"][0]["buffer"] = json!(1),
            "bufferViews[0]",
            "buffers[1] does not exist",
        ),
        (
            "buffer longer than the chunk",
            |f| f.json["buffers"][0]["byteLength"] = json!(1_000_000),
            "buffers[0]",
            "1000000 bytes announced, 36 found",
        ),
        (
            "buffer of 2^63 bytes",
            |f| f.json["buffers"][0]["byteLength"] = json!(1_u64 << 63),
            "buffers[0]",
            "9223372036854775808 bytes",
        ),
        (
            "normals for other vertices",
            |f| {
                let normals = f.accessor(&floats(&[0.0, 0.0, 1.0]), "VEC3", FLOAT, 1);
                f.primitive()["attributes"]["NORMAL"] = json!(normals);
            },
            "attributes.NORMAL",
            "1 elements for 3 vertices",
        ),
        (
            "vertex that is not a number",
            |f| f.binary[4..8].copy_from_slice(&f32::NAN.to_le_bytes()),
            "accessors[0]",
            "element 0 is not made of finite numbers",
        ),
    ];
    for (name, change, place, words) in table {
        let mut file = File::triangle();
        change(&mut file);
        assert_refused(name, file.read(), place, words);
    }
}

#[test]
fn indices() {
    let table: &[(&str, Change, &str, &str)] = &[
        (
            "out of range",
            |f| {
                let indices = f.accessor(&[0, 1, 3], "SCALAR", U8, 3);
                f.primitive()["indices"] = json!(indices);
            },
            "meshes[0].primitives[0].indices",
            "index 2 names vertex 3 of 3",
        ),
        (
            "primitive restart",
            |f| {
                let indices = f.accessor(&[0, 0, 1, 0, 255, 255], "SCALAR", U16, 3);
                f.primitive()["indices"] = json!(indices);
                f.primitive()["mode"] = json!(5);
            },
            "meshes[0].primitives[0].indices",
            "index 2 names vertex 65535 of 3",
        ),
        (
            "signed",
            |f| {
                let indices = f.accessor(&[0; 6], "SCALAR", I16, 3);
                f.primitive()["indices"] = json!(indices);
            },
            "accessors[1]",
            "SCALAR of signed 16 bit numbers where indices belong",
        ),
        (
            "vectors",
            |f| f.primitive()["indices"] = json!(0),
            "accessors[0]",
            "VEC3 of floats where indices belong",
        ),
        (
            "unknown mode",
            |f| f.primitive()["mode"] = json!(7),
            "meshes[0].primitives[0].mode",
            "unknown mode",
        ),
    ];
    for (name, change, place, words) in table {
        let mut file = File::triangle();
        change(&mut file);
        assert_refused(name, file.read(), place, words);
    }
}

#[test]
fn sparse_accessors() {
    let sparse = |count: u64, indices: &[u8]| {
        let mut file = File::triangle();
        let indices = file.view(indices);
        let values = file.view(&floats(&[0.0; 6]));
        file.json["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": {"bufferView": indices, "componentType": U8},
            "values": {"bufferView": values},
        });
        file
    };
    assert!(sparse(2, &[0, 2]).read().is_ok());
    let table = [
        ("target out of range", sparse(2, &[0, 3]), "accessors[0].sparse", "element 3 of 3"),
        ("more than there are", sparse(u64::MAX, &[0, 1]), "accessors[0].sparse", "of 3 elements"),
        ("too few indices", sparse(2, &[0]), "accessors[0].sparse.indices", "past the end"),
        ("too few values", sparse(3, &[0, 1, 2]), "accessors[0].sparse.values", "past the end"),
    ];
    for (name, file, place, words) in table {
        assert_refused(name, file.read(), place, words);
    }
    let mut zeros = sparse(1, &[0]);
    zeros.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert!(zeros.read().is_ok());
    zeros.json["accessors"][0]["count"] = json!(3 << 23);
    assert_refused("many zeros", zeros.read(), "accessors[0]", "without a bufferView");
}

#[expect(clippy::too_many_lines, reason = "a table")]
#[test]
fn nodes() {
    let table: &[(&str, Change, &str, &str)] = &[
        (
            "own child",
            |f| f.json["nodes"] = json!([{"mesh": 0, "children": [0]}]),
            "nodes[0]",
            "nodes[0] is its own ancestor",
        ),
        (
            "cycle beside the scene",
            |f| {
                f.json["nodes"] =
                    json!([{"mesh": 0}, {"children": [2]}, {"children": [3]}, {"children": [1]}]);
            },
            "nodes[1]",
            "is its own ancestor",
        ),
        (
            "two parents",
            |f| {
                f.json["nodes"] = json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]);
            },
            "nodes[1].children",
            "nodes[2] is already a child of nodes[0]",
        ),
        (
            "twice a child",
            |f| f.json["nodes"] = json!([{"children": [1, 1]}, {"mesh": 0}]),
            "nodes[0].children",
            "nodes[1] is already a child of nodes[0]",
        ),
        (
            "missing child",
            |f| f.json["nodes"][0]["children"] = json!([5]),
            "nodes[0].children",
            "nodes[5] does not exist",
        ),
        (
            "root that is a child",
            |f| {
                f.json["nodes"] = json!([{"children": [1]}, {"mesh": 0}]);
                f.json["scenes"] = json!([{"nodes": [0, 1]}]);
            },
            "scenes[0].nodes",
            "nodes[1] is also a child of nodes[0]",
        ),
        (
            "root named twice",
            |f| f.json["scenes"] = json!([{"nodes": [0, 0]}]),
            "scenes[0].nodes",
            "nodes[0] is named twice",
        ),
        (
            "missing root",
            |f| f.json["scenes"] = json!([{"nodes": [9]}]),
            "scenes[0].nodes",
            "nodes[9] does not exist",
        ),
        ("missing scene", |f| f.json["scene"] = json!(3), "scene", "scenes[3] does not exist"),
        (
            "missing mesh",
            |f| f.json["nodes"][0]["mesh"] = json!(3),
            "nodes[0].mesh",
            "meshes[3] does not exist",
        ),
        (
            "nesting",
            |f| {
                let node = |k: usize| json!({"children": [k + 1]});
                f.json["nodes"] = (0..100_000).map(node).collect();
                push(&mut f.json["nodes"], json!({"mesh": 0}));
            },
            "nodes[",
            "more than 1024 levels",
        ),
        (
            "matrix beyond floats",
            |f| {
                f.json["nodes"][0]["matrix"] =
                    json!([1e39, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
            },
            "nodes[0]",
            "number out of range",
        ),
        (
            "projective matrix",
            |f| {
                f.json["nodes"][0]["matrix"] =
                    json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
            },
            "nodes[0].matrix",
            "last row",
        ),
        (
            "rotation of length zero",
            |f| f.json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
            "nodes[0].rotation",
            "length zero",
        ),
        (
            "scale beyond floats",
            |f| f.json["nodes"][0]["scale"] = json!([1, 1e300, 1]),
            "nodes[0]",
            "number out of range",
        ),
        (
            "scale beyond floats when multiplied",
            |f| {
                let node = |k: usize| json!({"children": [k + 1], "scale": [1e38, 1, 1]});
                f.json["nodes"] = (0..10).map(node).collect();
                push(&mut f.json["nodes"], json!({"mesh": 0}));
            },
            "nodes[4]",
            "beyond the range",
        ),
    ];
    for (name, change, place, words) in table {
        let mut file = File::triangle();
        change(&mut file);
        assert_refused(name, file.read(), place, words);
    }
}

/// A matrix of NaN cannot be written in JSON at all.
#[test]
fn not_a_number_is_not_json() {
    let text = r#"{"asset":{"version":"2.0"},"nodes":[{"matrix":[NaN]}]}"#;
    assert_refused(
        "NaN",
        read_bytes("a.gltf", text.as_bytes()),
        "line 1, column",
        "expected value",
    );
}

#[test]
fn references() {
    let table = [
        ("..", "../outside.bin", "leaves the directory"),
        ("encoded ..", "%2e%2e/outside.bin", "leaves the directory"),
        ("absolute", "/etc/hostname", "leaves the directory"),
        ("file scheme", "file:///etc/hostname", "of the kind `file:`"),
        ("http", "http://example.org/a.bin", "of the kind `http:`"),
        ("not UTF-8", "%ff%fe", "not UTF-8"),
        ("half a percent sign", "a%4", "without two hexadecimal digits"),
        ("missing", "missing.bin", "does not exist"),
        ("directory", ".", "not a regular file"),
        ("data without comma", "data:application/octet-stream;base64", "no comma"),
        ("data not base64", "data:;base64,*", "not valid base64"),
    ];
    let outer = tempfile::tempdir().unwrap();
    std::fs::write(outer.path().join("outside.bin"), [0; 36]).unwrap();
    let inner = outer.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    for (name, uri, words) in table {
        let mut file = File::triangle();
        file.json["buffers"][0]["uri"] = json!(uri);
        let text = file.json.to_string();
        let read = read_in(&inner, "a.gltf", text.as_bytes());
        assert_refused(name, read, "buffers[0].uri", words);
    }
}

#[cfg(unix)]
#[test]
fn links_out_of_the_directory() {
    let outer = tempfile::tempdir().unwrap();
    let inner = outer.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    std::fs::write(outer.path().join("outside.bin"), [0; 36]).unwrap();
    std::os::unix::fs::symlink("../outside.bin", inner.join("inside.bin")).unwrap();
    let mut file = File::triangle();
    file.json["buffers"][0]["uri"] = json!("inside.bin");
    let read = read_in(&inner, "a.gltf", file.json.to_string().as_bytes());
    assert_refused("link", read, "buffers[0].uri", "leaves the directory");
}

#[test]
fn containers() {
    let good = File::triangle().glb();
    let with_word = |at: usize, word: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        bytes
    };
    let json_length = u32::from_le_bytes(good[12..16].try_into().unwrap());
    let second = 20 + json_length as usize;
    let table = [
        ("cut short", good[..good.len() - 1].to_vec(), "byte 8", "the header says"),
        ("only the magic", good[..4].to_vec(), "byte 4", "ends inside a header"),
        ("only a header", with_word(8, 12)[..12].to_vec(), "byte 12", "ends inside a header"),
        ("version 1", with_word(4, 1), "byte 4", "version 1"),
        ("length of 2^32 - 1", with_word(8, u32::MAX), "byte 8", "the header says"),
        ("length inside the first chunk", with_word(8, 30), "byte 12", "where 10 are left"),
        ("long JSON chunk", with_word(12, u32::MAX), "byte 12", "a chunk of 4294967295 bytes"),
        ("short JSON chunk", with_word(12, 4), "byte ", ""),
        ("long binary chunk", with_word(second, u32::MAX), "byte ", "where 36 are left"),
        ("short binary chunk", with_word(second, 32), "byte ", "ends inside a header"),
        ("binary first", with_word(16, 0x004e_4942), "byte 16", "not JSON"),
        ("not UTF-8 at all", vec![0xff; 64], "", "neither GLB nor JSON"),
        ("empty", Vec::new(), "", "is empty"),
    ];
    for (name, bytes, place, words) in table {
        assert_refused(name, read_bytes("a.glb", &bytes), place, words);
    }
}

/// A little of all that is read from buffers.
fn file_of_everything() -> File {
    let mut file = File::triangle();
    let indices = file.accessor(&[0, 1, 2], "SCALAR", U8, 3);
    let uvs = file.accessor(&floats(&[0.5; 6]), "VEC2", FLOAT, 3);
    let colours = file.accessor(&floats(&[0.5; 9]), "VEC3", FLOAT, 3);
    let (places, values) = (file.view(&[1]), file.view(&floats(&[2.0; 3])));
    let picture = file.view(&png(&[[255, 0, 0], [0, 0, 255]]));
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": places, "componentType": U8},
        "values": {"bufferView": values},
    });
    file.primitive()["indices"] = json!(indices);
    file.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
    file.primitive()["attributes"]["COLOR_0"] = json!(colours);
    file.json["images"] = json!([{"bufferView": picture}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
    file.json["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]);
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "spot"}]}});
    let light = json!({"KHR_lights_punctual": {"light": 0}});
    file.json["nodes"][0] = json!({"mesh": 0, "camera": 0, "extensions": light});
    file.parts();
    file
}

/// Cut short, or a byte turned over, all along the file: the result is an answer and no panic.
#[test]
fn damaged_everywhere() {
    let good = file_of_everything().glb();
    let directory = tempfile::tempdir().unwrap();
    for length in (0..good.len()).step_by(13) {
        assert!(read_in(directory.path(), "a.glb", &good[..length]).is_err(), "{length}");
    }
    for at in (0..good.len()).step_by(3) {
        let mut bytes = good.clone();
        bytes[at] = !bytes[at];
        let _ = read_in(directory.path(), "a.glb", &bytes);
    }
}

#[test]
fn texts() {
    let deep = "[".repeat(100_000);
    let table = [
        ("deep arrays", format!(r#"{{"x":{deep}"#), "recursion limit"),
        (
            "a member twice",
            r#"{"asset":{"version":"2.0"},"scene":0,"scene":1}"#.into(),
            "duplicate",
        ),
        ("no asset", "{}".into(), "missing field `asset`"),
        ("text behind", r#"{"asset":{"version":"2.0"}} x"#.into(), "trailing characters"),
    ];
    for (name, text, words) in table {
        assert_refused(name, read_bytes("a.gltf", text.as_bytes()), "line 1, column", words);
    }
    let text = r#"{"asset":{"version":"2.0"},"scene":-1}"#;
    assert_refused("negative", read_bytes("a.gltf", text.as_bytes()), "scene", "invalid type");
    for version in ["1.0", "3.0", "2", ""] {
        // Meshes were named, not numbered, before version 2.
        let text = format!(r#"{{"asset":{{"version":"{version}"}},"meshes":{{}}}}"#);
        assert_refused(version, read_bytes("a.gltf", text.as_bytes()), "asset", "glTF version");
    }
    let directory = tempfile::tempdir().unwrap();
    assert_refused("directory", gltf::read(directory.path()), "", "not a regular file");
    assert_refused("missing", gltf::read(&directory.path().join("no.glb")), "", "does not exist");
}

/// A small file that would become a thousand times a thousand vertices.
#[test]
fn instances_without_end() {
    let mut file = File::empty();
    let positions = vec![0; 12 * 30_000];
    let accessor = file.accessor(&positions, "VEC3", FLOAT, 30_000);
    file.json["meshes"] = json!([{"primitives": [{"attributes": {"POSITION": accessor}}]}]);
    file.json["nodes"] = (0..4000).map(|_| json!({"mesh": 0})).collect();
    assert_refused("instances", file.read(), "meshes[0].primitives[0]", "placed 4000 times");
}

#[test]
fn pictures() {
    let with_picture = |bytes: &[u8]| {
        let mut file = File::triangle();
        let view = file.view(bytes);
        file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
        file.json["textures"] = json!([{"source": 0}]);
        file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
        file
    };
    let good = png(&[[255, 0, 0]]);
    // Width and height are bytes 16 to 24 of a PNG; their checksum bytes 29 to 33.
    let mut huge = good.clone();
    huge[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let checksum = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&checksum.to_be_bytes());
    let mut wide = good.clone();
    wide[16..24].copy_from_slice(&[0, 0, 0x40, 0, 0, 0, 0x40, 0]);
    let checksum = crc32(&wide[12..29]);
    wide[29..33].copy_from_slice(&checksum.to_be_bytes());
    let table = [
        ("huge", with_picture(&huge), "images[0]", ""),
        ("16384 x 16384", with_picture(&wide), "images[0]", "16384 x 16384 pixels"),
        ("cut short", with_picture(&good[..good.len() / 2]), "images[0]", "cannot be read"),
        ("no picture", with_picture(b"GIF89a"), "images[0]", "cannot be read"),
        ("empty", with_picture(b""), "images[0]", "cannot be read"),
    ];
    for (name, file, place, words) in table {
        assert_refused(name, file.read(), place, words);
    }
    let mut file = with_picture(&good);
    assert!(file.read().is_ok());
    file.json["images"] = json!([{"uri": "../a.png"}]);
    assert_refused("outside", file.read(), "images[0]", "leaves the directory");
    file.json["textures"] = json!([{"source": 4}]);
    assert_refused("missing image", file.read(), "textures[0].source", "images[4] does not exist");
    file.json["textures"] = json!([{}]);
    assert_refused("no source", file.read(), "textures[0]", "no picture");
}

/// The checksum of PNG chunks (ISO 15948, annex D), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 };
    let byte = |crc: u32, &b: &u8| (0..8).fold(crc ^ u32::from(b), |crc, _| step(crc));
    !bytes.iter().fold(u32::MAX, byte)
}

#[test]
fn extensions_required() {
    for name in ["KHR_texture_basisu", "KHR_materials_sheen", "X"] {
        let mut file = File::triangle();
        file.json["extensionsRequired"] = json!([name]);
        assert_refused(name, file.read(), "extensionsRequired", &format!("extension {name} is"));
    }
}

#[test]
fn all_problems_at_once() {
    let mut file = File::triangle();
    file.json["extensionsRequired"] = json!(["X_one", "X_two"]);
    file.json["nodes"][0]["children"] = json!([8, 9]);
    file.json["buffers"] = json!([{"byteLength": 36}, {"byteLength": 1, "uri": "no.bin"}]);
    let Err(problems) = file.read() else { panic!("accepted") };
    let places: Vec<&str> = problems.0.iter().map(|p| p.place.as_str()).collect();
    let expected = [
        "extensionsRequired",
        "extensionsRequired",
        "nodes[0].children",
        "nodes[0].children",
        "buffers[1].uri",
    ];
    assert_eq!(places, expected);
    assert!(problems.0.iter().all(|p| p.file.ends_with("scene.glb") && !p.remedy.is_empty()));
}
