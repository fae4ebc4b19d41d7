//! Shapes as triangles, in their own coordinates.

use super::property::{boolean, positive, transform, triple};
use super::record::{Element, Wrong};
use super::scope::Scope;
use crate::round::{inside_out, sincos_of_turn, unit_disc, unit_sphere};
use crate::{bare, obj, ply};
use isolux::geometry::{Direction, Point, Transform, Vector};
use isolux::scene::Shape;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::path::PathBuf;
use std::rc::Rc;

/// Segments of a turn.
const SEGMENTS: u32 = 32;

/// Triangles of a shape, and where they stand.
pub(super) struct Mesh {
    pub(super) shapes: Rc<Vec<Shape>>,
    pub(super) world_from_shape: Transform,
    /// Whether a mirror image keeps the front in front, as Mitsuba has it.
    pub(super) keeps_front: bool,
}

/// Mesh files, each read once.
#[derive(Default)]
pub(super) struct Files(HashMap<PathBuf, Option<Rc<Vec<Shape>>>>);

impl Files {
    /// The triangles of a shape; `None` after a problem. `keeps_area` makes a round one as large as
    /// the surface itself, by a slightly larger radius: of one that emits the flux is to be right.
    pub(super) fn mesh(
        &mut self,
        shape: &Element,
        keeps_area: bool,
        scope: &mut Scope,
    ) -> Option<Mesh> {
        let map = scope.take(&shape.at, transform(shape, "to_world"))?;
        let one = |shape: Shape, keeps_front| Mesh {
            shapes: Rc::new(vec![shape]),
            world_from_shape: map,
            keeps_front,
        };
        match shape.kind() {
            "obj" | "ply" => self.file(shape, map, scope),
            "rectangle" => Some(one(rectangle(), true)),
            "cube" => Some(one(cube(), true)),
            "disk" => Some(one(disk(keeps_area), true)),
            "sphere" => {
                let own = scope.take(&shape.at, ball(shape))?;
                let mesh = one(sphere(keeps_area), false);
                Some(Mesh { world_from_shape: map.then_from(&own), ..mesh })
            }
            "cylinder" => {
                let own = scope.take(&shape.at, pipe(shape))?;
                let mesh = one(cylinder(keeps_area), false);
                Some(Mesh { world_from_shape: map.then_from(&own), ..mesh })
            }
            "serialized" => {
                scope.refuse(
                    shape,
                    "is not read: its format is Mitsuba's own",
                    "export the mesh as .ply or .obj",
                );
                None
            }
            _ => {
                let remedy = "use obj, ply, rectangle, cube, sphere, disk or cylinder";
                scope.refuse(shape, "is not read", remedy);
                None
            }
        }
    }

    fn file(&mut self, shape: &Element, map: Transform, scope: &mut Scope) -> Option<Mesh> {
        let is_obj = shape.kind() == "obj";
        let flat = scope.take(&shape.at, boolean(shape, "face_normals", false))?;
        let flip = scope.take(&shape.at, boolean(shape, "flip_tex_coords", is_obj))?;
        let path = scope.file(shape)?;
        let reach = scope.root.reach();
        let known = self.0.entry(path.clone()).or_insert_with(|| {
            let is_replaced = |_: &str| true;
            let read = if is_obj {
                obj::read_as(
                    &path,
                    &obj::Reading {
                        unit_is_known: true,
                        is_replaced: &is_replaced,
                        materials: obj::Materials::AsMeant,
                        vertex_colours: false,
                        reach,
                    },
                )
            } else {
                let reading = bare::Reading {
                    unit_is_known: true,
                    is_replaced: &is_replaced,
                    vertex_colours: false,
                };
                ply::read_as(&path, &reading)
            };
            scope.notes.findings().absorb(read).map(|parts| Rc::new(parts.shapes))
        });
        let mut shapes = known.clone()?;
        let has_normals = shapes.iter().all(|shape| shape.normals.is_some());
        if !has_normals && !flat {
            scope.warn(
                shape,
                "has no normals and is read as flat, where Mitsuba smooths it",
                "export its normals, or set `face_normals` to true",
            );
        }
        // The readers of both turn `v`, as Mitsuba does where asked.
        if flat || !flip {
            let own = Rc::make_mut(&mut shapes);
            for shape in own {
                if flat {
                    shape.normals = None;
                }
                if !flip {
                    shape.uvs.iter_mut().flatten().for_each(|uv| uv[1] = 1.0 - uv[1]);
                }
            }
        }
        Some(Mesh { shapes, world_from_shape: map, keeps_front: has_normals && !flat })
    }
}

/// From -1 to 1, facing +z.
fn rectangle() -> Shape {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Shape {
        positions: corners.map(|[u, v]| [2.0 * u - 1.0, 2.0 * v - 1.0, 0.0]).into(),
        uvs: Some(corners.into()),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Shape::default()
    }
}

/// From -1 to 1, facing outwards, each face with the whole picture.
fn cube() -> Shape {
    let (mut whole, face) = (Shape { uvs: Some(Vec::new()), ..Shape::default() }, rectangle());
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let first = whole.positions.len() as u32;
            for p in &face.positions {
                let mut q = [side; 3];
                // Seen from outside the corners turn counter-clockwise.
                (q[(axis + 1) % 3], q[(axis + 2) % 3]) = (side * p[0], p[1]);
                whole.positions.push(q);
            }
            whole.triangles.extend(face.triangles.iter().map(|t| t.map(|k| first + k)));
            whole.uvs.iter_mut().for_each(|uvs| uvs.extend(face.uvs.iter().flatten()));
        }
    }
    whole
}

/// How much larger a polygon of the segments must be to have the area of its circle.
fn grown(keeps_area: bool) -> f64 {
    let n = f64::from(SEGMENTS);
    if keeps_area { (TAU / (n * libm::sin(TAU / n))).sqrt() } else { 1.0 }
}

fn scaled(mut shape: Shape, by: f64) -> Shape {
    shape.positions.iter_mut().for_each(|p| *p = p.map(|c| by * c));
    shape
}

/// Of radius 1, facing +z.
fn disk(keeps_area: bool) -> Shape {
    scaled(unit_disc(SEGMENTS, Direction::Z), grown(keeps_area))
}

/// Of radius 1, facing outwards; u around from +x, v down from +z.
fn sphere(keeps_area: bool) -> Shape {
    let mut shape = unit_sphere(SEGMENTS, false, false);
    let (around, down) = (SEGMENTS, SEGMENTS / 2);
    let share = |k: u32, of: u32| f64::from(k) / f64::from(of);
    let uvs =
        (0..=down).flat_map(|j| (0..=around).map(move |k| [share(k, around), share(j, down)]));
    shape.uvs = Some(uvs.collect());
    if !keeps_area {
        return shape;
    }
    let by = (4.0 * PI / area(&shape)).sqrt();
    scaled(shape, by)
}

fn area(shape: &Shape) -> f64 {
    let corner = |k: u32| Point::from(shape.positions[k as usize]);
    let twice = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length()
    };
    0.5 * shape.triangles.iter().map(twice).sum::<f64>()
}

/// Of radius 1 about +z from 0 to 1, open, facing outwards.
fn cylinder(keeps_area: bool) -> Shape {
    let n = f64::from(SEGMENTS);
    let radius = if keeps_area { PI / (n * libm::sin(PI / n)) } else { 1.0 };
    let mut shape = Shape { normals: Some(Vec::new()), ..Shape::default() };
    for k in 0..SEGMENTS {
        let (s, c) = sincos_of_turn(k, SEGMENTS);
        for z in [0.0, 1.0] {
            shape.positions.push([radius * c, radius * s, z]);
            shape.normals.iter_mut().for_each(|list| list.push([c, s, 0.0]));
        }
        let next = (k + 1) % SEGMENTS;
        let [a, b, c, d] = [2 * k, 2 * next, 2 * next + 1, 2 * k + 1];
        shape.triangles.extend([[a, b, c], [a, c, d]]);
    }
    shape
}

/// `center` and `radius` of a sphere.
fn ball(shape: &Element) -> Result<Transform, Wrong> {
    let centre = triple(shape, "center")?.unwrap_or([0.0; 3]);
    let radius = positive(shape, "radius", 1.0)?;
    let scale = Transform::scale(radius, radius, radius);
    Ok(Transform::translation(Vector::from(centre)).then_from(&scale))
}

/// `p0`, `p1` and `radius` of a cylinder.
fn pipe(shape: &Element) -> Result<Transform, Wrong> {
    let from = Vector::from(triple(shape, "p0")?.unwrap_or([0.0; 3]));
    let to = Vector::from(triple(shape, "p1")?.unwrap_or([0.0, 0.0, 1.0]));
    let radius = positive(shape, "radius", 1.0)?;
    let none = || ("its `p0` and `p1` are the same".to_owned(), "give a cylinder a length");
    let axis = (to - from).direction().ok_or_else(none)?;
    let (u, v) = axis.frame();
    Ok(Transform { columns: [u * radius, v * radius, to - from], translation: from })
}

/// A shape in the world.
pub(super) fn placed(shape: &Shape, map: &Transform, keeps_front: bool) -> Shape {
    let mut shape = shape.clone();
    shape.positions.iter_mut().for_each(|p| *p = map.point(Point::from(*p)).into());
    for n in shape.normals.iter_mut().flatten() {
        let image = Vector::from(*n).normal().and_then(|n| map.normal(n));
        *n = image.map_or([0.0; 3], |n| n.to_vector().into());
    }
    if map.determinant() >= 0.0 {
        return shape;
    }
    crate::round::turn_inside_out(&mut shape);
    if keeps_front { shape } else { inside_out(shape) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facing(shape: &Shape) -> impl Iterator<Item = (Vector, Vector)> + '_ {
        shape.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|k| Vector::from(shape.positions[k as usize]));
            ((b - a).cross(c - a), (a + b + c) / 3.0)
        })
    }

    #[test]
    fn solids_face_outwards_and_their_normals_too() {
        for shape in [cube(), sphere(false), sphere(true)] {
            assert!(facing(&shape).all(|(normal, middle)| normal.dot(middle) > 0.0));
        }
        let pipe = cylinder(false);
        assert!(facing(&pipe).all(|(n, m)| n.x * m.x + n.y * m.y > 0.0));
        assert!(facing(&rectangle()).chain(facing(&disk(true))).all(|(n, _)| n.z > 0.0));
    }

    #[test]
    fn areas_are_those_of_round_surfaces_where_asked_for() {
        // Sums of some hundred rounded terms.
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        near(area(&disk(true)), PI);
        near(area(&sphere(true)), 4.0 * PI);
        near(area(&cylinder(true)), TAU);
        near(area(&cube()), 24.0);
        near(area(&rectangle()), 4.0);
        assert!(area(&sphere(false)) < 4.0 * PI);
    }

    #[test]
    fn mirror_images_have_mitsubas_front() {
        let mirror = Transform::scale(1.0, 1.0, -1.0);
        let outwards = |shape: &Shape| facing(shape).all(|(n, m)| n.dot(m) > 0.0);
        assert!(outwards(&placed(&cube(), &mirror, true)));
        let ball = placed(&sphere(false), &mirror, false);
        assert!(facing(&ball).all(|(n, m)| n.dot(m) < 0.0));
        let normals = ball.normals.as_ref().map(|list| Vector::from(list[40]));
        assert!(normals.is_some_and(|n| n.dot(Vector::from(ball.positions[40])) < 0.0));
    }
}
