//! Stanford PLY, binary, with colours and lux (G. Turk, "The PLY polygon file format", 1994).

use crate::map_glb::{Preview, displayed};
use isolux::map::{IlluminationMap, VertexLight};
use isolux::scene::Scene;

/// The file. Vertices are those of the surfaces that carry the map, surface by surface; unknown values are NaN.
pub(super) fn write(scene: &Scene, map: &IlluminationMap, preview: &Preview) -> Vec<u8> {
    let surfaces = displayed(scene, map, preview);
    let mapped = || surfaces.iter().filter(|surface| !surface.colours.is_empty());
    let vertices: usize = mapped().map(|surface| surface.positions.len()).sum();
    let faces: usize = mapped().map(|surface| surface.indices.len() / 3).sum();
    let mut bytes = header(vertices, faces).into_bytes();
    for surface in mapped() {
        for (k, value) in surface.values.iter().enumerate() {
            let place = surface.positions[k].into_iter().chain(surface.normals[k]);
            place.for_each(|c| bytes.extend(c.to_le_bytes()));
            bytes.extend(surface.colours[k].map(|c| (255.0 * c).round() as u8));
            lux(value.as_ref()).into_iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        }
    }
    let mut first = 0;
    for surface in mapped() {
        for corners in surface.indices.as_chunks::<3>().0 {
            bytes.push(3);
            corners.iter().for_each(|&corner| bytes.extend((first + corner).to_le_bytes()));
        }
        first += surface.positions.len() as u32;
    }
    bytes
}

/// What every file begins with.
pub(super) const START: &str =
    "ply\nformat binary_little_endian 1.0\ncomment illumination map of isolux, metres and lux\n";

pub(super) fn header(vertices: usize, faces: usize) -> String {
    let floats = |names: &[&str]| -> String {
        names.iter().map(|name| format!("property float {name}\n")).collect()
    };
    let places = floats(&["x", "y", "z", "nx", "ny", "nz"]);
    let colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let lux = floats(&["illuminance_lx", "standard_error_lx", "direct_lx", "indirect_lx"]);
    format!(
        "{START}element vertex {vertices}\n{places}{colours}{lux}element face {faces}\nproperty list uchar uint \
         vertex_indices\nend_header\n"
    )
}

fn lux(value: Option<&VertexLight>) -> [f32; 4] {
    value.map_or([f32::NAN; 4], |v| {
        [
            v.illuminance_lx(),
            v.standard_error_lx,
            v.direct_lx.luminance(),
            v.indirect_lx.luminance(),
        ]
        .map(|lx| lx as f32)
    })
}
