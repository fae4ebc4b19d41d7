//! The displayed geometry: elements grouped by shape and side, as a viewer wants them.

use isolux::elements::{Element, FewNumbers};
use isolux::geometry::{Point, Vector};
use isolux::map::{IlluminationMap, Standing, VertexLight};
use isolux::scene::{Body, Finish, Scene};
use std::collections::{BTreeMap, HashMap};

/// One side of one shape, with a map or without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Layer {
    pub(crate) shape: u32,
    pub(crate) material: u32,
    pub(crate) mapped: bool,
    pub(crate) back: bool,
}

/// Triangles of a layer; corners turn counter-clockwise seen from the displayed side.
#[derive(Default)]
pub(super) struct Surface {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// Texture coordinates; none unless the layer has a texture.
    pub(super) uvs: Vec<[f32; 2]>,
    /// Places in a lightmap; none without one.
    pub(super) lightmap_uvs: Vec<[f32; 2]>,
    /// What the map says at each vertex; nothing unless the layer has a map.
    pub(super) values: Vec<Option<VertexLight>>,
    pub(super) indices: Vec<u32>,
    known: HashMap<Key, u32, FewNumbers>,
}

/// What makes vertices of a mapped layer the same: vertex of the elements, texture coordinates.
type Key = (u32, [u32; 2]);

/// All layers that are shown, in the order of the shapes.
pub(super) fn surfaces(scene: &Scene, map: &IlluminationMap) -> BTreeMap<Layer, Surface> {
    let mut found: BTreeMap<Layer, Surface> = BTreeMap::new();
    visit(scene, map, &mut |layer, shown| {
        let surface = found.entry(layer).or_default();
        match shown {
            Shown::Element(element) => surface.add_element(scene, map, &element),
            Shown::Bare(triangle) => surface.add_bare(scene, triangle, layer.back),
        }
    });
    found
}

/// A piece of a layer.
pub(crate) enum Shown {
    /// With light.
    Element(Element),
    /// A triangle without.
    Bare(u32),
}

/// Shows all elements, and then the triangles without a map, each with its layer.
pub(crate) fn visit(scene: &Scene, map: &IlluminationMap, see: &mut dyn FnMut(Layer, Shown)) {
    let mut is_mapped = vec![[false; 2]; scene.triangle_count() as usize];
    for element in map.elements.elements() {
        is_mapped[element.triangle as usize][usize::from(element.back)] = true;
        let layer = layer(scene, element.triangle, true, element.back);
        see(layer, Shown::Element(element));
    }
    for triangle in 0..scene.triangle_count() {
        for back in [false, true] {
            if !is_mapped[triangle as usize][usize::from(back)] && is_shown(scene, triangle, back) {
                see(layer(scene, triangle, false, back), Shown::Bare(triangle));
            }
        }
    }
}

pub(super) fn layer(scene: &Scene, triangle: u32, mapped: bool, back: bool) -> Layer {
    let (shape, material) = (scene.shape_of(triangle), scene.material_index(triangle));
    Layer { shape, material, mapped, back }
}

/// Whether a side without map is worth a picture: glass once, for both its sides; black backs of
/// one-sided materials not at all, so that one looks into a room from outside.
pub(super) fn is_shown(scene: &Scene, triangle: u32, back: bool) -> bool {
    match &scene.material(triangle).body {
        Body::Dielectric(_) => !back,
        Body::Opaque { back: rear, .. } => !back || *rear != Finish::BLACK,
    }
}

/// The texture that a side of a triangle shows.
pub(crate) fn texture_of(scene: &Scene, triangle: u32, back: bool) -> Option<u32> {
    scene.corner_uvs(triangle)?;
    scene.material(triangle).finish(back)?.diffuse.texture
}

impl Surface {
    fn add_element(&mut self, scene: &Scene, map: &IlluminationMap, element: &Element) {
        let textured = texture_of(scene, element.triangle, element.back).is_some();
        let known = element.vertices.map(|vertex| map.read_at_vertex(vertex));
        let highest = Standing::highest(known.map(|value| value.map(|v| v.standing)));
        // Where others are in the open, the light of a gap is not shown between them.
        let read = VertexLight::mix(known.map(|value| (value, 1.0)));
        let corners = turned(element.vertices, element.back).map(|vertex| {
            let own = map.read_at_vertex(vertex);
            let is_read = own.map(|v| v.standing) == highest;
            let place = &map.elements.vertices()[vertex as usize];
            let uv = if textured { uv_at(scene, element.triangle, place.position) } else { None };
            let key = (vertex, uv.unwrap_or_default().map(f32::to_bits));
            if let Some(&index) = self.known.get(&key).filter(|_| is_read) {
                return index;
            }
            let index = self.add_vertex(place.position, place.normal.to_vector(), uv);
            self.values.push(if is_read { own } else { read });
            if is_read {
                self.known.insert(key, index);
            }
            index
        });
        self.indices.extend(corners);
    }

    pub(super) fn add_bare(&mut self, scene: &Scene, triangle: u32, back: bool) {
        let normal = |k: usize| match scene.corner_normals(triangle) {
            Some(normals) => normals[k].to_vector(),
            None => scene.geometric_normal(triangle).to_vector(),
        };
        let corners = scene.triangle(triangle).corners;
        for k in turned([0, 1, 2], back) {
            let front = normal(k);
            let index = self.add_vertex(corners[k], if back { -front } else { front }, None);
            self.indices.push(index);
        }
    }

    pub(super) fn add_vertex(
        &mut self,
        position: Point,
        normal: Vector,
        uv: Option<[f32; 2]>,
    ) -> u32 {
        self.positions.push(position.to_f32());
        self.normals.push([normal.x as f32, normal.y as f32, normal.z as f32]);
        self.uvs.extend(uv);
        self.positions.len() as u32 - 1
    }
}

pub(crate) fn turned<T: Copy>([a, b, c]: [T; 3], back: bool) -> [T; 3] {
    if back { [a, c, b] } else { [a, b, c] }
}

/// Texture coordinates at a place on a triangle.
pub(crate) fn uv_at(scene: &Scene, triangle: u32, place: Point) -> Option<[f32; 2]> {
    let uvs = scene.corner_uvs(triangle)?;
    let whole = scene.triangle(triangle);
    let [a, b, c] = whole.corners;
    // Barycentric weights are ratios of areas, measured along the normal of the whole.
    let along = whole.area_vector();
    let share =
        |p: Point, q: Point| (p - place).cross(q - place).dot(along) / along.length_squared();
    let weights = [share(b, c), share(c, a), share(a, b)];
    let mix = |k: usize| (0..3).map(|corner| weights[corner] * uvs[corner][k]).sum::<f64>() as f32;
    // Far coordinates or a triangle near the smallest numbers leave nothing to show.
    Some([mix(0), mix(1)].map(|t| if t.is_finite() { t } else { 0.0 }))
}
