//! Transparent materials: KHR_materials_transmission and KHR_materials_volume.

use super::coats::DEFAULT_IOR;
use super::finish::MetallicRoughness;
use super::notes::Flaw;
use super::reading::{Reading, share};
use gltf_json::texture::Info;
use isolux::scene::{Body, Dielectric};
use isolux::units::Rgb;
use serde::Deserialize;

const TRANSMISSION: &str = "extensions.KHR_materials_transmission";

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Volume {
    thickness_factor: f64,
    thickness_texture: Option<Info>,
    /// Infinite unless given.
    attenuation_distance: Option<f64>,
    attenuation_color: Option<[f32; 3]>,
}

impl Reading<'_, '_> {
    pub(super) fn transmission(&mut self) -> Result<f64, Flaw> {
        let extension = self.record.extensions.as_ref().and_then(|e| e.transmission.as_ref());
        let Some(extension) = extension else { return Ok(0.0) };
        let factor = share(extension.transmission_factor.0, "transmissionFactor")
            .map_err(|flaw| flaw.at(TRANSMISSION))?;
        let member = format!("{TRANSMISSION}.transmissionTexture");
        let means = self.mean(extension.transmission_texture.as_ref(), &member)?;
        Ok(factor * means.map_or(1.0, |means| means.data[0]))
    }

    pub(super) fn dielectric(
        &mut self,
        pbr: &MetallicRoughness,
        transmission: f64,
        has_texture: bool,
    ) -> Result<Body, Flaw> {
        if transmission < 1.0 {
            let what =
                "light that a transparent material would scatter or reflect as metal is absorbed";
            self.warn(TRANSMISSION, what, "use a transmission factor of 1");
        }
        if pbr.roughness > 0.0 {
            self.warn(TRANSMISSION, "rough glass is taken as smooth", "use a roughness of 0");
        }
        if has_texture {
            let what = "a transparent material is tinted by the mean of its texture";
            self.warn(TRANSMISSION, what, "split the surface where its colour changes");
        }
        for name in ["KHR_materials_specular", "KHR_materials_clearcoat"] {
            if self.has_extension(name) {
                let what = "the surface of a transparent material reflects by its index alone";
                self.warn(&format!("extensions.{name}"), what, "say it by KHR_materials_ior");
            }
        }
        let mut ior = self.ior()?.unwrap_or(DEFAULT_IOR);
        if ior == 0.0 {
            let what =
                "a transparent material of infinite refractive index is taken as glass of 1.5";
            self.warn("extensions.KHR_materials_ior", what, "give an index of 1 or more");
            ior = DEFAULT_IOR;
        }
        let transmittance = pbr.base * pbr.texture_mean * transmission;
        let (thin, transmittance) = match self.transmittance_of_half_the_volume()? {
            Some(half) => (false, transmittance * half),
            None => (true, transmittance),
        };
        Ok(Body::Dielectric(Dielectric { ior, transmittance, thin }))
    }

    /// What half of the way through the solid leaves that the surface encloses; `None` for a pane.
    /// Glass of a scene absorbs at its borders: light that enters and leaves once loses what the way of the
    /// length of the stated thickness takes.
    fn transmittance_of_half_the_volume(&mut self) -> Result<Option<Rgb>, Flaw> {
        const NAME: &str = "KHR_materials_volume";
        let place = format!("extensions.{NAME}");
        let Some(volume) = self.extension::<Volume>(NAME)? else { return Ok(None) };
        if volume.thickness_factor < 0.0 {
            let what = format!("thickness {}", volume.thickness_factor);
            let flaw = Flaw::new(what, "give a length of zero or more");
            return Err(flaw.at(format!("{place}.thicknessFactor")));
        }
        if volume.thickness_factor == 0.0 {
            return Ok(None);
        }
        let colour = volume.attenuation_color.unwrap_or([1.0; 3]);
        let Some(distance_m) = volume.attenuation_distance.filter(|_| colour != [1.0; 3]) else {
            return Ok(Some(Rgb::WHITE));
        };
        if distance_m <= 0.0 {
            let flaw = Flaw::new(format!("distance {distance_m}"), "give a length above zero");
            return Err(flaw.at(format!("{place}.attenuationDistance")));
        }
        let [r, g, b] = colour.map(|c| share(c, "attenuationColor"));
        let at = |flaw: Flaw| flaw.at(&place);
        let colour = Rgb::new(r.map_err(at)?, g.map_err(at)?, b.map_err(at)?);
        let means =
            self.mean(volume.thickness_texture.as_ref(), &format!("{place}.thicknessTexture"))?;
        let thickness_m = volume.thickness_factor * means.map_or(1.0, |means| means.data[1]);
        let what = "absorption in a solid is that of its thickness, on every way through";
        self.warn(&place, what, "give the mean length of the ways through it as thickness");
        Ok(Some(colour.map(|c| libm::pow(c, 0.5 * thickness_m / distance_m))))
    }
}
