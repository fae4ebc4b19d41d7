//! STL: both kinds, what it does not say, and hostile files.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

mod spoil;

use isolux::scene::{Scene, SceneParts, UpAxis};
use isolux::units::Rgb;
use isolux_formats::{Loaded, Problems, scene_toml, stl};
use spoil::{Dice, spoil};

/// A tetrahedron and a triangle, the first with normals that point inwards.
const TEXT: &str = "solid pyramid\n\
    facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n\
    facet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n\
    facet normal 1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n\
    facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n\
    endsolid pyramid\n\
    SOLID a b\n  FACET NORMAL nan nan nan\n outer loop\n\tvertex 2 0 0\n vertex 3.0e0 0 0\n vertex 2 1 -0\n\
    endloop\n endfacet\nendsolid\n";

fn read(bytes: &[u8]) -> Result<Loaded<SceneParts>, Problems> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.stl");
    std::fs::write(&path, bytes).unwrap();
    stl::read(&path)
}

#[track_caller]
fn refused(bytes: &[u8], expected: &str) {
    let message = read(bytes).unwrap_err().to_string();
    assert!(message.contains(expected), "{message}");
}

fn told(bytes: &[u8]) -> String {
    let warnings = read(bytes).unwrap().warnings;
    warnings.iter().map(|w| format!("{w}\n")).collect()
}

/// Binary STL of triangles, with a header that begins as text does.
fn binary(triangles: &[[[f32; 3]; 3]], told: u32) -> Vec<u8> {
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(told.to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const TWO: [[[f32; 3]; 3]; 2] =
    [[[0., 0., 0.], [1., 0., 0.], [0., 2., 0.]], [[0., 0., 0.], [0., 2., 0.], [-1., 0., 0.]]];

fn area(parts: SceneParts) -> f64 {
    let scene = Scene::assemble(parts).unwrap();
    (0..scene.triangle_count()).map(|t| scene.triangle(t).area()).sum()
}

#[test]
fn solids_are_parts_with_corners_welded() {
    let loaded = read(TEXT.as_bytes()).unwrap();
    let parts = loaded.value;
    assert_eq!((parts.name.as_str(), parts.up), ("thing", UpAxis::Z));
    let names: Vec<_> = parts.shapes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["pyramid", "a b"]);
    let sizes = parts.shapes.iter().map(|s| (s.positions.len(), s.triangles.len()));
    assert_eq!(sizes.collect::<Vec<_>>(), [(4, 4), (3, 1)]);
    let grey = parts.materials[1].finish(true).unwrap();
    assert_eq!((parts.materials[1].name.as_str(), grey.diffuse.colour), ("a b", Rgb::grey(0.5)));
    // Three halves, a face of side sqrt 2, and a half.
    assert!((area(parts) - (2.0 + 0.75_f64.sqrt())).abs() < 1e-12);
    let told = told(TEXT.as_bytes());
    assert!(
        told.contains("STL names no material: taken as grey 0.5; name the file in a scene.toml")
    );
    assert!(told.contains("normals of 3 of 5 facets"), "{told}");
}

#[test]
fn binary_files_may_begin_like_text() {
    let parts = read(&binary(&TWO, 2)).unwrap().value;
    assert_eq!((parts.shapes[0].positions.len(), parts.shapes[0].name.as_str()), (4, ""));
    assert_eq!(parts.materials[0].name, "unnamed");
    assert_eq!(area(parts), 2.0);
    let mut longer = binary(&TWO, 1);
    longer[..5].copy_from_slice(b"other");
    assert!(told(&longer).contains("50 bytes follow the 1 triangles"));
    assert_eq!(area(read(&longer).unwrap().value), 1.0);
}

#[test]
fn what_lies_twice_is_there_once() {
    let [one, _] = TWO;
    let turned = [one[0], one[2], one[1]];
    let told = told(&binary(&[one, turned, TWO[1]], 3));
    assert!(told.contains("1 face lies exactly on another"), "{told}");
}

#[test]
fn a_size_that_another_unit_explains_is_told() {
    let large = TWO.map(|t| t.map(|p| p.map(|x| 1000.0 * x)));
    let told = told(&binary(&large, 2));
    assert!(told.contains("STL names no unit; read as metres, it is 2000 m large"), "{told}");
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    refused(&binary(&TWO, 3), "byte 80: says it has 3 triangles and holds 2");
    refused(&binary(&TWO, u32::MAX), "says it has 4294967295 triangles");
    refused(&binary(&[[[f32::NAN; 3]; 3], TWO[0]], 2), "triangle 1: a coordinate");
    refused(b"", "0 bytes are neither text nor binary STL");
    refused(b"solid\nendsolid\n", "there are no faces");
    refused(&binary(&[], 0), "there are no faces");
    let broken = |from: &str, to: &str| TEXT.replacen(from, to, 1).into_bytes();
    refused(&broken("vertex 1 0 0", "vertex 1 0"), "line 6: `1 0` is not three finite numbers");
    refused(&broken("vertex 1 0 0", "vertex 1 0 inf"), "line 6: `1 0 inf`");
    refused(&broken("vertex 1 0 0\n", ""), "line 7: a facet of fewer than three corners");
    refused(&broken("endloop", "vertex 1 1 1\nendloop"), "line 7: a facet of more than three");
    refused(&broken("endfacet\n", ""), "line 8: `facet` within the facet of line 2");
    refused(&broken("endsolid pyramid\n", ""), "line 30: `solid` where `endsolid` was due");
    refused(&broken("solid pyramid\n", "solid a\nendsolid\n"), "line 3: `facet` outside");
    refused(
        TEXT.split_once("endfacet").unwrap().0.as_bytes(),
        "line 7: the file ends within the facet of line 2",
    );
    let open = TEXT.strip_suffix("endsolid\n").unwrap();
    assert!(told(open.as_bytes()).contains("ends without `endsolid`"));
    assert!(
        told(&broken("endfacet", "color 1 1 1\nendfacet")).contains("line 8: `color` (1 time,")
    );
}

#[test]
fn a_scene_toml_gives_unit_axis_material_and_light() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("thing.stl"), TEXT).unwrap();
    let path = dir.path().join("scene.toml");
    let text = "[materials.paint]\ndiffuse = 0.7\n[materials.oak]\ndiffuse = 0.3\n[[geometry]]\n\
                file = 'thing.stl'\nunits = 'cm'\nup = 'y'\nmaterial = 'paint'\n\
                materials = { 'a b' = 'oak' }\n[[luminaire]]\nposition = [0, 0, 1]\n\
                isotropic = { flux_lm = 100 }\n";
    std::fs::write(&path, text).unwrap();
    let Loaded { value, warnings } = scene_toml::read(&path).unwrap();
    assert_eq!(warnings.iter().filter(|w| !w.what.contains("normals")).count(), 0, "{warnings:?}");
    let of = |shape: usize| value.materials[value.shapes[shape].material as usize].name.as_str();
    assert_eq!((of(0), of(1)), ("paint", "oak"));
    let highest = value.shapes[0].positions.iter().map(|p| p[2]).fold(0.0, f64::max);
    assert_eq!(highest, 0.01, "y of the file is up");
    Scene::assemble(value).unwrap();
}

#[test]
fn spoilt_files_are_read_or_refused() {
    const WORDS: [&str; 10] =
        ["solid", "endsolid", "facet", "vertex", "endfacet", "1e308", "nan", "-1", "", "outer"];
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("thing.stl");
    let mut dice = Dice(3);
    let (mut was_read, mut was_refused) = (0, 0);
    for good in [TEXT.as_bytes().to_vec(), binary(&TWO, 2)] {
        for _ in 0..600 {
            let mut bytes = good.clone();
            for _ in 0..=dice.below(3) {
                spoil(&mut bytes, &mut dice, &WORDS);
            }
            std::fs::write(&path, &bytes).unwrap();
            match stl::read(&path) {
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

/// Regression: what stood in one line was taken for the name of a solid, and text of other kinds for binary.
#[test]
fn what_is_no_stl_is_told_in_its_words() {
    refused(
        TEXT.replace('\n', " ").as_bytes(),
        "line 1: `facet` stands in the line of `solid`; each statement takes a line of its own",
    );
    let facets_in_a_line = TEXT.replace("\nouter", " outer").replace("\nvertex", " vertex");
    refused(facets_in_a_line.as_bytes(), "line 2: `vertex` stands in the line of `facet`");
    refused(b"# Blender\nv 0 0 0\nf 1 1 1\n", "line 1: is text that does not begin with `solid`");
    refused(&[0x89, b'P', b'N', b'G', 0, 0], "6 bytes are neither text nor binary STL");
    // A solid whose name holds the word is none of these.
    assert_eq!(read(TEXT.replace("pyramid", "facet").as_bytes()).unwrap().value.shapes.len(), 2);
}
