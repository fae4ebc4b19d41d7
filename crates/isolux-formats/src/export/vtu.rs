//! Unstructured grids of VTK (`.vtu`), as "VTK File Formats" describes them: triangles, arrays of little-endian doubles in
//! base64, each after its length.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use isolux::map::{IlluminationMap, VertexLight};
use isolux::scene::Scene;
use std::fmt::Write;

/// VTK's number of a triangle.
const TRIANGLE: u8 = 5;

/// The file. Unknown values are NaN, which ParaView shows as such. Writing to a string cannot fail.
pub(super) fn write(scene: &Scene, map: &IlluminationMap) -> Vec<u8> {
    let vertices = map.elements.vertices();
    let elements = map.elements.elements();
    let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
        byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
        .to_owned();
    let _ = writeln!(
        text,
        "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData Scalars=\"illuminance_lx\" Normals=\"Normals\">",
        vertices.len(),
        elements.len()
    );
    let normals = vertices.iter().map(|v| <[f64; 3]>::from(v.normal.to_vector()));
    doubles("Normals", 3, normals.flatten(), &mut text);
    let of = |read: fn(&VertexLight) -> f64| {
        map.values.iter().map(move |v| v.as_ref().map_or(f64::NAN, read))
    };
    doubles("illuminance_lx", 1, of(VertexLight::illuminance_lx), &mut text);
    doubles("standard_error_lx", 1, of(|v| v.standard_error_lx), &mut text);
    doubles("direct_lx", 1, of(|v| v.direct_lx.luminance()), &mut text);
    doubles("indirect_lx", 1, of(|v| v.indirect_lx.luminance()), &mut text);
    let rgb = map.values.iter().map(|v| v.as_ref().map_or([f64::NAN; 3], |v| v.total_lx().0));
    doubles("rgb_lx", 3, rgb.flatten(), &mut text);
    text.push_str("</PointData>\n<CellData>\n");
    let integers = |read: fn(&Scene, u32) -> u32| {
        let values: Vec<i64> =
            elements.iter().map(|e| i64::from(read(scene, e.triangle))).collect();
        values
    };
    whole("shape", &integers(Scene::shape_of), &mut text);
    whole("material", &integers(Scene::material_index), &mut text);
    text.push_str("</CellData>\n<Points>\n");
    let positions = vertices.iter().map(|v| <[f64; 3]>::from(v.position));
    doubles("Points", 3, positions.flatten(), &mut text);
    text.push_str("</Points>\n<Cells>\n");
    let corners = elements.iter().flat_map(|e| {
        let [a, b, c] = e.vertices;
        if e.back { [a, c, b] } else { [a, b, c] }
    });
    whole("connectivity", &corners.map(i64::from).collect::<Vec<_>>(), &mut text);
    let offsets: Vec<i64> = (1..=elements.len() as i64).map(|k| 3 * k).collect();
    whole("offsets", &offsets, &mut text);
    array(("UInt8", "types", 1), &vec![TRIANGLE; elements.len()], &mut text);
    text.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text.into_bytes()
}

fn doubles(name: &str, components: u8, values: impl Iterator<Item = f64>, text: &mut String) {
    let bytes: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    array(("Float64", name, components), &bytes, text);
}

fn whole(name: &str, values: &[i64], text: &mut String) {
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    array(("Int64", name, 1), &bytes, text);
}

fn array((kind, name, components): (&str, &str, u8), bytes: &[u8], text: &mut String) {
    let mut block = (bytes.len() as u64).to_le_bytes().to_vec();
    block.extend(bytes);
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{}</DataArray>",
        STANDARD.encode(&block)
    );
}
