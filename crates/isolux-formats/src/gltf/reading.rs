//! A glTF material while it is read: what all its extensions take from it.

use super::buffers::Document;
use super::notes::{Flaw, Notes};
use super::pictures::{Means, Pictures};
use gltf_json::texture::Info;
use isolux::units::Rgb;
use serde::de::DeserializeOwned;

/// Factors may exceed one by this much: the rounding of decimal fractions.
const SHARE_ROUNDING: f64 = 1e-6;

/// A material while it is read.
pub(super) struct Reading<'r, 'a> {
    pub(super) document: &'a Document<'a>,
    pub(super) record: &'r gltf_json::Material,
    /// Where it is in the file.
    pub(super) place: &'r str,
    pub(super) pictures: &'r mut Pictures<'a>,
    pub(super) notes: &'r mut Notes,
    /// Luminance of unlit white, if unlit materials shine.
    pub(super) unlit_luminance_cd_m2: Option<f64>,
    /// What its surface shows of the emissive texture in the mean.
    pub(super) glow: Option<Rgb>,
}

impl Reading<'_, '_> {
    pub(super) fn warn(&mut self, member: &str, what: &str, remedy: &str) {
        let place = if member.is_empty() {
            self.place.to_owned()
        } else {
            format!("{}.{member}", self.place)
        };
        self.notes.warn(Flaw::new(what, remedy).at(place));
    }

    /// Index of a texture of the base colour, given with its place, where something will show it, and its mean.
    pub(super) fn base_texture(
        &mut self,
        (info, member): (Option<Info>, String),
        metallic: f64,
    ) -> Result<(Option<u32>, Rgb), Flaw> {
        let Some(info) = info else { return Ok((None, Rgb::WHITE)) };
        let texture = info.index.value();
        let mean = self.pictures.means(texture).map_err(|flaw| flaw.at(&member))?.colour;
        let index = match metallic < 1.0 {
            true => Some(self.pictures.texture(texture).map_err(|flaw| flaw.at(&member))?),
            false => None,
        };
        if metallic > 0.0 {
            let what =
                "the specular colour of a textured metal is taken as the mean of its texture";
            self.warn(&member, what, "split the surface where its colour changes");
        }
        Ok((index, mean))
    }

    /// The means of a texture that cannot be used pixel by pixel.
    pub(super) fn mean(
        &mut self,
        info: Option<&Info>,
        member: &str,
    ) -> Result<Option<Means>, Flaw> {
        let Some(info) = info else { return Ok(None) };
        let means = self.pictures.means(info.index.value()).map_err(|flaw| flaw.at(member))?;
        let name = member.rsplit('.').next().unwrap_or(member);
        let what = format!("only the mean of the {name} is used");
        self.warn(member, &what, "split the surface where it changes");
        Ok(Some(means))
    }

    /// What an extension says that the typed model does not know.
    pub(super) fn extension<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, Flaw> {
        let extensions = self.record.extensions.as_ref().map(|e| &e.others);
        let Some(value) = extensions.and_then(|others| others.get(name)) else { return Ok(None) };
        let read = T::deserialize(value).map(Some);
        read.map_err(|error| {
            Flaw::new(error.to_string(), "export the file again").at(format!("extensions.{name}"))
        })
    }

    pub(super) fn has_extension(&self, name: &str) -> bool {
        self.record.extensions.as_ref().is_some_and(|e| e.others.contains_key(name))
    }
}

pub(super) fn share(value: f32, member: &str) -> Result<f64, Flaw> {
    let value = f64::from(value);
    if (0.0..=1.0 + SHARE_ROUNDING).contains(&value) {
        return Ok(value.min(1.0));
    }
    Err(Flaw::new(format!("{value} is not between 0 and 1"), "give a share").at(member))
}

pub(super) fn share_colour(colour: [f32; 3], member: &str) -> Result<Rgb, Flaw> {
    let [r, g, b] = colour;
    Ok(Rgb::new(share(r, member)?, share(g, member)?, share(b, member)?))
}
