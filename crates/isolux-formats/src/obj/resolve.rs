//! OBJ parts into shapes.

use super::copies::{Copies, Places};
use super::lines::place;
use super::material::Materials;
use super::paint;
use super::reading::Reading;
use super::record::{Corner, ObjFile, Part};
use crate::extent::IMPLAUSIBLE_EXTENT_M;
use crate::findings::Findings;
use crate::polygon;
use isolux::geometry::{Point, Triangle};
use isolux::scene::{SceneParts, Shape, UpAxis};
use std::collections::HashMap;

/// The scene of a file whose indices are all valid.
pub(super) fn resolve(
    file: &ObjFile,
    mut materials: Materials,
    reading: &Reading,
    findings: &mut Findings,
) -> SceneParts {
    let mut shapes = Vec::with_capacity(file.parts.len());
    let places = Places::of(file);
    for (part, material) in file.parts.iter().zip(materials.of_part.clone()) {
        let (shape, vertices) = Builder::new(file, part, &places).shape(material, findings);
        let is_painted = reading.vertex_colours && materials.unknown.contains(&material);
        shapes.push(match is_painted {
            true => paint::painted(shape, &vertices, file, &mut materials, findings),
            false => shape,
        });
    }
    if shapes.iter().all(|shape| shape.triangles.is_empty()) {
        findings.problem("", "there are no faces", "export polygons");
    }
    SceneParts {
        name: findings.file().file_stem().map_or_else(String::new, |s| s.to_string_lossy().into()),
        up: UpAxis::Y,
        shapes,
        materials: materials.list,
        textures: materials.textures,
        ..SceneParts::default()
    }
}

fn warn_of_faces(lines: &[usize], what: &str, remedy: &str, findings: &mut Findings) {
    let Some(&first) = lines.first() else { return };
    let more = match lines.len() {
        1 => String::new(),
        count => format!(" (and {} more)", count - 1),
    };
    findings.warning(place(first), format!("{what}{more}"), remedy);
}

/// Warns of a size that another unit would explain.
pub(super) fn warn_of_units(file: &ObjFile, findings: &mut Findings) {
    let extent = |k: usize| {
        let all = file.positions.iter().map(|p| p[k]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    let largest = (0..3).map(extent).fold(0.0, f64::max);
    if largest > IMPLAUSIBLE_EXTENT_M {
        findings.warning(
            "",
            format!("OBJ names no unit; read as metres, it is {largest:.0} m large"),
            "if it was written in another unit, refer to it from a scene.toml with `units`",
        );
    }
}

/// What is odd about a face.
struct Added {
    crosses_itself: bool,
    /// Nothing is left of it: it has no area.
    is_flat: bool,
}

/// One part while its corners become vertices.
struct Builder<'a> {
    file: &'a ObjFile,
    part: &'a Part,
    copies: Copies<'a>,
    vertex_of: HashMap<Corner, u32>,
    vertices: Vec<Corner>,
    triangles: Vec<[u32; 3]>,
}

impl<'a> Builder<'a> {
    fn new(file: &'a ObjFile, part: &'a Part, places: &'a Places) -> Self {
        Self {
            file,
            part,
            copies: Copies::new(places),
            vertex_of: HashMap::new(),
            vertices: Vec::new(),
            triangles: Vec::new(),
        }
    }

    /// The shape, and the corners of the file that its vertices are.
    fn shape(mut self, material: u32, findings: &mut Findings) -> (Shape, Vec<Corner>) {
        let (mut crossed, mut copied, mut flat) = (Vec::new(), Vec::new(), Vec::new());
        for face in 0..self.part.faces.len() {
            let line = self.part.faces[face].line;
            if self.copies.is_copy(self.part.corners_of(face)) {
                copied.push(line);
                continue;
            }
            let added = self.add_face(face);
            crossed.extend(added.crosses_itself.then_some(line));
            flat.extend(added.is_flat.then_some(line));
        }
        warn_of_faces(
            &crossed,
            "the face crosses itself",
            "triangulate it before export",
            findings,
        );
        let what = "the face lies exactly on another of the same material and is left out";
        warn_of_faces(&copied, what, "remove it; every face has both sides", findings);
        let what = "the face has no area and is left out";
        warn_of_faces(&flat, what, "remove it; its corners lie on one line", findings);
        let shape = Shape {
            name: self.part.name.clone(),
            positions: self
                .vertices
                .iter()
                .map(|c| self.file.positions[c.position as usize])
                .collect(),
            normals: self.normals(),
            uvs: self.uvs(),
            triangles: self.triangles,
            material,
            ..Shape::default()
        };
        (shape, self.vertices)
    }

    fn add_face(&mut self, face: usize) -> Added {
        let face_corners = self.part.corners_of(face);
        let outline: Vec<Point> = face_corners
            .iter()
            .map(|c| Point::from(self.file.positions[c.position as usize]))
            .collect();
        let cut = polygon::triangulate(&outline);
        let mut is_flat = true;
        for triangle in &cut.triangles {
            let corners = triangle.map(|k| outline[k]);
            is_flat &= Triangle { corners }.normal().is_none();
            let triangle = triangle.map(|k| self.vertex(face_corners[k]));
            self.triangles.push(triangle);
        }
        Added { crosses_itself: cut.crosses_itself, is_flat }
    }

    fn vertex(&mut self, corner: Corner) -> u32 {
        *self.vertex_of.entry(corner).or_insert_with(|| {
            self.vertices.push(corner);
            self.vertices.len() as u32 - 1
        })
    }

    /// Vertices without a normal get none (zero), which leaves their triangles flat there.
    fn normals(&self) -> Option<Vec<[f64; 3]>> {
        let any = self.vertices.iter().any(|c| c.normal.is_some());
        let of = |c: &Corner| c.normal.map_or([0.0; 3], |k| self.file.normals[k as usize]);
        any.then(|| self.vertices.iter().map(of).collect())
    }

    /// `v` turned to point downwards.
    fn uvs(&self) -> Option<Vec<[f64; 2]>> {
        let any = self.vertices.iter().any(|c| c.uv.is_some());
        let of = |c: &Corner| c.uv.map_or([0.0; 2], |k| self.file.uvs[k as usize]);
        any.then(|| self.vertices.iter().map(of).map(|[u, v]| [u, 1.0 - v]).collect())
    }
}
