//! The elements of a map as chunks of quantized triangles.

use super::container::Sections;
use super::octahedral::octahedral;
use super::origin::origin;
use super::planes::Planes;
use super::record::{Chunk, MeshHeader};
use crate::map_glb::display::{Layer, Shown, texture_of, turned, uv_at, visit};
use isolux::elements::{Element, FewNumbers};
use isolux::geometry::{Point, Vector};
use isolux::map::{IlluminationMap, Standing};
use isolux::scene::Scene;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::hash::{DefaultHasher, Hasher};

/// Vertices that an index of 16 bits can tell apart.
const MOST_VERTICES: usize = 1 << 16;
/// The largest coordinate of a vertex in its chunk.
const LARGEST: f64 = 65_535.0;

/// Where the light of a displayed vertex comes from: one vertex of the elements, or the mean of those of an element that are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Source {
    /// The element that first showed it.
    pub(super) element: Element,
    /// Which of its corners it is.
    pub(super) corner: u8,
    /// Whether that vertex of the elements is read, and not the mean.
    pub(super) is_own: bool,
}

/// The surfaces of a scene as they are drawn: the elements of its map, and what has no map.
pub struct Mesh {
    pub(super) number: u64,
    /// One a vertex with light; those come first.
    pub(super) sources: Vec<Source>,
    /// Of the elements, and of what is known at them.
    fingerprint: u64,
    chunks: Vec<Chunk>,
    positions: Vec<u16>,
    normals: Vec<i8>,
    indices: Vec<u16>,
    uvs: Vec<f32>,
}

impl Mesh {
    /// Cuts the surfaces of a scene into chunks. Meshes with different `number`s are different to the page.
    pub fn new(scene: &Scene, map: &IlluminationMap, number: u64) -> Self {
        let mut made = Self {
            number,
            sources: Vec::new(),
            fingerprint: fingerprint(map),
            chunks: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            indices: Vec::new(),
            uvs: Vec::new(),
        };
        let (lit, bare) = layers(scene, map);
        let lit: Vec<_> = lit.into_iter().collect();
        let built: Vec<Vec<Piece>> = lit
            .par_iter()
            .map(|((layer, _), elements)| Pieces::of_elements((scene, map), *layer, elements))
            .collect();
        built.into_iter().flatten().for_each(|piece| made.add(piece));
        for ((layer, _), triangles) in bare {
            Pieces::of_triangles(scene, layer, &triangles)
                .into_iter()
                .for_each(|piece| made.add(piece));
        }
        made
    }

    /// The number given to it.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Whether a map has the same elements, and is known at the same vertices: then its light fits.
    pub fn is_of(&self, map: &IlluminationMap) -> bool {
        self.fingerprint == fingerprint(map)
    }

    /// How many vertices have light.
    pub fn lit_vertices(&self) -> usize {
        self.sources.len()
    }

    /// The container for the page.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut sections = Sections::default();
        let header = MeshHeader {
            kind: "mesh",
            mesh: self.number,
            chunks: &self.chunks,
            positions: sections.u16s(&self.positions),
            normals: sections.i8s(&self.normals),
            indices: sections.u16s(&self.indices),
            uvs: sections.f32s(&self.uvs),
            lit_vertices: self.sources.len(),
            triangles: self.indices.len() / 3,
        };
        sections.with_header(&header)
    }

    fn add(&mut self, piece: Piece) {
        let low = piece.bounds.map(|[low, _]| low);
        let step = piece.bounds.map(|[low, high]| (high - low) / LARGEST);
        self.chunks.push(Chunk {
            shape: piece.layer.shape,
            finish: finish(piece.layer.material, piece.layer.back),
            back: piece.layer.back,
            lit: piece.layer.mapped,
            first_vertex: self.positions.len() / 3,
            vertices: piece.positions.len(),
            first_index: self.indices.len(),
            indices: piece.indices.len(),
            min: low,
            step,
            first_uv: (!piece.uvs.is_empty()).then_some(self.uvs.len() / 2),
        });
        for position in &piece.positions {
            self.positions.extend((0..3).map(|k| quantized(position[k], low[k], step[k])));
        }
        self.normals.extend(piece.normals.as_flattened());
        self.indices.extend(piece.indices);
        self.uvs.extend(piece.uvs.as_flattened());
        self.sources.extend(piece.sources);
    }
}

/// A number that maps have in common if they have the same vertices, and know the light of the same.
fn fingerprint(map: &IlluminationMap) -> u64 {
    let mut hasher = DefaultHasher::new();
    for (vertex, value) in map.elements.vertices().iter().zip(&map.values) {
        let [x, y, z] = <[f64; 3]>::from(vertex.position).map(f64::to_bits);
        let standing = value.map_or(u64::MAX, |value| value.standing as u64);
        // One word a vertex: hashing all four would take as long as all the rest.
        let mixed = x ^ y.rotate_left(21) ^ z.rotate_left(42) ^ standing;
        hasher.write_u64(mixed);
    }
    hasher.finish()
}

/// The number of a side of a material among all finishes.
pub(super) fn finish(material: u32, back: bool) -> usize {
    2 * material as usize + usize::from(back)
}

fn quantized(value: f64, low: f64, step: f64) -> u16 {
    if step > 0.0 { libm::round((value - low) / step).clamp(0.0, LARGEST) as u16 } else { 0 }
}

/// A layer, or what of it lies in one of a few planes that show what they face.
type Part = (Layer, usize);
type Lit = BTreeMap<Part, Vec<Element>>;
type Bare = BTreeMap<Part, Vec<u32>>;

/// Elements and triangles without, by what they are part of.
fn layers(scene: &Scene, map: &IlluminationMap) -> (Lit, Bare) {
    let (mut lit, mut bare) = (Lit::new(), Bare::new());
    let planes = Planes::new(scene);
    visit(scene, map, &mut |layer, shown| match shown {
        Shown::Element(element) => {
            let part = (layer, planes.of(scene, layer, element.triangle));
            lit.entry(part).or_default().push(element);
        }
        Shown::Bare(triangle) => {
            let part = (layer, planes.of(scene, layer, triangle));
            bare.entry(part).or_default().push(triangle);
        }
    });
    (lit, bare)
}

/// A chunk before it is quantized; all pieces of a layer have its bounds, so that they meet exactly.
struct Piece {
    layer: Layer,
    bounds: [[f64; 2]; 3],
    positions: Vec<[f64; 3]>,
    normals: Vec<[i8; 2]>,
    uvs: Vec<[f32; 2]>,
    indices: Vec<u16>,
    sources: Vec<Source>,
}

/// The pieces of a layer while they are made.
struct Pieces {
    origin: Vector,
    done: Vec<Piece>,
    known: HashMap<(u32, [u32; 2]), u16, FewNumbers>,
    layer: Layer,
}

impl Pieces {
    fn new(scene: &Scene, layer: Layer) -> Self {
        let (origin, known) = (origin(scene), HashMap::default());
        Self { origin, done: Vec::new(), known, layer }
    }

    fn of_elements(
        (scene, map): (&Scene, &IlluminationMap),
        layer: Layer,
        elements: &[Element],
    ) -> Vec<Piece> {
        let mut pieces = Self::new(scene, layer);
        for element in elements {
            pieces.add_element(scene, map, element);
        }
        pieces.finished()
    }

    fn of_triangles(scene: &Scene, layer: Layer, triangles: &[u32]) -> Vec<Piece> {
        let mut pieces = Self::new(scene, layer);
        for &triangle in triangles {
            pieces.add_triangle(scene, triangle);
        }
        pieces.finished()
    }

    /// The last piece, or a new one if another triangle would not fit.
    fn room(&mut self) {
        let is_full = |piece: &Piece| piece.positions.len() + 3 > MOST_VERTICES;
        if self.done.last().is_none_or(is_full) {
            self.known.clear();
            self.done.push(Piece {
                layer: self.layer,
                bounds: [[f64::INFINITY, f64::NEG_INFINITY]; 3],
                positions: Vec::new(),
                normals: Vec::new(),
                uvs: Vec::new(),
                indices: Vec::new(),
                sources: Vec::new(),
            });
        }
    }

    fn add_element(&mut self, scene: &Scene, map: &IlluminationMap, element: &Element) {
        self.room();
        let is_textured = texture_of(scene, element.triangle, element.back).is_some();
        let standings = element.vertices.map(|v| map.values[v as usize].map(|v| v.standing));
        let highest = Standing::highest(standings);
        for corner in turned([0, 1, 2], element.back) {
            let vertex = element.vertices[corner];
            // Where others are in the open, the light of a gap is not shown between them.
            let is_own = standings[corner] == highest;
            let place = &map.elements.vertices()[vertex as usize];
            let uv = is_textured.then(|| uv_at(scene, element.triangle, place.position)).flatten();
            let key = (vertex, uv.unwrap_or_default().map(f32::to_bits));
            let index = match self.known.get(&key).filter(|_| is_own) {
                Some(&index) => index,
                None => {
                    let index = self.add_vertex(place.position, place.normal.to_vector(), uv);
                    let source = Source { element: *element, corner: corner as u8, is_own };
                    self.last().sources.push(source);
                    if is_own {
                        self.known.insert(key, index);
                    }
                    index
                }
            };
            self.last().indices.push(index);
        }
    }

    fn add_triangle(&mut self, scene: &Scene, triangle: u32) {
        self.room();
        let back = self.layer.back;
        let normal = |k: usize| match scene.corner_normals(triangle) {
            Some(normals) => normals[k].to_vector(),
            None => scene.geometric_normal(triangle).to_vector(),
        };
        let corners = scene.triangle(triangle).corners;
        let uvs = texture_of(scene, triangle, back).and_then(|_| scene.corner_uvs(triangle));
        for k in turned([0, 1, 2], back) {
            let front = normal(k);
            let uv = uvs.map(|uvs| uvs[k].map(|t| t as f32));
            let index = self.add_vertex(corners[k], if back { -front } else { front }, uv);
            self.last().indices.push(index);
        }
    }

    fn last(&mut self) -> &mut Piece {
        let last = self.done.len() - 1;
        &mut self.done[last]
    }

    fn add_vertex(&mut self, position: Point, normal: Vector, uv: Option<[f32; 2]>) -> u16 {
        let position = <[f64; 3]>::from(position - self.origin);
        let piece = self.last();
        for (bounds, at) in piece.bounds.iter_mut().zip(position) {
            *bounds = [bounds[0].min(at), bounds[1].max(at)];
        }
        piece.positions.push(position);
        piece.normals.push(octahedral(normal.into()));
        piece.uvs.extend(uv);
        (piece.positions.len() - 1) as u16
    }

    fn finished(mut self) -> Vec<Piece> {
        let mut all = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for piece in &self.done {
            for (all, own) in all.iter_mut().zip(piece.bounds) {
                *all = [all[0].min(own[0]), all[1].max(own[1])];
            }
        }
        self.done.iter_mut().for_each(|piece| piece.bounds = all);
        self.done
    }
}
