//! The materials of a scene.

use super::bsdf::{self, Made, USUAL};
use super::record::Element;
use super::scope::Scope;
use super::texture::Pictures;
use isolux::geometry::Transform;
use isolux::scene::{Body, Finish, Material, Texture};
use isolux::units::Rgb;
use std::collections::HashMap;

/// Materials so far, those of equal meaning once.
pub(super) struct Palette<'r> {
    is_replaced: &'r dyn Fn(&str) -> bool,
    pictures: Pictures,
    /// What each `bsdf` is, by where it stands in memory.
    made: HashMap<*const Element, Option<Made>>,
    materials: Vec<Material>,
    index_of: HashMap<(String, String), u32>,
}

/// What a shape is made of.
pub(super) struct Chosen {
    /// Index of the material.
    pub(super) material: u32,
    /// Takes texture coordinates of the shape to those of its picture.
    pub(super) to_uv: Transform,
}

/// What a shape says of its material.
pub(super) struct Asked<'a> {
    pub(super) bsdf: Option<&'a Element>,
    /// The material's name, where its `bsdf` has none.
    pub(super) name: String,
    /// Luminance in front.
    pub(super) luminance_cd_m2: Rgb,
    /// Whether every vertex has texture coordinates.
    pub(super) has_uvs: bool,
}

impl<'r> Palette<'r> {
    pub(super) fn new(is_replaced: &'r dyn Fn(&str) -> bool) -> Self {
        Self {
            is_replaced,
            pictures: Pictures::default(),
            made: HashMap::new(),
            materials: Vec::new(),
            index_of: HashMap::new(),
        }
    }

    pub(super) fn finish(self) -> (Vec<Material>, Vec<Texture>) {
        (self.materials, self.pictures.list)
    }

    /// The mean of what an emitter shows, which may be a picture.
    pub(super) fn pictures(&mut self) -> &mut Pictures {
        &mut self.pictures
    }

    /// The material of a shape; `None` after a problem, `Some(None)` where there is nothing to see.
    pub(super) fn choose<'a>(
        &mut self,
        shape: &'a Element,
        asked: &Asked<'a>,
        scope: &mut Scope<'a, '_>,
    ) -> Option<Option<Chosen>> {
        let id = asked.bsdf.and_then(|bsdf| bsdf.attribute("id"));
        let name = id.unwrap_or(&asked.name);
        if (self.is_replaced)(name) {
            let material =
                self.index(name, Body::Opaque { front: Finish::BLACK, back: Finish::BLACK });
            return Some(Some(Chosen { material, to_uv: Transform::IDENTITY }));
        }
        let made = self.made(asked.bsdf, scope)?;
        let mut body = match made.body {
            Some(body) => body,
            None if asked.luminance_cd_m2.is_black() => return Some(None),
            None => {
                scope.warn(
                    shape,
                    "gives light and lets it pass: it is read as black",
                    "give it another bsdf",
                );
                Body::Opaque { front: Finish::BLACK, back: Finish::BLACK }
            }
        };
        match &mut body {
            Body::Opaque { front, .. } => front.luminance_cd_m2 = asked.luminance_cd_m2,
            Body::Dielectric(_) if asked.luminance_cd_m2.is_black() => {}
            Body::Dielectric(_) => {
                scope.refuse(shape, "is of glass and gives light", "put the light behind it");
                return None;
            }
        }
        if let (Body::Opaque { front, back }, false) = (&mut body, asked.has_uvs) {
            for finish in [front, back] {
                if let Some(picture) = finish.diffuse.texture.take() {
                    scope.warn(
                        shape,
                        "has no texture coordinates that are read: its texture counts by its mean",
                        "export them in the mesh",
                    );
                    let mean = self.pictures.list[picture as usize].mean();
                    finish.diffuse.colour = finish.diffuse.colour * mean;
                }
            }
        }
        Some(Some(Chosen { material: self.index(name, body), to_uv: made.to_uv }))
    }

    fn made<'a>(&mut self, bsdf: Option<&'a Element>, scope: &mut Scope<'a, '_>) -> Option<Made> {
        let Some(bsdf) = bsdf else {
            let body = Body::Opaque { front: Finish::diffuse(USUAL), back: Finish::BLACK };
            return Some(Made { body: Some(body), to_uv: Transform::IDENTITY });
        };
        let key = std::ptr::from_ref(bsdf);
        if let Some(known) = self.made.get(&key) {
            return known.clone();
        }
        let made = bsdf::make(bsdf, &mut self.pictures, scope);
        self.made.insert(key, made.clone());
        made
    }

    fn index(&mut self, name: &str, body: Body) -> u32 {
        let key = (name.to_owned(), format!("{body:?}"));
        let materials = &mut self.materials;
        *self.index_of.entry(key).or_insert_with(|| {
            materials.push(Material { name: name.to_owned(), body });
            materials.len() as u32 - 1
        })
    }
}
