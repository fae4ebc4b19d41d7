//! From the bytes of a `.glb` to a map.

use crate::map::{IlluminationMap, Light, Surface};
use bevy_asset::io::Reader;
use bevy_asset::{AssetLoader, LoadContext};
use bevy_math::Quat;
use bevy_reflect::TypePath;
use gltf::accessor::{Item, Iter};
use gltf::{Gltf, Node, Primitive, Semantic};
use serde::Deserialize;
use std::fmt;

/// Reads [`IlluminationMap`]s from `.glb` files.
#[derive(Default, TypePath)]
pub struct IlluminationLoader;

/// Why a file is no map, with its remedy. Bevy names the file.
#[derive(Debug)]
pub enum Trouble {
    /// It cannot be read.
    File(std::io::Error),
    /// It is no glTF.
    Gltf(gltf::Error),
    /// It is one, but something that it needs is missing or wrong.
    Light(String),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(error) => write!(f, "cannot be read: {error}"),
            Self::Gltf(error) => write!(f, "is no binary glTF: {error}"),
            Self::Light(what) => {
                write!(f, "{what}; write it by `isolux export map.glb -o light.glb --lux`")
            }
        }
    }
}

impl std::error::Error for Trouble {}

impl AssetLoader for IlluminationLoader {
    type Asset = IlluminationMap;
    type Settings = ();
    type Error = Trouble;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        (): &(),
        _: &mut LoadContext<'_>,
    ) -> Result<IlluminationMap, Trouble> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await.map_err(Trouble::File)?;
        read(&bytes)
    }

    fn extensions(&self) -> &[&str] {
        &["glb"]
    }
}

/// What the file says of itself.
#[derive(Deserialize, Default)]
struct Extras {
    isolux: Option<Record>,
    isolux_vertices: Option<Note>,
}

#[derive(Deserialize)]
struct Record {
    preview: Preview,
}

#[derive(Deserialize)]
struct Preview {
    exposure_m2_cd: f32,
}

#[derive(Deserialize)]
struct Note {
    exposure_m2_cd: f32,
    groups: Option<Vec<String>>,
}

/// What it says of a primitive.
#[derive(Deserialize)]
struct Reflection {
    reflectance: [f32; 3],
    luminance_cd_m2: [f32; 3],
}

/// Reads a map.
pub(crate) fn read(bytes: &[u8]) -> Result<IlluminationMap, Trouble> {
    let Gltf { document, blob } = Gltf::from_slice(bytes).map_err(Trouble::Gltf)?;
    let blob = blob.unwrap_or_default();
    let extras = document.as_json().extras.as_ref();
    let extras: Extras =
        extras.map_or(Ok(Extras::default()), |extras| serde_json::from_str(extras.get())).map_err(
            |error| Trouble::Light(format!("its `extras` are not those of isolux ({error})")),
        )?;
    let exposure = extras.isolux_vertices.as_ref().map(|note| note.exposure_m2_cd);
    let exposure = exposure.or(extras.isolux.map(|record| record.preview.exposure_m2_cd));
    let groups = extras.isolux_vertices.and_then(|note| note.groups).unwrap_or_default();
    let root = document.default_scene().and_then(|scene| scene.nodes().next());
    let root = root.ok_or_else(|| Trouble::Light("it has no scene".to_owned()))?;
    let (_, rotation, _) = root.transform().decomposed();
    let mut map = IlluminationMap {
        groups,
        exposure_m2_cd: exposure.unwrap_or(1.0),
        world_from_scene: Quat::from_array(rotation),
        surfaces: Vec::new(),
    };
    for node in root.children().chain([root.clone()]) {
        let surfaces = surfaces(&node, map.groups.len(), &blob)?;
        map.surfaces.extend(surfaces);
    }
    match map.surfaces.is_empty() {
        true => Err(Trouble::Light("no surface carries lux at its vertices".to_owned())),
        false => Ok(map),
    }
}

/// The surfaces of a node that carry light.
fn surfaces(node: &Node<'_>, groups: usize, blob: &[u8]) -> Result<Vec<Surface>, Trouble> {
    let primitives = node.mesh().into_iter().flat_map(|mesh| {
        let lit: Vec<Primitive<'_>> =
            mesh.primitives().filter(|p| has(p, "ILLUMINANCE_LX")).collect();
        lit
    });
    let shape = node.name().unwrap_or_default();
    primitives
        .map(|primitive| surface(shape, &Attributes { shape, primitive, blob }, groups))
        .collect()
}

fn has(primitive: &Primitive<'_>, name: &str) -> bool {
    primitive.get(&Semantic::Extras(name.to_owned())).is_some()
}

/// The attributes of a primitive.
struct Attributes<'a> {
    shape: &'a str,
    primitive: Primitive<'a>,
    blob: &'a [u8],
}

fn surface(shape: &str, of: &Attributes<'_>, groups: usize) -> Result<Surface, Trouble> {
    let reader = of.primitive.reader(|_| Some(of.blob));
    let positions: Vec<[f32; 3]> = of.read(&Semantic::Positions)?;
    let count = positions.len();
    let own = |name: &str| Semantic::Extras(name.to_owned());
    let light = |lx: &str, error: &str| {
        let (rgb_lx, errors_lx) = (of.read(&own(lx))?, of.read(&own(error))?);
        Ok::<_, Trouble>(Light { rgb_lx, errors_lx })
    };
    let of_group = |k: usize| light(&format!("GROUP_{k}_LX"), &format!("GROUP_{k}_STDERR_LX"));
    let material = of.primitive.material();
    let texture = material.pbr_metallic_roughness().base_color_texture();
    let texture_png = texture.and_then(|t| of.picture(&t.texture().source().source()));
    let indices = reader.read_indices().ok_or_else(|| of.wrong("it has no indices"))?;
    let indices: Vec<u32> = indices.into_u32().collect();
    let extras = of.primitive.extras().as_ref();
    let reflection =
        extras.and_then(|extras| serde_json::from_str::<Reflection>(extras.get()).ok());
    let surface = Surface {
        shape: shape.to_owned(),
        material: material.name().unwrap_or_default().to_owned(),
        texture_png,
        normals: of.read(&Semantic::Normals)?,
        uvs: reader.read_tex_coords(0).map(|uvs| uvs.into_f32().collect()).unwrap_or_default(),
        triangles: indices.as_chunks::<3>().0.to_vec(),
        whole: light("ILLUMINANCE_LX", "STDERR_LX")?,
        direct_lx: of.read(&own("DIRECT_LX"))?,
        groups: (0..groups).map(of_group).collect::<Result<_, _>>()?,
        reflection: reflection.map(|of| [of.reflectance, of.luminance_cd_m2]),
        colours: reader.read_colors(0).map(|c| c.into_rgba_f32().collect()).unwrap_or_default(),
        positions,
    };
    let is_whole = |light: &Light| light.rgb_lx.len() == count && light.errors_lx.len() == count;
    let is_lit = is_whole(&surface.whole) && surface.groups.iter().all(is_whole);
    let is_shaped = surface.normals.len() == count && surface.direct_lx.len() == count;
    if is_lit && is_shaped && indices.iter().all(|k| (*k as usize) < count) {
        return Ok(surface);
    }
    Err(of.wrong("its attributes and indices do not agree in number"))
}

impl Attributes<'_> {
    /// All values of an attribute, which must be there, of this type, and inside of the file.
    fn read<T: Item + Numbers>(&self, semantic: &Semantic) -> Result<Vec<T>, Trouble> {
        let accessor = self.primitive.get(semantic).filter(|a| {
            a.data_type() == gltf::accessor::DataType::F32
                && a.dimensions().multiplicity() == T::COUNT
        });
        let accessor = accessor.ok_or_else(|| self.wrong(&format!("it has no {semantic:?}")))?;
        let fits = accessor.view().is_some_and(|view| {
            view.offset().checked_add(view.length()).is_some_and(|end| end <= self.blob.len())
        });
        let values = fits.then(|| Iter::<T>::new(accessor, |_| Some(self.blob))).flatten();
        values
            .map(Iterator::collect)
            .ok_or_else(|| self.wrong(&format!("its {semantic:?} is cut off")))
    }

    /// The bytes of a picture in the file.
    fn picture(&self, source: &gltf::image::Source<'_>) -> Option<Vec<u8>> {
        let gltf::image::Source::View { view, .. } = source else { return None };
        Some(self.blob.get(view.offset()..view.offset().checked_add(view.length())?)?.to_vec())
    }

    fn wrong(&self, what: &str) -> Trouble {
        Trouble::Light(format!("shape `{}`: {what}", self.shape))
    }
}

/// How many numbers a value has.
trait Numbers {
    const COUNT: usize;
}

impl Numbers for f32 {
    const COUNT: usize = 1;
}

impl Numbers for [f32; 3] {
    const COUNT: usize = 3;
}
