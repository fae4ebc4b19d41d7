//! Which texture coordinates a texture is read with.

use super::buffers::Document;
use super::notes::Flaw;
use gltf_json::texture::{Info, WrappingMode};
use gltf_json::validation::Checked;
use serde_json::Value;

/// A set of texture coordinates and what is done to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TexCoord {
    /// `n` of `TEXCOORD_n`.
    pub(super) set: u32,
    transform: Option<UvTransform>,
    /// Whether the picture repeats beyond its borders, as textures of the scene do.
    pub(super) repeats: bool,
}

/// KHR_texture_transform: scale, then rotation, then offset.
#[derive(Clone, Copy, Debug, PartialEq)]
struct UvTransform {
    offset: [f64; 2],
    rotation_rad: f64,
    scale: [f64; 2],
}

impl TexCoord {
    pub(super) fn read(document: &Document, info: &Info) -> Result<Self, Flaw> {
        let extension = info.extensions.as_ref();
        let transform = extension.and_then(|e| e.others.get("KHR_texture_transform"));
        let set = transform.and_then(|t| t.get("texCoord")).and_then(Value::as_u64);
        Ok(Self {
            set: set.and_then(|set| u32::try_from(set).ok()).unwrap_or(info.tex_coord),
            transform: transform.map(UvTransform::read).transpose()?,
            repeats: repeats(document, info),
        })
    }

    /// The coordinates in the picture of a stored pair.
    pub(super) fn apply(&self, uv: [f64; 2]) -> [f64; 2] {
        self.transform.map_or(uv, |transform| transform.apply(uv))
    }
}

impl UvTransform {
    fn read(value: &Value) -> Result<Self, Flaw> {
        let wrong = |member: &str| {
            Flaw::new("not made of finite numbers", "mend it or leave it out")
                .at(format!("extensions.KHR_texture_transform.{member}"))
        };
        let pair = |member: &str, default: [f64; 2]| match value.get(member) {
            None => Ok(default),
            Some(value) => value
                .as_array()
                .and_then(|list| Some([list.first()?.as_f64()?, list.get(1)?.as_f64()?]))
                .ok_or_else(|| wrong(member)),
        };
        let rotation = value.get("rotation").map_or(Some(0.0), Value::as_f64);
        Ok(Self {
            offset: pair("offset", [0.0; 2])?,
            rotation_rad: rotation.ok_or_else(|| wrong("rotation"))?,
            scale: pair("scale", [1.0; 2])?,
        })
    }

    /// The rotation turns the picture clockwise with `v` downwards, as the extension's own example
    /// of a quarter turn shows.
    fn apply(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (u, v) = (u * self.scale[0], v * self.scale[1]);
        let (sin, cos) = libm::sincos(self.rotation_rad);
        [self.offset[0] + cos * u + sin * v, self.offset[1] - sin * u + cos * v]
    }
}

fn repeats(document: &Document, info: &Info) -> bool {
    let root = &document.root;
    let sampler = root.textures.get(info.index.value()).and_then(|texture| texture.sampler);
    let Some(sampler) = sampler.and_then(|index| root.samplers.get(index.value())) else {
        return true;
    };
    let is_repeat = |wrap| matches!(wrap, Checked::Valid(WrappingMode::Repeat));
    is_repeat(sampler.wrap_s) && is_repeat(sampler.wrap_t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of KHR_texture_transform: the lower left quadrant, turned by 90 degrees.
    #[test]
    fn quarter_turn_of_a_quadrant() {
        let transform = UvTransform {
            offset: [0.0, 1.0],
            rotation_rad: std::f64::consts::FRAC_PI_2,
            scale: [0.5, 0.5],
        };
        for (stored, expected) in [
            ([0.0, 0.0], [0.0, 1.0]),
            ([1.0, 0.0], [0.0, 0.5]),
            ([0.0, 1.0], [0.5, 1.0]),
            ([1.0, 1.0], [0.5, 0.5]),
        ] {
            let found = transform.apply(stored);
            // The cosine of a quarter turn rounds to 6e-17.
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{stored:?}");
        }
    }
}
