//! Surfaces as viewers other than those of glTF want them.

use super::attributes::seen_lx;
use super::display::{self, Layer, Surface};
use super::looks;
use super::preview::{Preview, luminance_cd_m2};
use super::value_arrays::storable;
use isolux::map::{IlluminationMap, VertexLight};
use isolux::scene::{Scene, Texture};
use isolux::units::Rgb;

/// One side of a shape. Colours are sRGB between 0 and 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Displayed {
    /// Of the shape.
    pub(crate) name: String,
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) normals: Vec<[f32; 3]>,
    /// One a vertex; none where there is no map.
    pub(crate) colours: Vec<[f64; 3]>,
    /// What the map says at each; none where there is no map.
    pub(crate) values: Vec<Option<VertexLight>>,
    /// Corners of triangles, counter-clockwise.
    pub(crate) indices: Vec<u32>,
    /// Of all, where there is no map.
    pub(crate) colour: [f64; 3],
    pub(crate) opacity: f64,
}

/// All surfaces that are shown; textures by their mean colour.
pub(crate) fn displayed(scene: &Scene, map: &IlluminationMap, preview: &Preview) -> Vec<Displayed> {
    let textures: Vec<Rgb> = scene.textures().iter().map(Texture::mean).collect();
    let surfaces = display::surfaces(scene, map).into_iter();
    surfaces.map(|(layer, surface)| one((scene, preview), &textures, layer, surface)).collect()
}

fn one(
    (scene, preview): (&Scene, &Preview),
    textures: &[Rgb],
    layer: Layer,
    surface: Surface,
) -> Displayed {
    let material = &scene.materials()[layer.material as usize];
    let finish = material.finish(layer.back).filter(|_| layer.mapped);
    let texture = finish.and_then(|f| f.diffuse.texture).filter(|_| !surface.uvs.is_empty());
    let texture = texture.map_or(Rgb::WHITE, |t| textures[t as usize]);
    let colour = |value: &Option<VertexLight>| {
        let lx = seen_lx(value.and_then(storable).as_ref());
        let luminance = finish.map_or(Rgb::BLACK, |f| luminance_cd_m2(f, lx));
        preview.colour(luminance * texture).map(srgb)
    };
    let [red, green, blue, opacity] =
        looks::bare_colour(&material.body, layer.back, &|l| preview.colour(l));
    Displayed {
        name: scene.shape_names()[layer.shape as usize].clone(),
        colours: surface.values.iter().map(colour).collect(),
        positions: surface.positions,
        normals: surface.normals,
        values: surface.values,
        indices: surface.indices,
        colour: [red, green, blue].map(srgb),
        opacity,
    }
}

/// The transfer function of IEC 61966-2-1.
pub(super) fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}
