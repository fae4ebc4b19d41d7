//! One glTF material to a [`Body`].

use super::finish::{self, MetallicRoughness};
use super::notes::Flaw;
use super::reading::{Reading, share, share_colour};
use super::texcoord::TexCoord;
use gltf_json::material::AlphaMode;
use gltf_json::texture::Info;
use gltf_json::validation::Checked;
use isolux::scene::{Body, Finish, Reflectance};
use isolux::units::Rgb;

impl Reading<'_, '_> {
    /// The texture coordinates its base colour asks for.
    pub(super) fn texcoord(&self) -> Result<Option<TexCoord>, Flaw> {
        let (info, member) = self.base_info()?;
        info.map(|info| TexCoord::read(self.document, &info))
            .transpose()
            .map_err(|flaw| flaw.at(member))
    }

    /// The texture of the base colour, and its place.
    pub(super) fn base_info(&self) -> Result<(Option<Info>, String), Flaw> {
        let own = || {
            let info = self.record.pbr_metallic_roughness.base_color_texture.clone();
            (info, "pbrMetallicRoughness.baseColorTexture".to_owned())
        };
        let is_unlit = self.record.extensions.as_ref().is_some_and(|e| e.unlit.is_some());
        if is_unlit {
            return Ok(own());
        }
        Ok(self.diffuse_texture()?.unwrap_or_else(own))
    }

    /// What it is made of, its base colour times `tint`.
    pub(super) fn body(&mut self, tint: Rgb) -> Result<Body, Flaw> {
        self.warn_of_what_is_left_out();
        if self.record.extensions.as_ref().is_some_and(|e| e.unlit.is_some()) {
            return self.unlit(tint);
        }
        let pbr = match self.specular_glossiness(tint)? {
            Some(pbr) => pbr,
            None => self.metallic_roughness(tint)?,
        };
        let luminance_cd_m2 = self.luminance_cd_m2()?;
        let transmission = self.transmission()? * (1.0 - pbr.metallic);
        if transmission > 0.0 {
            if !luminance_cd_m2.is_black() {
                self.warn(
                    "emissiveFactor",
                    "light emitted by a transparent material is left out",
                    "make it opaque",
                );
            }
            let has_texture = self.base_info()?.0.is_some();
            return self.dielectric(&pbr, transmission, has_texture);
        }
        Ok(self.opaque(Finish { luminance_cd_m2, ..finish::finish(&pbr) }))
    }

    fn opaque(&self, front: Finish) -> Body {
        let back = if self.record.double_sided { front.clone() } else { Finish::BLACK };
        Body::Opaque { front, back }
    }

    /// KHR_materials_unlit: finished colours, of which only the reader of the file can say whether they are
    /// reflectances or lights.
    fn unlit(&mut self, tint: Rgb) -> Result<Body, Flaw> {
        const MEMBER: &str = "extensions.KHR_materials_unlit";
        let [r, g, b, _] = self.record.pbr_metallic_roughness.base_color_factor.0;
        let base = share_colour([r, g, b], "baseColorFactor")
            .map_err(|flaw| flaw.at("pbrMetallicRoughness"))?
            * tint;
        if let Some(luminance_cd_m2) = self.unlit_luminance_cd_m2 {
            let info = self.record.pbr_metallic_roughness.base_color_texture.as_ref();
            let means = self.mean(info, "pbrMetallicRoughness.baseColorTexture")?;
            let colour = base * means.map_or(Rgb::WHITE, |means| means.colour);
            let luminance_cd_m2 = colour * luminance_cd_m2;
            return Ok(self.opaque(Finish { luminance_cd_m2, ..Finish::BLACK }));
        }
        let what = "an unlit material is taken as diffuse: its base colour is the reflectance";
        let remedy = "if it shines, refer to the file from a scene.toml with unlit_luminance_cd_m2";
        self.warn(MEMBER, what, remedy);
        let base_info = self.base_info()?;
        let (texture, _) = self.base_texture(base_info, 0.0)?;
        let diffuse = Reflectance { colour: base, texture };
        Ok(self.opaque(Finish { diffuse, ..Finish::BLACK }))
    }

    fn warn_of_what_is_left_out(&mut self) {
        let opaque = matches!(self.record.alpha_mode, Checked::Valid(AlphaMode::Opaque));
        if !opaque {
            let what = "alpha is left out: the surface is taken as opaque everywhere";
            self.warn(
                "alphaMode",
                what,
                "model holes as geometry, glass by KHR_materials_transmission",
            );
        }
        if self.record.normal_texture.is_some() {
            let what = "normal maps are left out: surfaces are as smooth as their vertices say";
            self.warn("normalTexture", what, "model what matters for the light as geometry");
        }
        if self.record.occlusion_texture.is_some() {
            let what = "occlusion maps are left out: occlusion is computed";
            self.warn("occlusionTexture", what, "nothing needs to be done");
        }
    }

    fn metallic_roughness(&mut self, tint: Rgb) -> Result<MetallicRoughness, Flaw> {
        let pbr = &self.record.pbr_metallic_roughness;
        let at = |flaw: Flaw| flaw.at("pbrMetallicRoughness");
        let [r, g, b, _] = pbr.base_color_factor.0;
        let base = share_colour([r, g, b], "baseColorFactor").map_err(at)?;
        let metallic = share(pbr.metallic_factor.0, "metallicFactor").map_err(at)?;
        let roughness = share(pbr.roughness_factor.0, "roughnessFactor").map_err(at)?;
        let data = self.metallic_roughness_means()?;
        let metallic = metallic * data[2];
        let base_info = self.base_info()?;
        let (texture, texture_mean) = self.base_texture(base_info, metallic)?;
        Ok(MetallicRoughness {
            base: base * tint,
            texture_mean,
            texture,
            metallic,
            roughness: roughness * data[1],
            dielectric_f0: self.dielectric_f0()?,
            coat: self.coat()?,
        })
    }

    /// Means of the channels of the metallic-roughness texture: green roughness, blue metal.
    fn metallic_roughness_means(&mut self) -> Result<[f64; 3], Flaw> {
        const MEMBER: &str = "pbrMetallicRoughness.metallicRoughnessTexture";
        let info = self.record.pbr_metallic_roughness.metallic_roughness_texture.as_ref();
        Ok(self.mean(info, MEMBER)?.map_or([1.0; 3], |means| means.data))
    }

    fn luminance_cd_m2(&mut self) -> Result<Rgb, Flaw> {
        let factor = Rgb(self.record.emissive_factor.0.map(f64::from));
        let extension = self.record.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
        let strength = extension.map_or(1.0, |e| f64::from(e.emissive_strength.0));
        let luminance = factor * strength;
        if !luminance.is_finite() || factor.min_channel() < 0.0 || strength < 0.0 {
            let what = format!("luminance {:?} times {strength} cd/m2", factor.0);
            return Err(Flaw::new(what, "give finite numbers of zero or more").at("emissiveFactor"));
        }
        Ok(self.glow.map_or(luminance, |glow| luminance * glow))
    }
}
