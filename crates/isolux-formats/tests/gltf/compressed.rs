//! Compressed files made by the encoders that others use (`tests/data/gltf/make_compressed.mjs`), against the grid
//! they were made from; and the same files spoilt.

use crate::build::{File, assert_warns, floats, read_in};
use isolux::geometry::{Point, Vector};
use isolux::scene::{SceneParts, Shape};
use isolux_formats::gltf;
use serde_json::json;
use std::path::{Path, PathBuf};

const SIDE: usize = 20;

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/gltf").join(name)
}

fn parts(name: &str) -> SceneParts {
    let loaded = gltf::read(&sample(name)).unwrap_or_else(|problems| panic!("{problems}"));
    loaded.value
}

/// Place of a vertex of the grid.
fn position(i: usize, j: usize) -> [f64; 3] {
    [i as f64 / 8.0, ((i * i + 3 * j) % 8) as f64 / 32.0, j as f64 / 8.0]
}

fn normal(i: usize, j: usize) -> Vector {
    let normal = Vector::new(i as f64 - 9.5, 12.0, j as f64 - 9.5);
    normal / normal.length()
}

fn vertices() -> impl Iterator<Item = (usize, usize)> {
    (0..SIDE * SIDE).map(|k| (k % SIDE, k / SIDE))
}

fn corners() -> Vec<[u32; 3]> {
    let cell = |i: usize, j: usize| {
        let [a, b] = [j * SIDE + i, j * SIDE + i + 1].map(|v| v as u32);
        let [c, d] = [a, b].map(|v| v + SIDE as u32);
        [[a, c, b], [b, c, d]]
    };
    let cells = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| (i, j)));
    cells.flat_map(|(i, j)| cell(i, j)).collect()
}

/// The lists of corners as sets of triangles, each from its smallest corner on: encoders may turn and reorder.
fn turned(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let turn = |&[a, b, c]: &[u32; 3]| [[a, b, c], [b, c, a], [c, a, b]].into_iter().min();
    let mut all: Vec<[u32; 3]> = triangles.iter().filter_map(turn).collect();
    all.sort_unstable();
    all
}

#[track_caller]
fn assert_normals(shape: &Shape, bound: f64) {
    let stored = shape.normals.as_ref().unwrap();
    for ((i, j), &found) in vertices().zip(stored) {
        let off = (Vector::from(found) - normal(i, j)).length();
        assert!(off < bound, "({i}, {j}): {off}");
    }
}

/// A signed number of so many bits is off by half a step. A step in one of the two numbers of an octahedral vector
/// moves the place on the octahedron by up to sqrt(2), which is at least 1/sqrt(3) from the centre: by sqrt(6) on the
/// sphere. Stored again it is off by half a step in each of three numbers.
fn octahedral_bound(bits: i32, stored_bits: i32) -> f64 {
    let half_step = |bits: i32| 0.5 / f64::from((1 << (bits - 1)) - 1);
    2.0 * 6_f64.sqrt() * half_step(bits) + 3_f64.sqrt() * half_step(stored_bits)
}

#[test]
fn meshopt_of_both_versions() {
    for version in [0, 1] {
        let parts = parts(&format!("meshopt_v{version}.glb"));
        let [first, copies @ ..] = &parts.shapes[..] else { panic!("no shapes") };
        assert!(vertices().zip(&first.positions).all(|((i, j), &p)| p == position(i, j)));
        assert_eq!(first.positions.len(), SIDE * SIDE);
        assert_eq!(turned(&first.triangles), turned(&corners()));
        assert_normals(first, octahedral_bound(8, 8));

        assert_eq!(copies.len(), 5);
        let straight = &copies[0];
        assert_eq!(straight.triangles, corners());
        assert_normals(straight, octahedral_bound(12, 16));
        assert_eq!(straight.name, "second[0]");
        for (k, copy) in copies.iter().enumerate() {
            let (angle, scale) = (k as f64 * std::f64::consts::PI / 5.0, 1.0 + k as f64 / 4.0);
            let (sin, cos) = libm::sincos(angle);
            for ((i, j), &found) in vertices().zip(&copy.positions) {
                let [x, y, z] = position(i, j);
                let x = scale * x;
                let turned = [cos * x + sin * z, y, cos * z - sin * x];
                let expected = Point::from(turned) + Vector::new(4.0 * k as f64, 0.25, -1.5);
                let off = (Point::from(found) - expected).length();
                // Quaternions of 16 bits turn by two steps at most, over 5.4 m.
                assert!(off < 5.4 * 2.0 / 32767.0, "copy {k}: {off}");
            }
        }
    }
}

/// The mean of red, green and blue over the surface is 1/2; 8 bits are off by half a step.
#[test]
fn meshopt_colours() {
    let parts = parts("meshopt_v1.glb");
    let of_first = parts.shapes[0].material as usize;
    let of_second = parts.shapes[1].material as usize;
    let colour = |k: usize| parts.materials[k].finish(false).unwrap().diffuse.colour;
    let ratio = colour(of_first) / colour(of_second).0[0];
    for channel in ratio.0 {
        assert!((channel - 0.5).abs() < 1.0 / 255.0, "{ratio:?}");
    }
}

#[test]
fn draco_of_both_methods() {
    for method in ["edgebreaker", "sequential"] {
        let parts = parts(&format!("draco_{method}.glb"));
        let [shape] = &parts.shapes[..] else { panic!("{} shapes", parts.shapes.len()) };
        // 14 bits over 2.375 m, the same step along all axes; half a step off.
        let bound = 0.5 * 2.375 / 16383.0 + 1e-7;
        let mut index = Vec::new();
        for &found in &shape.positions {
            let [i, j] = [found[0], found[2]].map(|c| (8.0 * c).round() as usize);
            let off = position(i, j).into_iter().zip(found).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < bound, "{found:?}");
            index.push((j * SIDE + i) as u32);
        }
        let named: Vec<[u32; 3]> =
            shape.triangles.iter().map(|t| t.map(|corner| index[corner as usize])).collect();
        assert_eq!(turned(&named), turned(&corners()), "{method}");
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % most.max(1) as u64) as usize
    }
}

/// Where the binary chunk of a GLB starts.
fn binary_of(glb: &[u8]) -> usize {
    let json = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    20 + json + 8
}

/// Bytes of the compressed streams are overwritten, one to eight of them: the file is read or refused, nothing
/// panics, hangs or takes memory without end.
#[test]
fn spoilt_streams() {
    let directory = tempfile::tempdir().unwrap();
    let (mut read, mut refused) = (0, 0);
    for name in
        ["meshopt_v0.glb", "meshopt_v1.glb", "draco_edgebreaker.glb", "draco_sequential.glb"]
    {
        let good = std::fs::read(sample(name)).unwrap();
        let start = binary_of(&good);
        let mut dice = Dice(start as u64);
        for _ in 0..600 {
            let mut bytes = good.clone();
            for _ in 0..=dice.below(8) {
                let at = start + dice.below(good.len() - start);
                bytes[at] = match dice.below(4) {
                    0 => 0,
                    1 => 0xff,
                    2 => bytes[at] ^ (1 << dice.below(8)),
                    _ => dice.below(256) as u8,
                };
            }
            match read_in(directory.path(), "a.glb", &bytes) {
                Ok(loaded) => {
                    let sound = |shape: &Shape| {
                        shape.positions.as_flattened().iter().all(|c| c.is_finite())
                            && shape
                                .triangles
                                .as_flattened()
                                .iter()
                                .all(|&v| (v as usize) < shape.positions.len())
                    };
                    assert!(loaded.value.shapes.iter().all(sound), "{name}");
                    read += 1;
                }
                Err(problems) => {
                    assert!(problems.0.iter().all(|p| !p.remedy.is_empty()), "{name}: {problems}");
                    refused += 1;
                }
            }
        }
    }
    assert!(read > 100 && refused > 100, "{read} read, {refused} refused");
}

/// Every stream cut short by one byte and by half.
#[test]
fn streams_cut_short() {
    for version in [0, 1] {
        let good = std::fs::read(sample(&format!("meshopt_v{version}.glb"))).unwrap();
        let start = binary_of(&good);
        let json: serde_json::Value = serde_json::from_slice(&good[20..start - 8]).unwrap();
        let views = json["bufferViews"].as_array().unwrap().len();
        for view in 0..views {
            for cut in [1, 2] {
                let mut file = File { json: json.clone(), binary: good[start..].to_vec() };
                let extensions = &mut file.json["bufferViews"][view]["extensions"];
                let name = ["KHR_meshopt_compression", "EXT_meshopt_compression"][1 - version];
                let length = extensions[name]["byteLength"].as_u64().unwrap();
                let shorter = if cut == 1 { length - 1 } else { length / 2 };
                extensions[name]["byteLength"] = json!(shorter);
                let problems = file.read().expect_err("read");
                assert_eq!(problems.0[0].place, format!("bufferViews[{view}]"), "{problems}");
            }
        }
    }
}

/// Counts are not believed before the bytes are there, and what unpacks to more than a scene may hold is refused.
#[test]
fn counts_without_bytes() {
    let good = std::fs::read(sample("meshopt_v1.glb")).unwrap();
    let start = binary_of(&good);
    let json: serde_json::Value = serde_json::from_slice(&good[20..start - 8]).unwrap();
    for (count, words) in
        [(u64::MAX / 4, "more than"), (1 << 32, "more than"), (3 << 24, "cut short")]
    {
        for view in [0, 4, 5] {
            let mut file = File { json: json.clone(), binary: good[start..].to_vec() };
            file.json["bufferViews"][view]["extensions"]["KHR_meshopt_compression"]["count"] =
                json!(count - count % 3);
            let problems = file.read().expect_err("read");
            assert!(problems.0[0].what.contains(words), "{problems}");
        }
    }
}

#[test]
fn strides_modes_and_filters_that_do_not_suit() {
    let table = [
        json!({"byteStride": 6}),
        json!({"byteStride": 0}),
        json!({"byteStride": 260}),
        json!({"mode": "TRIANGLES"}),
        json!({"mode": "INDICES", "byteStride": 8}),
        json!({"mode": "TRIANGLES", "byteStride": 4, "count": 4}),
        json!({"mode": "INDICES", "byteStride": 4, "filter": "EXPONENTIAL"}),
        json!({"filter": "QUATERNION"}),
        json!({"filter": "OCTAHEDRAL"}),
        json!({"filter": "COLOR"}),
        json!({"filter": "SHARPEN"}),
        json!({"mode": "MAGIC"}),
        json!({"count": -1}),
        json!({"buffer": 7}),
        json!({"byteOffset": u64::MAX}),
    ];
    for change in table {
        let mut file = File::triangle();
        let mut packed = json!({
            "buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES",
        });
        for (key, value) in change.as_object().unwrap() {
            packed[key] = value.clone();
        }
        file.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": packed});
        let problems = file.read().expect_err("read");
        assert!(problems.0[0].place.starts_with("bufferViews[0]"), "{change}: {problems}");
    }
}

/// A primitive that names accessors with data beside its compressed form is read from them.
#[test]
fn draco_beside_plain_data() {
    let mut file = File::triangle();
    file.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    let extension = json!({"bufferView": 0, "attributes": {"POSITION": 0}});
    file.primitive()["extensions"] = json!({"KHR_draco_mesh_compression": extension});
    file.parts();
    file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let problems = file.read().expect_err("read");
    assert!(problems.0[0].what.contains("the compressed mesh cannot be read"), "{problems}");
    assert!(problems.0[0].place.starts_with("meshes[0].primitives[0].extensions.KHR_draco"));
}

/// A buffer that only stands in for what is compressed elsewhere need not be there; one that is read must.
#[test]
fn placeholders() {
    let mut file = File::triangle();
    file.json["buffers"] = json!([{"byteLength": 36}, {"byteLength": 99}]);
    let problems = file.clone().read().expect_err("read");
    assert!(problems.0[0].place.starts_with("buffers[1]"), "{problems}");
    file.json["buffers"][1]["extensions"] = json!({"EXT_meshopt_compression": {"fallback": true}});
    file.load();
}

/// Sparse accessors without a base are zeros but for what is listed.
#[test]
fn sparse_on_zeros() {
    let mut file = File::triangle();
    let (places, values) =
        (file.view(&[1, 2]), file.view(&floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0])));
    let accessor = &mut file.json["accessors"][0];
    accessor.as_object_mut().unwrap().remove("bufferView");
    accessor["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": places, "componentType": 5121},
        "values": {"bufferView": values},
    });
    assert_eq!(file.shape().positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    file.json["extensionsUsed"] = json!(["KHR_texture_basisu"]);
    assert_warns(&file.load(), "extensionsUsed", "KHR_texture_basisu");
}
