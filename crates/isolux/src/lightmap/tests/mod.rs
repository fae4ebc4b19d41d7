//! Lightmaps of small scenes.

mod arrays;
mod baking;
mod dark;
mod layouts;
mod stitching;

use super::*;
use crate::elements::Subdivision;
use crate::map::{IlluminationMap, Method, Provenance, Standing, VertexLight};
use crate::scene::{Finish, Material, Scene, SceneParts, Shape};
use crate::units::Rgb;

/// A quad from a corner along two edges, divided into so many squares each way.
pub(super) fn quad(name: &str, corner: [f64; 3], edges: [[f64; 3]; 2], cells: u32) -> Shape {
    let at = |i: u32, j: u32| {
        let (s, t) = (f64::from(i) / f64::from(cells), f64::from(j) / f64::from(cells));
        [0, 1, 2].map(|k| corner[k] + s * edges[0][k] + t * edges[1][k])
    };
    let number = |i: u32, j: u32| j * (cells + 1) + i;
    let each = |cells: u32| (0..cells).flat_map(move |j| (0..cells).map(move |i| (i, j)));
    Shape {
        name: name.into(),
        positions: each(cells + 1).map(|(i, j)| at(i, j)).collect(),
        triangles: each(cells)
            .flat_map(|(i, j)| {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
                [[a, b, c], [a, c, d]]
            })
            .collect(),
        ..Shape::default()
    }
}

/// A scene of one-sided white shapes without luminaires.
pub(super) fn scene(shapes: Vec<Shape>) -> Scene {
    let materials = vec![Material::one_sided("white", Finish::diffuse(Rgb::grey(0.8)))];
    Scene::assemble(SceneParts { shapes, materials, ..SceneParts::default() }).unwrap()
}

/// A map of indirect light alone, by a function of place; vertices of which it gives nothing are unknown.
pub(super) fn map(scene: &Scene, lx: impl Fn([f64; 3]) -> Option<f64>) -> IlluminationMap {
    let elements = Subdivision::new(scene).elements();
    let value = |lx: f64| VertexLight {
        indirect_lx: Rgb::grey(lx),
        standard_error_lx: 0.01 * lx,
        indirect_standard_error_lx: 0.01 * lx,
        standing: Standing::Open,
        ..VertexLight::NOTHING
    };
    let values = elements.vertices().iter().map(|v| lx(v.position.into()).map(value)).collect();
    IlluminationMap { elements, values, provenance: provenance() }
}

fn provenance() -> Provenance {
    Provenance {
        scene: "test".into(),
        scene_hash: String::new(),
        version: String::new(),
        method: Method::Hybrid,
        seed: 1,
        increments: 8,
        rays: 0,
        accuracy_target: None,
        fresh: None,
        filter: None,
        unshot: None,
        diffuse_only: false,
        audit: None,
        mixed: Vec::new(),
        complete: true,
        accuracy: None,
    }
}

pub(super) fn settings(texels_per_m: f64) -> LightmapSettings {
    LightmapSettings { texels_per_m: Some(texels_per_m), ..LightmapSettings::default() }
}

pub(super) fn baked(scene: &Scene, map: &IlluminationMap, texels_per_m: f64) -> Lightmap {
    let layout = plan(scene, &settings(texels_per_m), &UvUnwrap).unwrap();
    bake(scene, map, &layout, &mut |_| Pace::Whole).unwrap()
}
