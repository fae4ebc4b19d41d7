//! KHR_materials_pbrSpecularGlossiness, the older kind of material, which goes before metallic-roughness.

use super::finish::MetallicRoughness;
use super::notes::Flaw;
use super::reading::{Reading, share, share_colour};
use gltf_json::texture::Info;
use isolux::units::Rgb;
use serde::Deserialize;

const NAME: &str = "KHR_materials_pbrSpecularGlossiness";
const PLACE: &str = "extensions.KHR_materials_pbrSpecularGlossiness";

#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct SpecularGlossiness {
    diffuse_factor: [f32; 4],
    diffuse_texture: Option<Info>,
    specular_factor: [f32; 3],
    glossiness_factor: f32,
    specular_glossiness_texture: Option<Info>,
}

impl Default for SpecularGlossiness {
    fn default() -> Self {
        Self {
            diffuse_factor: [1.0; 4],
            diffuse_texture: None,
            specular_factor: [1.0; 3],
            glossiness_factor: 1.0,
            specular_glossiness_texture: None,
        }
    }
}

impl Reading<'_, '_> {
    /// The texture of the diffuse colour, where the material is of this kind; and its place.
    pub(super) fn diffuse_texture(&self) -> Result<Option<(Option<Info>, String)>, Flaw> {
        let read = self.extension::<SpecularGlossiness>(NAME)?;
        Ok(read.map(|read| (read.diffuse_texture, format!("{PLACE}.diffuseTexture"))))
    }

    /// The same surface in the words of metallic-roughness: a dielectric with that reflectance.
    pub(super) fn specular_glossiness(
        &mut self,
        tint: Rgb,
    ) -> Result<Option<MetallicRoughness>, Flaw> {
        let Some(read) = self.extension::<SpecularGlossiness>(NAME)? else { return Ok(None) };
        let at = |flaw: Flaw| flaw.at(PLACE);
        let [r, g, b, _] = read.diffuse_factor;
        let diffuse = share_colour([r, g, b], "diffuseFactor").map_err(at)?;
        let specular = share_colour(read.specular_factor, "specularFactor").map_err(at)?;
        let glossiness = share(read.glossiness_factor, "glossinessFactor").map_err(at)?;
        let base = (read.diffuse_texture, format!("{PLACE}.diffuseTexture"));
        let (texture, texture_mean) = self.base_texture(base, 0.0)?;
        let member = format!("{PLACE}.specularGlossinessTexture");
        let means = self.mean(read.specular_glossiness_texture.as_ref(), &member)?;
        Ok(Some(MetallicRoughness {
            base: diffuse * tint,
            texture_mean,
            texture,
            metallic: 0.0,
            roughness: 1.0 - glossiness * means.map_or(1.0, |means| means.alpha),
            dielectric_f0: specular * means.map_or(Rgb::WHITE, |means| means.colour),
            coat: self.coat()?,
        }))
    }
}
