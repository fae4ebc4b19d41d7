//! The scene while it is put together.

use super::limits;
use isolux::geometry::{Point, Transform, Vector};
use isolux::scene::{Body, Luminaire, Material, SceneParts, Shape, UpAxis};
use std::collections::HashMap;

use super::frame::Frame;
use crate::round::turn_inside_out;

/// Shapes, materials and luminaires so far.
#[derive(Default)]
pub(super) struct Builder {
    shapes: Vec<Shape>,
    shape_of: HashMap<(u32, String), usize>,
    materials: Vec<Material>,
    material_of: HashMap<String, u32>,
    pub(super) luminaires: Vec<Luminaire>,
    triangles: usize,
}

/// A shape in the world.
pub(super) fn placed(mut shape: Shape, frame: &Frame) -> Shape {
    let map = &frame.world_from_file;
    for p in &mut shape.positions {
        *p = map.point(Point::from(*p)).into();
    }
    let side = if frame.invert { -1.0 } else { 1.0 };
    for n in shape.normals.iter_mut().flatten() {
        let image = Vector::from(*n).normal().and_then(|n| map.normal(n));
        *n = image.map_or([0.0; 3], |n| (n.to_vector() * side).into());
    }
    if (map.determinant() < 0.0) != frame.invert {
        turn_inside_out(&mut shape);
    }
    shape
}

/// The turn (or reflection) of a map that keeps proportions.
pub(super) fn without_scale(map: &Transform) -> Option<Transform> {
    let scale = libm::cbrt(map.determinant().abs());
    let columns = map.columns.map(|column| column / scale);
    let is_turn = columns.iter().all(|c| (c.length() - 1.0).abs() < 1e-6);
    is_turn.then_some(Transform { columns, translation: Vector::ZERO })
}

impl Builder {
    /// The index of a material; equal ones of one name are one.
    pub(super) fn material(&mut self, name: &str, body: &Body) -> u32 {
        let key = format!("{name} {body:?}");
        let materials = &mut self.materials;
        *self.material_of.entry(key).or_insert_with(|| {
            materials.push(Material { name: name.to_owned(), body: body.clone() });
            materials.len() as u32 - 1
        })
    }

    /// Adds a surface; whether there was room. Flat ones of one material whose names differ only
    /// after the last dot, as those of a box, become one shape.
    pub(super) fn surface(&mut self, name: String, material: u32, shape: Shape) -> bool {
        self.triangles += shape.triangles.len();
        if self.triangles > limits::TRIANGLES {
            return false;
        }
        if shape.normals.is_some() {
            self.shapes.push(Shape { name, material, ..shape });
            return true;
        }
        let whole = name.rsplit_once('.').map_or(name.as_str(), |(whole, _)| whole).to_owned();
        let shapes = &mut self.shapes;
        let index = *self.shape_of.entry((material, whole.clone())).or_insert_with(|| {
            shapes.push(Shape { name: whole, material, ..Shape::default() });
            shapes.len() - 1
        });
        let into = &mut self.shapes[index];
        let first = into.positions.len() as u32;
        into.positions.extend(shape.positions);
        into.triangles.extend(shape.triangles.iter().map(|t| t.map(|k| first + k)));
        true
    }

    /// Adds a luminaire; whether there was room.
    pub(super) fn luminaire(&mut self, luminaire: Luminaire) -> bool {
        self.luminaires.push(luminaire);
        self.luminaires.len() <= limits::LUMINAIRES
    }

    pub(super) fn into_parts(self, name: String) -> SceneParts {
        SceneParts {
            name,
            up: UpAxis::Z,
            shapes: self.shapes,
            materials: self.materials,
            luminaires: self.luminaires,
            ..SceneParts::default()
        }
    }
}
