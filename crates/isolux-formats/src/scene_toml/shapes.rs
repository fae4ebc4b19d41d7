//! Shapes before they have a material, and into the scene.

use crate::round::turn_inside_out;
use isolux::geometry::{Normal, Point, Transform, Vector};
use isolux::scene::Shape;

/// A shape and the name by which materials are assigned to it; empty for all of a thing.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) slot: String,
    pub(super) shape: Shape,
}

impl Piece {
    /// The only piece of a thing.
    pub(super) fn whole(shape: Shape) -> Self {
        Self { slot: String::new(), shape }
    }
}

/// A shape moved into the scene; the front stays the front where the map mirrors.
pub(super) fn placed(shape: &Shape, scene_from_shape: &Transform) -> Shape {
    let position = |&p: &[f64; 3]| scene_from_shape.point(Point::from(p)).into();
    let normal = |&n: &[f64; 3]| {
        let image = Vector::from(n).normal().and_then(|n| scene_from_shape.normal(n));
        image.map_or([0.0; 3], |n: Normal| n.to_vector().into())
    };
    let mut image = Shape {
        name: shape.name.clone(),
        positions: shape.positions.iter().map(position).collect(),
        normals: shape.normals.as_ref().map(|list| list.iter().map(normal).collect()),
        uvs: shape.uvs.clone(),
        lightmap_uvs: shape.lightmap_uvs.clone(),
        triangles: shape.triangles.clone(),
        material: shape.material,
    };
    if scene_from_shape.determinant() < 0.0 {
        turn_inside_out(&mut image);
    }
    image
}
