//! Materials, as far as shapes of the scene use them.

use super::buffers::Document;
use super::notes::{Flaw, Notes, no_such};
use super::pictures::{Face, Pictures};
use super::reading::Reading;
use super::texcoord::TexCoord;
use isolux::scene::{Body, Material, Texture};
use isolux::units::Rgb;
use std::collections::HashMap;

/// The material of a shape, and the texture coordinates it asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    pub(super) material: u32,
    pub(super) texcoord: Option<TexCoord>,
}

/// A glTF material, and the bits of the colours it is used with.
type Use = (Option<usize>, [u64; 3], Option<[u64; 3]>);

/// Materials made so far. A glTF material becomes one for every mean vertex colour, and mean of its emissive texture,
/// it is used with.
pub(super) struct Surfaces<'a> {
    document: &'a Document<'a>,
    pictures: Pictures<'a>,
    materials: Vec<Material>,
    known: HashMap<Use, Result<Surface, Flaw>>,
    /// Luminance of unlit white, if unlit materials shine.
    unlit_luminance_cd_m2: Option<f64>,
}

impl<'a> Surfaces<'a> {
    pub(super) fn new(document: &'a Document<'a>, unlit_luminance_cd_m2: Option<f64>) -> Self {
        Self {
            document,
            pictures: Pictures::new(document),
            materials: Vec::new(),
            known: HashMap::new(),
            unlit_luminance_cd_m2,
        }
    }

    /// The emissive texture of a glTF material that emits light, and how it lies on surfaces.
    pub(super) fn emissive(
        &mut self,
        index: Option<usize>,
    ) -> Result<Option<(TexCoord, &Texture)>, Flaw> {
        let record = index.and_then(|index| self.document.root.materials.get(index));
        let emitting = record.filter(|record| {
            let is_unlit = record.extensions.as_ref().is_some_and(|e| e.unlit.is_some());
            !is_unlit && record.emissive_factor.0 != [0.0; 3]
        });
        let Some(info) = emitting.and_then(|record| record.emissive_texture.as_ref()) else {
            return Ok(None);
        };
        let at = |flaw: Flaw| flaw.at("emissiveTexture");
        let texcoord = TexCoord::read(self.document, info).map_err(at)?;
        let picture = self.pictures.picture(info.index.value()).map_err(at)?;
        Ok(Some((texcoord, picture)))
    }

    /// The surface of a glTF material (glTF's default without one) times a colour, its emission times another.
    pub(super) fn surface(
        &mut self,
        index: Option<usize>,
        (tint, glow): (Rgb, Option<Rgb>),
        notes: &mut Notes,
    ) -> Result<Surface, Flaw> {
        let bits = |colour: Rgb| colour.0.map(f64::to_bits);
        let key = (index, bits(tint), glow.map(bits));
        if let Some(known) = self.known.get(&key) {
            return known.clone();
        }
        let made = self.make(index, (tint, glow), notes);
        self.known.insert(key, made.clone());
        made
    }

    /// A face of a cube of surroundings, by the index of its image.
    pub(super) fn face(&mut self, image: usize) -> Result<Face, Flaw> {
        self.pictures.face(image)
    }

    pub(super) fn into_parts(self) -> (Vec<Material>, Vec<Texture>) {
        (self.materials, self.pictures.into_textures())
    }

    fn make(
        &mut self,
        index: Option<usize>,
        (tint, glow): (Rgb, Option<Rgb>),
        notes: &mut Notes,
    ) -> Result<Surface, Flaw> {
        let all = &self.document.root.materials;
        let default = gltf_json::Material::default();
        let (record, name, place) = match index {
            Some(index) => {
                let record =
                    all.get(index).ok_or_else(|| no_such("materials", index, all.len()))?;
                let name = record.name.clone().unwrap_or_else(|| format!("material {index}"));
                (record, name, format!("materials[{index}]"))
            }
            None => (&default, "glTF default".to_owned(), "meshes".to_owned()),
        };
        let document = self.document;
        let mut reading = Reading {
            document,
            record,
            place: &place,
            pictures: &mut self.pictures,
            notes,
            unlit_luminance_cd_m2: self.unlit_luminance_cd_m2,
            glow,
        };
        let body = reading.body(tint).map_err(|flaw| flaw.rooted(&place))?;
        let is_textured =
            matches!(&body, Body::Opaque { front, .. } if front.diffuse.texture.is_some());
        let texcoord = match is_textured {
            true => reading.texcoord().map_err(|flaw| flaw.rooted(&place))?,
            false => None,
        };
        self.materials.push(Material { name, body });
        Ok(Surface { material: self.materials.len() as u32 - 1, texcoord })
    }
}
