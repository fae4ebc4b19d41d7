//! Maps as `.glb` files whose light is in textures.
//!
//! The geometry is that of the scene, its vertices split where charts end; `TEXCOORD_1` is the place in the lightmap.
//! What the texture holds, and how the material refers to it, is up to the consumer ([`Target`]).

mod file;
mod materials;
mod pages;
mod surfaces;

use super::MapTooLarge;
use super::bytes::Bytes;
use super::document::{Objects, Primitive};
use super::record::{Origin, Sealed};
use super::write::{add_node, add_textures, pack, record};
use super::{Preview, nodes};
use crate::lightmap::{Convention, LightmapFileError, Way};
pub use file::TexelFile;
use materials::Materials;
use pages::Page;
pub(crate) use pages::Picture;
use serde::Serialize;
use serde_json::Value;

/// `extras` of the document.
#[derive(Serialize)]
struct Extras {
    #[serde(flatten)]
    map: Option<Sealed>,
    isolux_lightmap: Note,
}

/// What those need who read the file without its manual.
#[derive(Serialize)]
struct Note {
    target: &'static str,
    /// Of the `.exr` and the `.ktx2` of this target.
    texels: Convention,
    /// What the pictures in this file hold.
    pictures: String,
    texels_per_meter: f64,
    width: u32,
    height: u32,
    pages: u32,
    preview: Preview,
    #[serde(flatten)]
    origin: Origin,
    /// The scene that was written again with its light, where it is not of our making.
    #[serde(skip_serializing_if = "Option::is_none")]
    onto: Option<String>,
}

/// What of a lightmap goes into files that others have made.
pub(crate) struct Parts {
    pub(crate) pictures: Vec<Picture>,
    pub(crate) sampler: Value,
    /// For `extras`, under [`Parts::NOTE`].
    pub(crate) note: Value,
}

impl Parts {
    /// What isolux knows such files by.
    pub(crate) const NOTE: &str = "isolux_lightmap";

    /// For a copy of the scene of that name.
    pub(crate) fn of(file: &TexelFile<'_>, onto: String) -> Result<Self, LightmapFileError> {
        let pictures = pages::pictures(file)?;
        let strengths: Vec<f64> = pictures.iter().map(|picture| picture.strength).collect();
        let note = Note { onto: Some(onto), ..note(file, strengths) };
        let json = |value: Result<Value, _>| value.expect("plain structs with names for keys");
        Ok(Self {
            pictures,
            sampler: json(serde_json::to_value(pages::sampler())),
            note: json(serde_json::to_value(note)),
        })
    }
}

/// The bytes of the file. The same lightmap gives the same bytes.
pub fn write_texels(file: &TexelFile<'_>) -> Result<Vec<u8>, LightmapFileError> {
    let TexelFile { scene, map, .. } = *file;
    let mut bytes = Bytes::default();
    let mut objects = Objects::default();
    let needs_textures = file.with_record || file.target.way() == Way::Lightmap;
    let pictures = match needs_textures {
        true => add_textures(scene, &mut objects, &mut bytes).map_err(too_large)?,
        false => Vec::new(),
    };
    let pages = pages::add(file, &mut objects, &mut bytes)?;
    add_meshes(file, &pages, (&mut objects, &mut bytes));
    nodes::add_cameras(scene, &mut objects);
    let children = (0..objects.nodes.len() as u32).collect();
    objects.nodes.push(nodes::root(scene, children));
    let texels = (&pictures[..], Some(file.lightmap));
    let record = file.with_record.then(|| record((scene, map, &file.preview), texels, &mut bytes));
    // Without lights: all of theirs is in the texels, and a consumer would add it once more.
    let extensions_used = materials::extensions(&objects.materials);
    let extras = Extras {
        map: record.as_ref().map(Sealed::new),
        isolux_lightmap: note(file, pages.iter().map(|page| page.strength).collect()),
    };
    pack((objects, bytes), (extensions_used, Vec::new()), extras).map_err(too_large)
}

fn too_large(MapTooLarge { bytes }: MapTooLarge) -> LightmapFileError {
    LightmapFileError::TooLarge { bytes }
}

fn note(file: &TexelFile<'_>, strengths: Vec<f64>) -> Note {
    let layout = &file.lightmap.layout;
    let pictures = match file.target.way() {
        Way::Preview => {
            "emission: luminance rho E / pi, tone mapped as `preview` says, sRGB".to_owned()
        }
        Way::Emission => {
            "emission: luminance rho E / pi in cd/m2, sRGB, times emissiveStrength".to_owned()
        }
        Way::Lightmap => {
            format!("MOZ_lightmap: {}, sRGB, times intensity", file.target.convention().quantity)
        }
    };
    Note {
        target: file.target.name(),
        texels: file.target.convention(),
        pictures: format!("{pictures}; factors of the pages {strengths:?}"),
        texels_per_meter: layout.texels_per_m,
        width: layout.width,
        height: layout.height,
        pages: layout.pages,
        preview: file.preview,
        origin: Origin::of(file.map),
        onto: None,
    }
}

/// One mesh and one node a shape; a primitive for each of its sides and pages.
fn add_meshes(file: &TexelFile<'_>, pages: &[Page], (objects, bytes): (&mut Objects, &mut Bytes)) {
    let mut materials = Materials::default();
    let mut current = None;
    for ((layer, page), surface) in surfaces::all(file) {
        if current != Some(layer.shape) {
            current = Some(layer.shape);
            add_node(&file.scene.shape_names()[layer.shape as usize], objects);
        }
        let mut sink = super::attributes::Sink { bytes, accessors: &mut objects.accessors };
        let (mut attributes, indices) = sink.geometry(&surface);
        if !surface.lightmap_uvs.is_empty() {
            let places = sink.lightmap_uvs(&surface.lightmap_uvs);
            attributes.lightmap_texcoord = Some(places);
            // glTF wants the first set where there is a second.
            attributes.texcoord = attributes.texcoord.or(Some(places));
        }
        let page = layer.mapped.then(|| &pages[page as usize]);
        let is_textured = !surface.uvs.is_empty();
        let material = materials.of(file, (layer, page, is_textured), objects);
        if let Some(mesh) = objects.meshes.last_mut() {
            mesh.primitives.push(Primitive { attributes, indices, material, extras: None });
        }
    }
}
