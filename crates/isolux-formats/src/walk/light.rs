//! The light of a mesh, and which of it is new.

use super::container::Sections;
use super::mesh::{Mesh, Source};
use super::record::{LayerRecord, LightHeader};
use crate::lightmap::shared_exponent;
use half::f16;
use isolux::elements::Elements;
use isolux::map::{Illuminance, IlluminationMap, VertexLight};
use isolux::scene::Scene;
use isolux::units::Rgb;
use rayon::prelude::*;

/// Vertices that are sent together.
const BLOCK: usize = 1024;
/// Other maps are asked this share of the way from a corner to the middle of its element: inside, whatever rounding does.
const INWARDS: f64 = 1e-4;

/// The light of one vertex, as it is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Value {
    direct: u32,
    indirect: u32,
}

/// One value a vertex.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Column {
    values: Vec<Value>,
}

/// The light of all vertices of a mesh: one layer, or one for each group of luminaires. It counts its versions, so that whoever
/// has an older one is sent what has changed.
pub struct Light {
    mesh: u64,
    version: u64,
    layers: Vec<Column>,
    errors: Vec<u16>,
    other: Option<(Column, Vec<u16>)>,
    /// The version in which each block last changed.
    changed: Vec<u64>,
}

impl Light {
    /// The light of the map that the mesh was made of.
    pub fn new(mesh: &Mesh, map: &IlluminationMap) -> Self {
        let (own, errors) = read(mesh, &|source| own(map, source));
        let blocks = errors.len().div_ceil(BLOCK);
        Self {
            mesh: mesh.number,
            version: 1,
            layers: vec![own],
            errors,
            other: None,
            changed: vec![1; blocks],
        }
    }

    /// The same with a layer for each of several parts of the light, whose values at the vertices of the elements are given.
    pub fn with_layers(self, mesh: &Mesh, parts: &[Vec<Option<VertexLight>>]) -> Self {
        let layers = parts.iter().map(|values| {
            read(mesh, &|source| value_of(source, &|vertex| values[vertex as usize])).0
        });
        Self { layers: layers.collect(), ..self }
    }

    /// The same with the values of another map of the same surfaces beside.
    pub fn beside(
        self,
        (scene, mesh): (&Scene, &Mesh),
        own: &IlluminationMap,
        other: &IlluminationMap,
    ) -> Self {
        let places = Places { scene, elements: &own.elements };
        Self { other: Some(read(mesh, &|source| places.read(other, source))), ..self }
    }

    /// The number of the mesh that it is for.
    pub fn mesh(&self) -> u64 {
        self.mesh
    }

    /// Counts from 1.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Takes the values of a map with the same elements of which the same is known; false, and nothing is taken, if it is another.
    pub fn update(&mut self, mesh: &Mesh, map: &IlluminationMap) -> bool {
        if !mesh.is_of(map) {
            return false;
        }
        let (own, errors) = read(mesh, &|source| self::own(map, source));
        self.version += 1;
        let version = self.version;
        let before = self.layers[0].values.par_chunks(BLOCK).zip(self.errors.par_chunks(BLOCK));
        let after = own.values.par_chunks(BLOCK).zip(errors.par_chunks(BLOCK));
        self.changed.par_iter_mut().zip(before.zip(after)).for_each(
            |(changed, (before, after))| {
                if before != after {
                    *changed = version
                }
            },
        );
        self.layers[0] = own;
        self.errors = errors;
        true
    }

    /// The container for a page that has version `since`; nothing for 0.
    pub fn to_bytes(&self, since: u64) -> Vec<u8> {
        let blocks: Vec<usize> =
            (0..self.changed.len()).filter(|&block| self.changed[block] > since).collect();
        let mut sections = Sections::default();
        let errors =
            |sections: &mut Sections, all: &[u16]| sections.u16s(&picked(&blocks, all, |e| *e));
        let header = LightHeader {
            kind: "light",
            mesh: self.mesh,
            version: self.version,
            block_size: BLOCK,
            layers: self.layers.iter().map(|layer| layer.record(&blocks, &mut sections)).collect(),
            standard_error: errors(&mut sections, &self.errors),
            other: self.other.as_ref().map(|(other, _)| other.record(&blocks, &mut sections)),
            other_standard_error: self.other.as_ref().map(|(_, all)| errors(&mut sections, all)),
            blocks: blocks.clone(),
        };
        sections.with_header(&header)
    }
}

impl Column {
    fn record(&self, blocks: &[usize], sections: &mut Sections) -> LayerRecord {
        LayerRecord {
            direct: sections.u32s(&picked(blocks, &self.values, |value| value.direct)),
            indirect: sections.u32s(&picked(blocks, &self.values, |value| value.indirect)),
        }
    }
}

/// A number of each vertex of some blocks.
fn picked<T, N>(blocks: &[usize], all: &[T], number: impl Fn(&T) -> N) -> Vec<N> {
    let of_block = |&block: &usize| &all[block * BLOCK..((block + 1) * BLOCK).min(all.len())];
    blocks.iter().flat_map(of_block).map(number).collect()
}

fn read(
    mesh: &Mesh,
    value: &(dyn Fn(&Source) -> Option<Illuminance> + Sync),
) -> (Column, Vec<u16>) {
    let coded = |source| {
        let value = value(source);
        let [direct, indirect] =
            value.map_or([Rgb::BLACK; 2], |value| [value.direct_lx, value.indirect_lx]);
        let error_lx = value.map_or(f64::NAN, |value| value.standard_error_lx);
        let [direct, indirect] = [direct, indirect].map(|lx| shared_exponent::encode(lx.0));
        (Value { direct, indirect }, f16::from_f64(error_lx).to_bits())
    };
    let (values, errors) = mesh.sources.par_iter().map(coded).unzip();
    (Column { values }, errors)
}

/// The value of the map that the mesh was made of.
fn own(map: &IlluminationMap, source: &Source) -> Option<Illuminance> {
    value_of(source, &|vertex| map.read_at_vertex(vertex))
}

/// The value of a vertex, or the mean of those of its element.
fn value_of(
    source: &Source,
    at_vertex: &dyn Fn(u32) -> Option<VertexLight>,
) -> Option<Illuminance> {
    let vertices = source.element.vertices;
    let light = if source.is_own {
        at_vertex(vertices[usize::from(source.corner)])
    } else {
        VertexLight::mix(vertices.map(|vertex| (at_vertex(vertex), 1.0)))
    };
    light.map(Illuminance::from)
}

/// Where vertices lie on the triangles of the scene.
struct Places<'a> {
    scene: &'a Scene,
    elements: &'a Elements,
}

impl Places<'_> {
    /// The value of another map of the same surfaces.
    fn read(&self, map: &IlluminationMap, source: &Source) -> Option<Illuminance> {
        let element = &source.element;
        let corners = element.vertices.map(|v| self.elements.vertices()[v as usize].position);
        let [a, b, c] = corners;
        let middle = a + ((b - a) + (c - a)) / 3.0;
        let corner = corners[usize::from(source.corner)];
        let place = corner + (middle - corner) * INWARDS;
        let [u, v] = self.scene.triangle(element.triangle).barycentric(place);
        map.interpolate(element.triangle, element.back, u, v)
    }
}
