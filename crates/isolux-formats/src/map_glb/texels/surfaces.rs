//! The triangles of the scene, grouped by shape, side and page.

use super::file::TexelFile;
use crate::map_glb::backs;
use crate::map_glb::display::{Layer, Surface, is_shown, layer, texture_of, turned};
use isolux::lightmap::Side;
use isolux::scene::Scene;
use std::collections::{BTreeMap, HashMap};

/// All surfaces that are shown, by layer and page of the lightmap.
pub(super) fn all(file: &TexelFile<'_>) -> BTreeMap<(Layer, u32), Surface> {
    let scene = file.scene;
    let mut found: BTreeMap<(Layer, u32), (Surface, Known)> = BTreeMap::new();
    let mut is_mapped = vec![[false; 2]; scene.triangle_count() as usize];
    for side in &file.lightmap.layout.sides {
        is_mapped[side.triangle as usize][usize::from(side.back)] = true;
        let key = (layer(scene, side.triangle, true, side.back), side.page);
        let (surface, known) = found.entry(key).or_default();
        add(scene, side, file.keeps_texture(side), (surface, known));
    }
    for triangle in 0..scene.triangle_count() {
        for back in [false, true] {
            if !is_mapped[triangle as usize][usize::from(back)] && is_shown(scene, triangle, back) {
                let key = (layer(scene, triangle, false, back), 0);
                found.entry(key).or_default().0.add_bare(scene, triangle, back);
            }
        }
    }
    let distance_m = backs::distance_m(scene, file.target);
    let placed = found.into_iter().map(|((layer, page), (mut surface, _))| {
        if layer.back && distance_m > 0.0 {
            backs::stand_off(&mut surface, distance_m);
        }
        ((layer, page), surface)
    });
    placed.collect()
}

/// Vertices by all that they carry, bit for bit.
type Known = HashMap<[u32; 10], u32>;

fn add(
    scene: &Scene,
    side: &Side,
    is_textured: bool,
    (surface, known): (&mut Surface, &mut Known),
) {
    let points = scene.triangle(side.triangle).corners;
    let flat = [scene.geometric_normal(side.triangle); 3];
    let normals = scene.corner_normals(side.triangle).unwrap_or(flat);
    let uvs = scene.corner_uvs(side.triangle).filter(|_| is_textured);
    for k in turned([0, 1, 2], side.back) {
        let normal = if side.back { -normals[k] } else { normals[k] }.to_vector();
        let finite = |t: f64| if (t as f32).is_finite() { t as f32 } else { 0.0 };
        let uv = uvs.map(|uvs| uvs[k].map(finite));
        let [x, y, z] = points[k].to_f32();
        let [u, v] = uv.unwrap_or_default();
        let [s, t] = side.uvs[k];
        let all = [x, y, z, normal.x as f32, normal.y as f32, normal.z as f32, u, v, s, t]
            .map(f32::to_bits);
        let index = *known.entry(all).or_insert_with(|| {
            surface.lightmap_uvs.push([s, t]);
            surface.add_vertex(points[k], normal, uv)
        });
        surface.indices.push(index);
    }
}

impl TexelFile<'_> {
    /// Whether a material refers to its own texture beside the light.
    fn keeps_texture(&self, side: &Side) -> bool {
        self.target.way() == crate::lightmap::Way::Lightmap
            && texture_of(self.scene, side.triangle, side.back).is_some()
    }
}
