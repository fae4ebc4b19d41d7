//! Regressions: files of one kind given where another is read. Each is refused for what it is.

#![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

use isolux_formats::{
    Problem, Problems, gltf, ies, ldt, map_glb, mitsuba, obj, ply, rad, scene_toml, stl,
};
use std::fs;
use std::path::Path;

/// The only problem of a reading that must fail.
#[track_caller]
fn only_problem<T>(read: Result<T, Problems>) -> Problem {
    let Err(Problems(mut found)) = read else { panic!("accepted") };
    assert_eq!(found.len(), 1, "{found:#?}");
    found.remove(0)
}

fn in_file<T>(bytes: &[u8], read: impl Fn(&Path) -> T) -> T {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("file.glb");
    fs::write(&path, bytes).unwrap();
    read(&path)
}

#[test]
fn a_map_given_as_a_scene_was_said_to_have_no_light() {
    let map = br#"{"asset": {"version": "2.0"}, "extras": {"isolux": {"format_version": 1}}}"#;
    let found = only_problem(in_file(map, gltf::read));
    assert_eq!(found.place, "extras.isolux");
    assert!(found.what.contains("illumination map"), "{found}");
    for other in ["[1]", "\"isolux\"", "{\"author\": \"isolux\"}", "null"] {
        let scene = format!(r#"{{"asset": {{"version": "2.0"}}, "extras": {other}}}"#);
        in_file(scene.as_bytes(), gltf::read).unwrap();
    }
}

#[test]
fn a_lightmap_given_as_a_scene_was_lit_by_its_own_light() {
    let baked =
        br#"{"asset": {"version": "2.0"}, "extras": {"isolux_lightmap": {"target": "unity"}}}"#;
    let found = only_problem(in_file(baked, gltf::read));
    assert_eq!(found.place, "extras.isolux_lightmap");
    assert!(found.what.contains("baked"), "{found}");
}

#[test]
fn garbage_with_the_name_of_a_scene_was_said_to_be_faulty_json() {
    for (bytes, what) in [
        (&b""[..], "is empty"),
        (b" \n\0\0", "neither GLB nor JSON"),
        (b"\xef\xbb\xbf\r\n", "is empty"),
        (b"\x7fELF\x02\x01", "neither GLB nor JSON"),
        (b"# Blender\nv 0 0 0\n", "neither GLB nor JSON"),
    ] {
        let found = only_problem(in_file(bytes, gltf::read));
        assert!(found.what.contains(what), "{found}");
    }
}

#[test]
fn version_1_of_gltf_as_a_number_was_said_to_be_faulty_json() {
    let found = only_problem(in_file(br#"{"asset": {"version": 1}}"#, gltf::read));
    assert!(found.what.contains("version `1`"), "{found}");
}

#[test]
fn text_in_utf_16_was_said_to_hold_nothing() {
    let wide = |text: &str| {
        let units: Vec<_> = text.encode_utf16().map(u16::to_le_bytes).collect();
        [b"\xff\xfe", units.as_flattened()].concat()
    };
    let obj = wide("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n");
    assert_eq!(in_file(&obj, obj::read).unwrap().value.shapes.len(), 1);
    let stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
               endfacet\nendsolid s\n";
    assert_eq!(in_file(&wide(stl), stl::read).unwrap().value.shapes.len(), 1);
    let rad = wide("void plastic m 0 0 5 .5 .5 .5 0 0\nm polygon f 0 0 9 0 0 0 1 0 0 0 1 0\n");
    assert_eq!(in_file(&rad, rad::read).unwrap().value.shapes.len(), 1);
    let xml = wide(
        "<?xml version='1.0' encoding='UTF-16'?><scene version='3.0.0'><shape type='rectangle'/></scene>",
    );
    assert_eq!(in_file(&xml, mitsuba::read).unwrap().value.shapes.len(), 1);
    let toml = wide(
        "[materials.m]\ndiffuse = 0.5\n[[geometry]]\nmaterial = 'm'\nrectangle = { corner = [0,0,0], u = [0,2,0], v = [0,0,3] }\n",
    );
    in_file(&toml, scene_toml::read).unwrap();
    let lamp =
        ies::parse(&wide("IESNA:LM-63-2002\n"), Path::new("lamp.ies"), &mut |_| unreachable!());
    assert!(!only_problem(lamp).what.contains("UTF-16"));
}

/// Files of the first Macintosh, and of programs that still write as it did, were said to have no faces.
#[test]
fn a_carriage_return_alone_ended_no_line() {
    let obj = "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r";
    assert_eq!(in_file(obj.as_bytes(), obj::read).unwrap().value.shapes.len(), 1);
    let stl = "solid s\rfacet normal 0 0 1\router loop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 1 0\rendloop\r\
               endfacet\rendsolid s\r";
    assert_eq!(in_file(stl.as_bytes(), stl::read).unwrap().value.shapes.len(), 1);
    let rad =
        "# a comment\rvoid plastic m 0 0 5 .5 .5 .5 0 0\rm polygon f 0 0 9 0 0 0 1 0 0 0 1 0\r";
    assert_eq!(in_file(rad.as_bytes(), rad::read).unwrap().value.shapes.len(), 1);
}

#[test]
fn an_empty_photometric_file_was_said_to_lack_a_line() {
    for bytes in [&b""[..], b"\r\n\r\n", b"\xef\xbb\xbf"] {
        let lamp = ies::parse(bytes, Path::new("a.ies"), &mut |_| unreachable!());
        assert_eq!(only_problem(lamp).what, "is empty");
        assert_eq!(only_problem(ldt::parse(bytes, Path::new("a.ldt"))).what, "is empty");
    }
}

#[test]
fn a_byte_order_mark_before_geometry_was_taken_for_its_first_word() {
    let stl = "\u{feff}solid s\r\nfacet normal 0 0 1\r\nouter loop\r\nvertex 0 0 0\r\nvertex 1 0 0\r\n\
               vertex 0 1 0\r\nendloop\r\nendfacet\r\nendsolid s\r\n";
    assert_eq!(in_file(stl.as_bytes(), stl::read).unwrap().value.shapes.len(), 1);
    let ply = "\u{feff}ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\n\
               property float y\r\nproperty float z\r\nelement face 1\r\n\
               property list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n\
               3 0 1 2\r\n";
    assert_eq!(in_file(ply.as_bytes(), ply::read).unwrap().value.shapes.len(), 1);
}

#[test]
fn a_scene_given_as_a_map_was_to_be_computed_again() {
    for bytes in [&b""[..], b"gl", b"[[geometry]]\n", b"{\"asset\": {\"version\": \"2.0\"}}"] {
        let found = only_problem(in_file(bytes, map_glb::read));
        assert!(found.what.contains("no illumination map"), "{found}");
        assert!(found.remedy.contains("solve it first"), "{found}");
    }
}

#[test]
fn a_missing_scene_was_named_twice() {
    let found = only_problem(gltf::read(Path::new("nowhere/scene.glb")));
    assert_eq!(found.to_string().matches("scene.glb").count(), 1, "{found}");
    let found = only_problem(in_file(b"", |path| gltf::read(path.parent().unwrap())));
    assert!(found.what.contains("not a regular file"), "{found}");
}

#[test]
fn eulumdat_given_as_ies_was_not_told_apart() {
    let text = b"Maker\r\n1\r\n0\r\n1\r\n0\r\n5\r\n";
    let found = only_problem(ies::parse(text, Path::new("a.ies"), &mut |_| unreachable!()));
    assert!(found.remedy.contains("EULUMDAT"), "{found}");
}
