//! What reflects at the surface of a material, in or above its colour: index of refraction, specular, clear coat.

use super::finish::{self, ClearCoat};
use super::notes::Flaw;
use super::reading::{Reading, share};
use gltf_json::texture::Info;
use isolux::units::Rgb;
use serde::Deserialize;

/// KHR_materials_ior, default.
pub(super) const DEFAULT_IOR: f64 = 1.5;

#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Specular {
    specular_factor: f32,
    specular_texture: Option<Info>,
    specular_color_factor: [f32; 3],
    specular_color_texture: Option<Info>,
}

impl Default for Specular {
    fn default() -> Self {
        Self {
            specular_factor: 1.0,
            specular_texture: None,
            specular_color_factor: [1.0; 3],
            specular_color_texture: None,
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct ClearCoatRecord {
    clearcoat_factor: f32,
    clearcoat_texture: Option<Info>,
    clearcoat_roughness_factor: f32,
    clearcoat_roughness_texture: Option<Info>,
    clearcoat_normal_texture: Option<Info>,
}

impl Reading<'_, '_> {
    pub(super) fn ior(&self) -> Result<Option<f64>, Flaw> {
        let Some(ior) = self.record.extensions.as_ref().and_then(|e| e.ior.as_ref()) else {
            return Ok(None);
        };
        let ior = f64::from(ior.ior.0);
        if ior == 0.0 || (ior >= 1.0 && ior.is_finite()) {
            return Ok(Some(ior));
        }
        let flaw = Flaw::new(format!("refractive index {ior}"), "give one of 1 or more");
        Err(flaw.at("extensions.KHR_materials_ior.ior"))
    }

    /// Reflectance of the dielectric at normal incidence. An index of 0 stands for infinity: it reflects
    /// all (KHR_materials_ior); KHR_materials_specular colours it and takes from it.
    pub(super) fn dielectric_f0(&mut self) -> Result<Rgb, Flaw> {
        const NAME: &str = "KHR_materials_specular";
        let ior = self.ior()?.unwrap_or(DEFAULT_IOR);
        let plain = Rgb::grey(if ior == 0.0 { 1.0 } else { finish::f0_from_ior(ior) });
        let Some(specular) = self.extension::<Specular>(NAME)? else { return Ok(plain) };
        let place = format!("extensions.{NAME}");
        let factor = share(specular.specular_factor, "specularFactor").map_err(|f| f.at(&place))?;
        let colour = Rgb(specular.specular_color_factor.map(f64::from));
        if !(colour.is_finite() && colour.min_channel() >= 0.0) {
            let flaw = Flaw::new(format!("colour {:?}", colour.0), "give numbers of zero or more");
            return Err(flaw.at(format!("{place}.specularColorFactor")));
        }
        let share =
            self.mean(specular.specular_texture.as_ref(), &format!("{place}.specularTexture"))?;
        let tint = self.mean(
            specular.specular_color_texture.as_ref(),
            &format!("{place}.specularColorTexture"),
        )?;
        let colour = colour * tint.map_or(Rgb::WHITE, |means| means.colour);
        let factor = factor * share.map_or(1.0, |means| means.alpha);
        Ok((plain * colour).map(|c| c.min(1.0)) * factor)
    }

    /// The clear coat, if there is one.
    pub(super) fn coat(&mut self) -> Result<Option<ClearCoat>, Flaw> {
        const NAME: &str = "KHR_materials_clearcoat";
        let Some(coat) = self.extension::<ClearCoatRecord>(NAME)? else { return Ok(None) };
        let place = format!("extensions.{NAME}");
        let at = |flaw: Flaw| flaw.at(&place);
        let factor = share(coat.clearcoat_factor, "clearcoatFactor").map_err(at)?;
        let roughness =
            share(coat.clearcoat_roughness_factor, "clearcoatRoughnessFactor").map_err(at)?;
        if factor == 0.0 {
            return Ok(None);
        }
        let cover =
            self.mean(coat.clearcoat_texture.as_ref(), &format!("{place}.clearcoatTexture"))?;
        let rough = self.mean(
            coat.clearcoat_roughness_texture.as_ref(),
            &format!("{place}.clearcoatRoughnessTexture"),
        )?;
        if coat.clearcoat_normal_texture.is_some() {
            let what = "normal maps are left out: surfaces are as smooth as their vertices say";
            let member = format!("{place}.clearcoatNormalTexture");
            self.warn(&member, what, "model what matters for the light as geometry");
        }
        Ok(Some(ClearCoat {
            cover: factor * cover.map_or(1.0, |means| means.data[0]),
            roughness: roughness * rough.map_or(1.0, |means| means.data[1]),
        }))
    }
}
