//! A mesh into a part of a scene.

use super::record::Mesh;
use super::vertices::Vertices;
use crate::bare::{Painter, Part, Reading, UNNAMED};
use crate::counted;
use crate::findings::Findings;
use crate::polygon;
use isolux::geometry::Point;

/// The part that the whole file is; what is wrong goes to the findings.
pub(super) fn part(mesh: Mesh, reading: &Reading, findings: &mut Findings) -> Part {
    let count = mesh.vertices.positions.len();
    if let Some((largest, place)) = &mesh.faces.largest
        && *largest as usize >= count
    {
        let what = format!("index {largest} where there are {count} vertices");
        findings.problem(place, what, "export it again; indices count from 0");
        return Part::default();
    }
    let triangles = triangles(&mesh, findings);
    let Vertices { positions, normals, uvs, colours } = mesh.vertices;
    let uvs = uvs.map(|list| list.into_iter().map(|[u, v]| [u, 1.0 - v]).collect());
    let part = Part {
        material: UNNAMED.to_owned(),
        positions,
        normals,
        uvs,
        triangles,
        ..Part::default()
    };
    match (colours, reading.vertex_colours) {
        (Some(colours), true) => painted(part, &colours, findings),
        (None, true) => {
            findings.problem("", "its vertices have no colours", "remove `vertex_colours`");
            part
        }
        (Some(_), false) if !(reading.is_replaced)(&part.material) => {
            let what = "the colours of its vertices are not used";
            let remedy = "to read them as diffuse reflectance, refer to the file from a scene.toml with \
                          `vertex_colours = true`";
            findings.warning("", what, remedy);
            part
        }
        (_, false) => part,
    }
}

fn triangles(mesh: &Mesh, findings: &mut Findings) -> Vec<[u32; 3]> {
    let mut triangles = mesh.faces.triangles.clone();
    let mut crossed = 0;
    for corners in mesh.faces.polygons() {
        if let [a, b, c] = *corners {
            triangles.push([a, b, c]);
            continue;
        }
        let outline: Vec<Point> =
            corners.iter().map(|&k| Point::from(mesh.vertices.positions[k as usize])).collect();
        let cut = polygon::triangulate(&outline);
        triangles.extend(cut.triangles.iter().map(|t| t.map(|k| corners[k])));
        crossed += usize::from(cut.crosses_itself);
    }
    if crossed > 0 {
        let what = counted(crossed, "face crosses itself", "faces cross themselves");
        findings.warning("", what, "triangulate them before export");
    }
    triangles
}

/// The part with a texture in place of colours.
fn painted(part: Part, colours: &[[u8; 3]], findings: &mut Findings) -> Part {
    let mut painter = Painter::default();
    let paint =
        |corners: &[u32; 3]| painter.triangle(*corners, corners.map(|k| colours[k as usize]));
    let Some(triangles) = part.triangles.iter().map(paint).collect() else {
        let what = "its triangles have more colours than a texture holds";
        findings.problem("", what, "remove `vertex_colours` and assign materials");
        return Part::default();
    };
    let (made_of, uvs, texture) = painter.finish();
    Part {
        positions: made_of.iter().map(|&k| part.positions[k as usize]).collect(),
        normals: part.normals.map(|list| made_of.iter().map(|&k| list[k as usize]).collect()),
        uvs: Some(uvs),
        triangles,
        texture: Some(texture),
        ..part
    }
}
