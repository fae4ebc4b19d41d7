//! Corners of triangles to vertices: split where charts part.

use super::matching::Matched;
use crate::Problem;
use crate::gltf::Opened;
use isolux::lightmap::{Layout, Side};
use std::collections::{BTreeMap, HashMap};

/// The sides of all triangles of a scene that are in a lightmap.
pub(super) struct Sides<'a>(HashMap<(u32, bool), &'a Side>);

impl<'a> Sides<'a> {
    pub(super) fn of(layout: &'a Layout) -> Self {
        Self(layout.sides.iter().map(|side| ((side.triangle, side.back), side)).collect())
    }
}

/// One page's part of one side of a primitive.
#[derive(Default)]
pub(super) struct Part {
    pub(super) page: u32,
    pub(super) is_back: bool,
    /// The vertex of the file that each vertex is.
    pub(super) vertices: Vec<u32>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) indices: Vec<u32>,
    known: HashMap<(u32, [u32; 2]), u32>,
    /// The first vertex made of one of the file.
    first: HashMap<u32, u32>,
}

impl Part {
    fn add(&mut self, vertex: u32, uv: [f32; 2]) {
        let next = self.vertices.len() as u32;
        let index = *self.known.entry((vertex, uv.map(f32::to_bits))).or_insert(next);
        if index == next {
            self.vertices.push(vertex);
            self.uvs.push(uv);
            self.first.entry(vertex).or_insert(next);
        }
        self.indices.push(index);
    }

    /// Adds a corner of a triangle without area, which has no place of its own.
    fn add_anywhere(&mut self, vertex: u32) {
        let known = self.first.get(&vertex).map_or([0.0; 2], |&index| self.uvs[index as usize]);
        self.add(vertex, known);
    }
}

/// The parts of a shape's primitive, fronts first; none where it carries no map.
pub(super) fn parts(
    opened: &Opened,
    number: usize,
    matched: &Matched,
    sides: &Sides<'_>,
) -> Result<Vec<Part>, Problem> {
    let (origin, shape) = &opened.shapes[number];
    let triangles = opened.triangles(*origin)?;
    let mut parts: BTreeMap<(bool, u32), Part> = BTreeMap::new();
    let mut without_area = Vec::new();
    for ((corners, wound), of_scene) in
        triangles.iter().zip(&shape.triangles).zip(&matched.triangles[number])
    {
        let Some(triangle) = *of_scene else {
            without_area.push(*corners);
            continue;
        };
        for is_back in [false, true] {
            let Some(side) = sides.0.get(&(triangle, is_back)) else { continue };
            let new = || Part { page: side.page, is_back, ..Part::default() };
            let part = parts.entry((is_back, side.page)).or_insert_with(new);
            for k in order(is_back) {
                // The scene may have turned it, as its node is a mirror image.
                let of_side = if wound == corners { k } else { [0, 2, 1][k] };
                part.add(corners[k], side.uvs[of_side]);
            }
        }
    }
    let mut parts: Vec<Part> = parts.into_values().collect();
    if let Some(first) = parts.first_mut() {
        for corners in without_area {
            corners.iter().for_each(|&vertex| first.add_anywhere(vertex));
        }
    }
    Ok(parts)
}

/// Whether a shape of the file carries the map.
pub(super) fn is_lit(matched: &[Option<u32>], sides: &Sides<'_>) -> bool {
    let sides_of = |triangle: u32| [false, true].map(|back| (triangle, back));
    matched.iter().flatten().any(|&t| sides_of(t).iter().any(|side| sides.0.contains_key(side)))
}

const fn order(is_back: bool) -> [usize; 3] {
    if is_back { [0, 2, 1] } else { [0, 1, 2] }
}
