//! Materials with light in textures.

use super::file::TexelFile;
use super::pages::Page;
use crate::lightmap::Way;
use crate::map_glb::display::Layer;
use crate::map_glb::document::{
    BaseColour, EmissiveStrength, LightmapTexture, Material, MaterialExtensions, Objects, Specular,
    TextureReference,
};
use crate::map_glb::looks;
use isolux::scene::{Body, Finish};
use isolux::units::Rgb;
use std::collections::HashMap;

/// The second set of texture coordinates.
const LIGHTMAP_SET: u32 = 1;

/// The materials of a document, each once.
#[derive(Default)]
pub(super) struct Materials(HashMap<(u32, bool, bool, Option<u32>, bool), u32>);

impl Materials {
    /// Index of the material of a layer: on a page of the lightmap, or without a map.
    pub(super) fn of(
        &mut self,
        file: &TexelFile<'_>,
        (layer, page, is_textured): (Layer, Option<&Page>, bool),
        objects: &mut Objects,
    ) -> u32 {
        let texture = page.map(|page| page.texture);
        let key = (layer.material, layer.mapped, layer.back, texture, is_textured);
        *self.0.entry(key).or_insert_with(|| {
            objects.materials.push(match page {
                None => bare(file, layer),
                Some(page) if file.target.way() == Way::Lightmap => {
                    beside_lightmap(file, layer, page, is_textured)
                }
                Some(page) => emitting(file, layer, page),
            });
            objects.materials.len() as u32 - 1
        })
    }
}

/// The extensions that materials use, for the head of the document.
pub(super) fn extensions(materials: &[Material]) -> Vec<&'static str> {
    let uses = |has: fn(&MaterialExtensions) -> bool| materials.iter().any(|m| has(&m.extensions));
    [
        ("KHR_materials_specular", uses(|e| e.specular.is_some())),
        ("KHR_materials_emissive_strength", uses(|e| e.emissive_strength.is_some())),
        ("MOZ_lightmap", uses(|e| e.lightmap.is_some())),
    ]
    .into_iter()
    .filter_map(|(name, is_used)| is_used.then_some(name))
    .collect()
}

/// Black but for its emission: no light of the viewer is reflected, not even on a smooth coat.
fn emitting(file: &TexelFile<'_>, layer: Layer, page: &Page) -> Material {
    let mut material = matt(file, layer, Rgb::BLACK, 1.0);
    material.emissive_texture =
        Some(TextureReference { index: page.texture, tex_coord: Some(LIGHTMAP_SET) });
    material.emissive_factor = Some([1.0; 3]);
    material.extensions.emissive_strength = strength(page.strength);
    material
}

/// As in the scene, lit by a page. Gloss counts as diffuse.
fn beside_lightmap(file: &TexelFile<'_>, layer: Layer, page: &Page, is_textured: bool) -> Material {
    let finish = file.scene.materials()[layer.material as usize].finish(layer.back);
    let colour = finish.map_or(Rgb::BLACK, |f| f.diffuse.colour + f.glossy_f0());
    let mut material = matt(file, layer, colour, 1.0);
    material.pbr_metallic_roughness.base_color_texture = finish
        .and_then(|f| f.diffuse.texture)
        .filter(|_| is_textured)
        .map(|index| TextureReference { index, tex_coord: None });
    material.extensions.lightmap = Some(LightmapTexture {
        index: page.texture,
        tex_coord: LIGHTMAP_SET,
        intensity: page.strength,
    });
    if let Some(finish) = finish {
        emit(&mut material, finish);
    }
    material
}

/// Without a map: glass translucent, mirrors grey, luminaires as bright as they are.
fn bare(file: &TexelFile<'_>, layer: Layer) -> Material {
    let body = &file.scene.materials()[layer.material as usize].body;
    let [r, g, b, alpha] = looks::bare_colour(body, layer.back, &|l| file.preview.colour(l));
    let finish = file.scene.materials()[layer.material as usize].finish(layer.back);
    let emitter = finish.filter(|f| f.is_emitter());
    let is_finished = file.target.way() == Way::Preview;
    let shown = Rgb::new(r, g, b);
    let mut material = matt(file, layer, Rgb::BLACK, alpha);
    match emitter.filter(|_| !is_finished) {
        // In the unit of the lightmap.
        Some(finish) => emit(&mut material, finish),
        // Finished colours are emission; elsewhere what has no map is lit by whoever shows it.
        None if is_finished => material.emissive_factor = Some(shown.0),
        None => {
            material.pbr_metallic_roughness.base_color_factor = [r, g, b, alpha];
        }
    }
    if matches!(body, Body::Dielectric(_)) {
        material.alpha_mode = Some("BLEND");
        material.double_sided = Some(true);
    }
    material
}

/// Light of its own, cd/m2.
fn emit(material: &mut Material, finish: &Finish) {
    let peak = finish.luminance_cd_m2.max_channel();
    if peak > 0.0 && peak.is_finite() {
        material.emissive_factor = Some((finish.luminance_cd_m2 / peak).0);
        material.extensions.emissive_strength = strength(peak);
    }
}

/// One is what it is without the extension.
fn strength(emissive_strength: f64) -> Option<EmissiveStrength> {
    (emissive_strength != 1.0).then_some(EmissiveStrength { emissive_strength })
}

/// Lambertian, without the smooth coat that glTF gives every dielectric.
fn matt(file: &TexelFile<'_>, layer: Layer, colour: Rgb, alpha: f64) -> Material {
    let [r, g, b] = colour.map(|c| c.clamp(0.0, 1.0)).0;
    Material {
        name: file.scene.materials()[layer.material as usize].name.clone(),
        pbr_metallic_roughness: BaseColour {
            base_color_factor: [r, g, b, alpha],
            base_color_texture: None,
            metallic_factor: 0.0,
            roughness_factor: 1.0,
        },
        emissive_texture: None,
        emissive_factor: None,
        alpha_mode: None,
        double_sided: None,
        extensions: MaterialExtensions {
            specular: Some(Specular { specular_factor: 0.0 }),
            ..MaterialExtensions::default()
        },
    }
}
