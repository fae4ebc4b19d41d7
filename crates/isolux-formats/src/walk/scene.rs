//! What a scene looks like without its light.

use super::container::Sections;
use super::luminaires;
use super::origin::origin;
use super::record::{
    Bounds, CameraRecord, ColourMapRecord, FinishRecord, Limits, SceneHeader, Steps, TextureRecord,
    ToneRecord,
};
use super::sky;
use crate::map_glb::images;
use isolux::geometry::Vector;
use isolux::scene::{Body, Camera, Finish, Material, Scene, Texture};
use isolux::units::Rgb;

/// A tone operator as a table of base-2 logarithms.
#[derive(Clone, Debug, PartialEq)]
pub struct Tone {
    /// What links and programs call it.
    pub name: &'static str,
    /// What people call it.
    pub label: &'static str,
    /// Whether it acts on luminance, not on each channel.
    pub on_luminance: bool,
    /// Logarithms of the luminance of white, cd/m2, of the rows.
    pub whites: Steps,
    /// Logarithms of the exposed luminance of the columns.
    pub exposed: Steps,
    /// Logarithms of what the display emits, row after row.
    pub values: Vec<f32>,
}

/// A colour map: its name and its sRGB codes.
pub type ColourMap = (&'static str, Vec<[u8; 3]>);

/// What the page is told beside the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// File name of the map.
    pub file: String,
    /// Facts of the map, for people.
    pub about: Vec<(String, String)>,
    /// The luminance shown as 1 at first, cd/m2.
    pub white_cd_m2: f64,
    /// The light of the luminaires of each layer, lm in three channels: eyes adapt to the colour of their sum.
    pub light_lm: Vec<Rgb>,
    /// Tone operators, the first one is the usual.
    pub tones: Vec<Tone>,
    /// Colour maps, the first one is the usual.
    pub colour_maps: Vec<ColourMap>,
    /// Round limits of the illuminances, lx.
    pub scale_lx: (f64, f64),
    /// Names of the layers of light.
    pub layers: Vec<String>,
    /// The file of the map that this one is compared with vertex by vertex.
    pub other: Option<String>,
}

/// The container of a scene.
pub fn scene(scene: &Scene, told: &Told) -> Vec<u8> {
    let mut sections = Sections::default();
    let textures = textures(scene, &mut sections);
    let tones = told.tones.iter().map(|tone| tone_record(tone, &mut sections)).collect();
    let colour_maps = told.colour_maps.iter().map(|map| colour_map(map, &mut sections)).collect();
    let (luminaires, solids) = luminaires::all(scene);
    let header = SceneHeader {
        kind: "scene",
        name: scene.name(),
        file: &told.file,
        up: scene.up().direction().to_vector().into(),
        origin: origin(scene).into(),
        bounds: bounds(scene),
        shapes: scene.shape_names(),
        finishes: scene.materials().iter().flat_map(finishes).collect(),
        textures,
        luminaires,
        solids,
        sky: sky::sky(scene, &mut sections),
        sun: sky::sun(scene),
        groups: scene.groups(),
        cameras: cameras(scene),
        about: &told.about,
        white_cd_m2: told.white_cd_m2,
        light_lm: &told.light_lm,
        tones,
        colour_maps,
        scale_lx: Limits { low: told.scale_lx.0, high: told.scale_lx.1 },
        layers: &told.layers,
        other: told.other.as_deref(),
    };
    sections.with_header(&header)
}

/// A box around all, in the coordinates of the page.
fn bounds(scene: &Scene) -> Bounds {
    let origin = origin(scene);
    let (mut min, mut max) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for corner in (0..scene.triangle_count()).flat_map(|t| scene.triangle(t).corners) {
        for (k, at) in <[f64; 3]>::from(corner - origin).into_iter().enumerate() {
            (min[k], max[k]) = (min[k].min(at), max[k].max(at));
        }
    }
    Bounds { min, max }
}

/// Both sides of a material, front first.
fn finishes(material: &Material) -> [FinishRecord<'_>; 2] {
    let name = material.name.as_str();
    let of = |finish: &Finish| FinishRecord {
        material: name,
        diffuse: finish.diffuse.colour,
        texture: finish.diffuse.texture,
        mirror: finish.mirror,
        gloss: finish.gloss,
        coat: finish.coat,
        luminance_cd_m2: finish.luminance_cd_m2,
        glass: None,
    };
    match &material.body {
        Body::Opaque { front, back } => [of(front), of(back)],
        Body::Dielectric(glass) => {
            [(), ()].map(|()| FinishRecord { glass: Some(*glass), ..of(&Finish::BLACK) })
        }
    }
}

/// A texture that cannot be written as PNG is shown as its mean colour.
fn textures(scene: &Scene, sections: &mut Sections) -> Vec<TextureRecord> {
    let mut record = |texture: &Texture| {
        let png = images::encode(texture).unwrap_or_default();
        TextureRecord { width: texture.width, height: texture.height, png: sections.u8s(&png) }
    };
    scene.textures().iter().map(&mut record).collect()
}

fn tone_record<'a>(tone: &'a Tone, sections: &mut Sections) -> ToneRecord<'a> {
    ToneRecord {
        name: tone.name,
        label: tone.label,
        on: if tone.on_luminance { "luminance" } else { "channels" },
        whites: tone.whites,
        exposed: tone.exposed,
        values: sections.f32s(&tone.values),
    }
}

fn colour_map<'a>((name, codes): &'a ColourMap, sections: &mut Sections) -> ColourMapRecord<'a> {
    ColourMapRecord { name, codes: sections.u8s(codes.as_flattened()) }
}

fn cameras(scene: &Scene) -> Vec<CameraRecord<'_>> {
    let origin = origin(scene);
    let record = |camera| record(camera, origin);
    scene.cameras().iter().map(record).collect()
}

fn record(camera: &Camera, origin: Vector) -> CameraRecord<'_> {
    CameraRecord {
        name: &camera.name,
        position: (camera.position - origin).into(),
        direction: camera.direction.to_vector().into(),
        up: camera.up.to_vector().into(),
        vertical_fov_deg: camera.vertical_fov_rad.to_degrees(),
    }
}
