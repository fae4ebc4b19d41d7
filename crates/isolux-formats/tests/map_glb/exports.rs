//! Maps for other software.

use super::{map, parts, scene};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isolux::map::VertexLight;
use isolux::scene::{Scene, SceneParts};
use isolux_formats::export::{ExportKind, export};
use isolux_formats::map_glb::Preview;
use roxmltree::{Document, ParsingOptions};

fn exported(kind: ExportKind) -> Vec<u8> {
    let scene = scene();
    let map = map(&scene);
    export(&scene, &map, &Preview::automatic(&scene, &map), kind)
}

fn text(kind: ExportKind) -> String {
    String::from_utf8(exported(kind)).unwrap()
}

fn xml(text: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).unwrap()
}

/// The values of an array, after their length in bytes.
fn vtk_array(document: &Document, name: &str) -> Vec<[u8; 8]> {
    let node = document.descendants().find(|n| n.attribute("Name") == Some(name)).unwrap();
    let bytes = STANDARD.decode(node.text().unwrap()).unwrap();
    let (length, values) = bytes.split_at(8);
    assert_eq!(u64::from_le_bytes(length.try_into().unwrap()), values.len() as u64, "{name}");
    values.as_chunks::<8>().0.to_vec()
}

#[test]
fn vtk_keeps_every_bit() {
    let (scene, text) = (scene(), text(ExportKind::Vtu));
    let (map, document) = (map(&scene), xml(&text));
    let read = |name: &str| -> Vec<f64> {
        vtk_array(&document, name).into_iter().map(f64::from_le_bytes).collect()
    };
    for (name, value) in [
        ("illuminance_lx", VertexLight::illuminance_lx as fn(&VertexLight) -> f64),
        ("standard_error_lx", |v| v.standard_error_lx),
        ("indirect_lx", |v| v.indirect_lx.luminance()),
    ] {
        let found = read(name);
        assert_eq!(found.len(), map.values.len());
        for (found, kept) in found.iter().zip(&map.values) {
            match kept {
                Some(kept) => assert_eq!(found.to_bits(), value(kept).to_bits(), "{name}"),
                None => assert!(found.is_nan(), "{name}"),
            }
        }
    }
    let places: Vec<[f64; 3]> =
        map.elements.vertices().iter().map(|v| <[f64; 3]>::from(v.position)).collect();
    assert_eq!(read("Points"), places.concat());
    let cells = map.elements.elements().len();
    let corners = vtk_array(&document, "connectivity").into_iter().map(i64::from_le_bytes);
    assert_eq!(corners.clone().count(), 3 * cells);
    assert!(corners.max().unwrap() < map.values.len() as i64);
    let mut ends = vtk_array(&document, "offsets").into_iter().map(i64::from_le_bytes);
    assert_eq!(ends.next_back(), Some(3 * cells as i64));
}

#[test]
fn tables_have_a_row_a_vertex_and_nothing_where_nothing_is_known() {
    let (scene, text) = (scene(), text(ExportKind::Csv));
    let map = map(&scene);
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = header.iter().position(|name| *name == "illuminance_lx").unwrap();
    assert_eq!(rows.len(), map.values.len());
    let mut unknown = 0;
    for (row, value) in rows.iter().zip(&map.values) {
        assert_eq!(row.len(), header.len());
        match value {
            Some(value) => {
                let written: f64 = row[column].parse().unwrap();
                // Two digits below the first of the error: half a hundredth of it at most.
                let off = (written - value.illuminance_lx()).abs();
                assert!(off <= 0.005 * value.standard_error_lx, "{written}");
            }
            None => {
                unknown += 1;
                assert_eq!(row[column], "");
            }
        }
    }
    assert!(unknown > 0, "the example has unknown places");
}

#[test]
fn polygon_files_are_as_long_as_their_header_says() {
    let bytes = exported(ExportKind::Ply);
    let end = b"end_header\n";
    let start = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = std::str::from_utf8(&bytes[..start]).unwrap();
    let count = |element: &str| -> usize {
        let line = header.lines().find(|line| line.starts_with(element)).unwrap();
        line.rsplit(' ').next().unwrap().parse().unwrap()
    };
    let (vertices, faces) = (count("element vertex"), count("element face"));
    // Ten floats and three bytes a vertex; a byte and three numbers of four bytes a face.
    let row = 10 * 4 + 3;
    assert_eq!(bytes.len() - start, vertices * row + faces * 13);
    let body = &bytes[start + vertices * row..];
    let corners = body.chunks(13).flat_map(|face| face[1..].as_chunks::<4>().0.to_vec());
    assert!(corners.map(u32::from_le_bytes).all(|corner| (corner as usize) < vertices));
}

#[test]
fn walk_throughs_agree_with_each_other() {
    let (vrml, x3d) = (text(ExportKind::Vrml), text(ExportKind::X3d));
    let document = xml(&x3d);
    let count = |name: &str| document.descendants().filter(|n| n.has_tag_name(name)).count();
    assert_eq!(vrml.matches("IndexedFaceSet").count(), count("IndexedFaceSet"));
    assert_eq!(vrml.matches("Color {").count(), count("Color"));
    assert_eq!(vrml.matches("Viewpoint {").count(), count("Viewpoint"));
    assert!(count("Color") > 0 && count("Viewpoint") == 1);
    for shape in document.descendants().filter(|n| n.has_tag_name("IndexedFaceSet")) {
        let numbers = |tag: &str, key: &str| {
            let node = shape.children().find(|n| n.has_tag_name(tag));
            node.map(|n| n.attribute(key).unwrap().split_whitespace().count())
        };
        let points = numbers("Coordinate", "point").unwrap() / 3;
        let indices = shape.attribute("coordIndex").unwrap().split_whitespace();
        let corners: Vec<i64> = indices.map(|i| i.parse().unwrap()).collect();
        assert!(corners.iter().all(|&corner| corner < points as i64));
        // Colours are by vertex: as many as there are points.
        assert!(numbers("Color", "color").is_none_or(|colours| colours == 3 * points));
    }
}

#[test]
fn names_cannot_break_out() {
    let name = "a \"quoted\" <name> & \\ more\n";
    let parts = SceneParts { name: name.into(), ..parts() };
    let scene = Scene::assemble(parts).unwrap();
    let map = map(&scene);
    let written = |kind| {
        let bytes = export(&scene, &map, &Preview::automatic(&scene, &map), kind);
        String::from_utf8(bytes).unwrap()
    };
    let x3d = written(ExportKind::X3d);
    let world = xml(&x3d)
        .descendants()
        .find(|n| n.has_tag_name("WorldInfo"))
        .unwrap()
        .attribute("title")
        .map(str::to_owned);
    // XML reads the end of a line in an attribute as a space.
    assert_eq!(world.as_deref(), Some("a \"quoted\" <name> & \\ more "));
    let vrml = written(ExportKind::Vrml);
    assert!(vrml.contains(r#"title "a \"quoted\" <name> & \\ more"#), "{}", &vrml[..200]);
}
