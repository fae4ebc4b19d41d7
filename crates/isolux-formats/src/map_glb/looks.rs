//! Unlit materials: colours are finished, viewers add no light of their own.

use super::display::Layer;
use super::document::{BaseColour, Empty, Material, MaterialExtensions, Objects, TextureReference};
use super::preview::luminance_cd_m2;
use isolux::scene::{Body, Finish, Scene};
use isolux::units::Rgb;
use std::collections::HashMap;

/// Displayed reflectance of mirrors, which show nothing of what they face.
const MIRROR_GREY: f64 = 0.5;
/// How much glass hides.
const GLASS_ALPHA: f64 = 0.25;

/// What a luminance in cd/m2 is shown as.
pub(super) type Colour<'a> = dyn Fn(Rgb) -> [f64; 3] + 'a;

/// The materials of a document, each once.
#[derive(Default)]
pub(super) struct Looks(HashMap<Key, u32>);

#[derive(PartialEq, Eq, Hash)]
struct Key {
    material: u32,
    mapped: bool,
    back: bool,
    texture: Option<u32>,
}

impl Looks {
    /// Index of the material of a layer.
    pub(super) fn of(
        &mut self,
        (scene, colour): (&Scene, &Colour<'_>),
        (layer, texture): (Layer, Option<u32>),
        objects: &mut Objects,
    ) -> u32 {
        // The two mapped sides of a material differ by their texture alone.
        let back = layer.back && !layer.mapped;
        let key = Key { material: layer.material, mapped: layer.mapped, back, texture };
        *self.0.entry(key).or_insert_with(|| {
            let source = &scene.materials()[layer.material as usize];
            let mut look = unlit(&source.name, [1.0; 4]);
            look.pbr_metallic_roughness.base_color_texture =
                texture.map(|index| TextureReference { index, tex_coord: None });
            if !layer.mapped {
                bare(&mut look, &source.body, layer.back, colour);
            }
            objects.materials.push(look);
            objects.materials.len() as u32 - 1
        })
    }
}

fn unlit(name: &str, base_color_factor: [f64; 4]) -> Material {
    Material {
        name: name.to_owned(),
        pbr_metallic_roughness: BaseColour {
            base_color_factor,
            base_color_texture: None,
            metallic_factor: 0.0,
            roughness_factor: 1.0,
        },
        emissive_texture: None,
        emissive_factor: None,
        alpha_mode: None,
        double_sided: None,
        extensions: MaterialExtensions { unlit: Some(Empty {}), ..MaterialExtensions::default() },
    }
}

fn bare(look: &mut Material, body: &Body, back: bool, colour: &Colour<'_>) {
    look.pbr_metallic_roughness.base_color_factor = bare_colour(body, back, colour);
    if matches!(body, Body::Dielectric(_)) {
        look.alpha_mode = Some("BLEND");
        look.double_sided = Some(true);
    }
}

/// Linear colour and opacity without a map: glass translucent, mirrors grey, luminaires as bright as they
/// are.
pub(super) fn bare_colour(body: &Body, back: bool, colour: &Colour<'_>) -> [f64; 4] {
    match body {
        Body::Dielectric(glass) => with_alpha(glass.transmittance, GLASS_ALPHA),
        Body::Opaque { front, back: rear } => {
            with_alpha(opaque(if back { rear } else { front }, colour), 1.0)
        }
    }
}

fn opaque(finish: &Finish, colour: &Colour<'_>) -> Rgb {
    if finish.is_emitter() {
        Rgb(colour(luminance_cd_m2(finish, Rgb::BLACK)))
    } else {
        finish.mirror * MIRROR_GREY
    }
}

fn with_alpha(colour: Rgb, alpha: f64) -> [f64; 4] {
    let [r, g, b] = colour.map(|c| c.clamp(0.0, 1.0)).0;
    [r, g, b, alpha]
}
