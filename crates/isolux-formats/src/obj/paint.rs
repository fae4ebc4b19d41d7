//! Faces without a material in the colours of their vertices.

use super::material::{Materials, UNKNOWN_REFLECTANCE};
use super::record::{Corner, ObjFile};
use crate::bare::Painter;
use crate::findings::Findings;
use crate::srgb::code;
use isolux::scene::{Finish, Material, Reflectance, Shape};
use isolux::units::Rgb;

/// A shape whose triangles reflect the mean colour of their corners, each of which is a corner of the file.
pub(super) fn painted(
    shape: Shape,
    corners: &[Corner],
    file: &ObjFile,
    materials: &mut Materials,
    findings: &mut Findings,
) -> Shape {
    let grey = [code(UNKNOWN_REFLECTANCE); 3];
    let colour = |k: u32| file.colours.codes(corners[k as usize].position).unwrap_or(grey);
    let mut painter = Painter::default();
    let paint = |triangle: &[u32; 3]| painter.triangle(*triangle, triangle.map(colour));
    let Some(triangles) = shape.triangles.iter().map(paint).collect() else {
        let what = "its triangles have more colours than a texture holds";
        findings.problem("", what, "remove `vertex_colours` and assign materials");
        return shape;
    };
    let (made_of, uvs, texture) = painter.finish();
    materials.textures.push(texture);
    let texture = Some(materials.textures.len() as u32 - 1);
    let diffuse = Reflectance { colour: Rgb::WHITE, texture };
    let name = materials.list[shape.material as usize].name.clone();
    materials.list.push(Material::two_sided(name, Finish { diffuse, ..Finish::BLACK }));
    let of = |list: &[[f64; 3]]| made_of.iter().map(|&k| list[k as usize]).collect();
    Shape {
        positions: of(&shape.positions),
        normals: shape.normals.as_deref().map(of),
        uvs: Some(uvs),
        triangles,
        material: materials.list.len() as u32 - 1,
        ..shape
    }
}
