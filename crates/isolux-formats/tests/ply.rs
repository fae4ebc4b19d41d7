//! PLY: text and both byte orders, properties, colours, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod spoil;

use isolux::scene::{Scene, SceneParts, UpAxis};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, ply, scene_toml};
use spoil::{Dice, spoil};

/// A square with a corner bent in, and a triangle: places, colours, one element to step over.
const HEADER: &str = "element vertex 6\nproperty float x\nproperty float y\nproperty double z\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
    element edge 1\nproperty int vertex1\nproperty list uchar short more\n\
    element face 2\nproperty list uchar int vertex_indices\nproperty short flags\nend_header\n";
const VERTICES: [([f32; 2], f64, [u8; 4]); 6] = [
    ([0.0, 0.0], 0.0, [255, 0, 0, 255]),
    ([2.0, 0.0], 0.0, [255, 0, 0, 255]),
    ([0.5, 0.5], 0.0, [255, 0, 0, 255]),
    ([0.0, 2.0], 0.0, [255, 0, 0, 255]),
    ([0.0, 0.0], 1.0, [188, 188, 188, 0]),
    ([2.0, 0.0], 1.0, [188, 188, 188, 0]),
];
const FACES: [&[i32]; 2] = [&[0, 1, 2, 3], &[1, 5, 4]];

fn text() -> Vec<u8> {
    let mut text = format!("ply\r\nformat ascii 1.0\ncomment by hand\n{HEADER}");
    for ([x, y], z, [r, g, b, a]) in VERTICES {
        text += &format!("{x} {y} {z} {r} {g} {b} {a}\n");
    }
    text += "0 2 3 7\n\n";
    for face in FACES {
        let corners: Vec<String> = face.iter().map(ToString::to_string).collect();
        text += &format!("{} {} 0\n", face.len(), corners.join(" "));
    }
    text.into_bytes()
}

/// The same in either byte order.
fn binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{order}_endian 1.0\n{HEADER}").into_bytes();
    let mut put = |number: &[u8]| {
        let mut number = number.to_vec();
        if big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for ([x, y], z, colour) in VERTICES {
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&z.to_le_bytes());
        colour.iter().for_each(|c| put(&[*c]));
    }
    put(&0_i32.to_le_bytes());
    put(&[2]);
    put(&3_i16.to_le_bytes());
    put(&7_i16.to_le_bytes());
    for face in FACES {
        put(&[face.len() as u8]);
        face.iter().for_each(|k| put(&k.to_le_bytes()));
        put(&0_i16.to_le_bytes());
    }
    bytes
}

fn read(bytes: &[u8]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.ply");
    std::fs::write(&path, bytes).unwrap();
    ply::read(&path)
}

#[track_caller]
fn refused(bytes: &[u8], expected: &str) {
    let message = read(bytes).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

/// Reads what a `scene.toml` says of the file.
fn read_as(geometry: &str, bytes: &[u8]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("thing.ply"), bytes).unwrap();
    let path = dir.path().join("scene.toml");
    let text =
        format!("[materials.m]\ndiffuse = 0.7\n[[geometry]]\nfile = 'thing.ply'\n{geometry}\n");
    std::fs::write(&path, text).unwrap();
    scene_toml::read(&path)
}

fn area(parts: &SceneParts) -> f64 {
    let scene = Scene::assemble(parts.clone()).unwrap();
    (0..scene.triangle_count()).map(|t| scene.triangle(t).area()).sum()
}

/// Faces alone, of vertices without properties but their places.
fn simple(vertices: &str, rest: &str) -> Vec<u8> {
    let count = vertices.lines().count();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\n\
         property float z\n{rest}"
    )
    .replacen("end_header\n", &format!("end_header\n{vertices}"), 1)
    .into_bytes()
}

const SQUARE: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

#[test]
fn all_three_forms_are_the_same() {
    let loaded = read(&text()).unwrap();
    for big in [false, true] {
        let other = read(&binary(big)).unwrap();
        assert_eq!(other.value, loaded.value);
    }
    let parts = loaded.value;
    assert_eq!((parts.name.as_str(), parts.up), ("thing", UpAxis::Z));
    // Two triangles of area a half each, and a third of area 1.
    assert_eq!(area(&parts), 2.0);
    assert_eq!(parts.materials[0].finish(false).unwrap().diffuse.colour, Rgb::grey(0.5));
    let told: String = loaded.warnings.iter().map(|w| format!("{w}\n")).collect();
    for due in [
        "line 4: properties `alpha` of vertices are not used",
        "line 12: 1 row of `edge` not used",
        "line 15: properties `flags` of faces are not used",
        "the colours of its vertices are not used; to read them",
        "PLY names no material: taken as grey 0.5",
    ] {
        assert!(told.contains(due), "{due}\n{told}");
    }
}

#[test]
fn colours_are_reflectances_where_asked_for() {
    let loaded = read_as("vertex_colours = true", &binary(false)).unwrap();
    let parts = loaded.value;
    let shape = &parts.shapes[0];
    let texture = &parts.textures[0];
    assert_eq!(
        parts.materials[shape.material as usize].finish(true).unwrap().diffuse.texture,
        Some(0)
    );
    let uvs = shape.uvs.as_ref().unwrap();
    let seen = shape.triangles.iter().map(|t| {
        t.map(|k| {
            let [u, v] = uvs[k as usize];
            texture.value(u, v)
        })
    });
    let seen: Vec<_> = seen.collect();
    assert_eq!(seen[0], [Rgb::new(1.0, 0.0, 0.0); 3]);
    // Two thirds of code 188 (0.503 of linear light), and in red a third of all light besides, to the nearest code.
    let [r, g, _] = seen[2][0].0;
    assert!((r - (1.0 + 2.0 * 0.503) / 3.0).abs() < 4e-3 && (g - 2.0 * 0.503 / 3.0).abs() < 4e-3);
    let none = read_as("vertex_colours = false", &text()).unwrap();
    assert!(none.value.textures.is_empty());
    let both = read_as("vertex_colours = true\nmaterial = 'm'", &text()).unwrap_err().to_string();
    assert!(both.contains("line 5, column 18: `vertex_colours` beside a material"), "{both}");
    let plain = simple(
        SQUARE,
        "element face 1\nproperty list uchar int vertex_index\nend_header\n4 0 1 2 3\n",
    );
    let none = read_as("vertex_colours = true", &plain).unwrap_err().to_string();
    assert!(none.contains("thing.ply: its vertices have no colours"), "{none}");
}

#[test]
fn a_scene_toml_gives_unit_axis_and_material() {
    let loaded = read_as("units = 'mm'\nmaterial = 'm'\nup = 'y'", &text()).unwrap();
    assert!(!loaded.warnings.iter().any(|w| w.what.contains("colour") || w.what.contains("grey")));
    let parts = loaded.value;
    assert_eq!(parts.materials[parts.shapes[0].material as usize].name, "m");
    let highest = parts.shapes[0].positions.iter().map(|p| p[2]).fold(0.0, f64::max);
    assert_eq!(highest, 0.002, "y of the file is up");
}

#[test]
fn strips_normals_and_texture_coordinates() {
    let bytes = b"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float s\n\
        property float t\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0 0 0 1 0 0\n1 0 0 0 0 nan 1 0\n0 1 0 0 0 1 0 1\n1 1 0 0 0 1 1 1\n8 0 1 2 3 -1 0 1 2";
    let loaded = read(bytes).unwrap();
    let shape = &loaded.value.shapes[0];
    assert_eq!(shape.triangles, [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(shape.uvs.as_ref().unwrap()[2], [0.0, 0.0], "v downwards");
    assert_eq!(shape.normals.as_ref().unwrap()[..2], [[0.0, 0.0, 1.0], [0.0; 3]]);
    assert_eq!(area(&loaded.value), 1.0);
    assert!(loaded.warnings.iter().any(|w| w.what.contains("1 face lies exactly on another")));
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let face = |list: &str, rows: &str| {
        simple(
            SQUARE,
            &format!("element face 1\nproperty list {list} vertex_index\nend_header\n{rows}"),
        )
    };
    refused(&face("uchar int", "4 0 1 2 4\n"), "line 14: index 4 where there are 4 vertices");
    refused(&face("uchar int", "4 0 1 2 -1\n"), "line 14: -1 is not the index of a vertex");
    refused(&face("uchar int", "4 0 1 2\n"), "line 14: too few numbers");
    refused(&face("uchar int", "3 0 1 2 3\n"), "line 14: more numbers than the header says");
    refused(&face("uchar int", "2 0 1\n"), "line 14: a face of 2 corners");
    refused(&face("uchar int", "4294967295 0\n"), "line 14: too few numbers");
    refused(&face("uchar int", "1e300 0\n"), "is not the length of a list");
    refused(&face("float int", "3 0 1 2\n"), "line 8: the length of a list is no whole number");
    refused(&face("uchar int3", "3 0 1 2\n"), "line 8: there is no type `int3`");
    refused(&face("uchar int", ""), "line 7: 1 rows of `face`, where the file has room for 0");
    refused(&simple(SQUARE, "end_header\n"), "there are no faces");
    refused(&simple("0 0 inf\n", "end_header\n"), "line 8: a coordinate that is not a finite");
    refused(&simple("0 0 x\n", "end_header\n"), "line 8: `x` is not a number");
    refused(&simple(SQUARE, "element a 9\nend_header\n"), "line 7: element `a` has no properties");
    refused(b"", "line 1: does not begin with `ply`");
    let odd = String::from_utf8(text()).unwrap().replace("comment by", "Made by");
    let told = read(odd.as_bytes()).unwrap().warnings.remove(0).to_string();
    assert!(told.contains("line 3: `Made` is no word of a header"), "{told}");
    refused(b"ply\n", "line 2: the header does not end");
    refused(b"ply\nend_header\n", "line 1: there is no `format`");
    refused(b"ply\nformat ascii 2.0\n", "line 2: version 2.0");
    refused(b"ply\nformat xml 1.0\n", "line 2: there is no format `xml`");
    refused(b"ply\nproperty int x\n", "line 2: a property before its element");
    refused(b"ply\nelement vertex -1\n", "line 2: `-1` is not a count");
    refused(
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n",
        "line 3: vertices without x, y and z",
    );
    for big in [false, true] {
        let whole = binary(big);
        refused(&whole[..whole.len() - 1], "face 2: the file ends here: it is cut off");
    }
}

#[test]
fn counts_are_not_believed() {
    for count in ["1000000000000", "18446744073709551615"] {
        for format in ["ascii", "binary_little_endian"] {
            let text = format!(
                "ply\nformat {format} 1.0\nelement vertex {count}\nproperty float x\n\
                 property float y\nproperty float z\nend_header\n0 0 0\n"
            );
            refused(text.as_bytes(), "where the file has room for");
        }
    }
    // A list of four thousand million numbers in a file of a few bytes.
    let mut bytes = b"ply\nformat binary_big_endian 1.0\nelement a 1\nproperty list uint double l\nend_header\n".to_vec();
    bytes.extend([0xff; 40]);
    refused(&bytes, "a 1: the file ends here");
    let many: String = (0..300).map(|k| format!("element e{k} 0\n")).collect();
    refused(format!("ply\n{many}").as_bytes(), "more than 256 elements");
}

#[test]
fn spoilt_files_are_read_or_refused() {
    const WORDS: [&str; 12] = [
        "ply",
        "list",
        "char",
        "double",
        "4294967295",
        "1e308",
        "nan",
        "-1",
        "",
        "element",
        "face",
        "0",
    ];
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.ply");
    let mut dice = Dice(5);
    let (mut was_read, mut was_refused) = (0, 0);
    for good in [text(), binary(false), binary(true)] {
        for _ in 0..600 {
            let mut bytes = good.clone();
            spoil(&mut bytes, &mut dice, &WORDS);
            std::fs::write(&path, &bytes).unwrap();
            match ply::read(&path) {
                // What is read is a scene or says why not, far coordinates among the reasons.
                Ok(loaded) => drop(Scene::assemble(loaded.value).map(|_| was_read += 1)),
                Err(Problems(list)) => {
                    assert!(!list.is_empty());
                    was_refused += 1;
                }
            }
        }
    }
    // Both must happen often, or the changes are too weak or too strong.
    assert!(was_read > 100 && was_refused > 300, "{was_read} read, {was_refused} refused");
}
