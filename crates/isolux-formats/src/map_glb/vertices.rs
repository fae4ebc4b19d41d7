//! Maps as `.glb` files whose light is in the colours of vertices, for engines.
//!
//! The geometry is that of the elements, as in the map itself; the map is left out. What colours stand for is up to the
//! consumer ([`Target::vertex_convention`]).

use super::attributes::{Sink, seen_lx, shown};
use super::bytes::Bytes;
use super::display::{self, Layer, Surface};
use super::document::{Objects, Primitive, Reflection};
use super::looks::Looks;
use super::preview::{luminance_cd_m2, reflectance};
use super::record::Origin;
use super::write::{add_node, add_textures, pack};
use super::{MapTooLarge, Preview, backs, nodes};
use crate::lightmap::{ColourKind, Target, VertexConvention};
use isolux::map::IlluminationMap;
use isolux::scene::{Finish, Scene};
use isolux::units::Rgb;
use serde::Serialize;
use std::collections::BTreeMap;

/// Share of the area of what has no light of its own that may be brighter than white.
const WHITE_SHARE: f64 = 0.01;

/// What is to be written.
#[derive(Clone, Copy, Debug)]
pub struct VertexFile<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its map.
    pub map: &'a IlluminationMap,
    /// Exposure of colours that are tone mapped.
    pub preview: Preview,
    /// Who will read it.
    pub target: Target,
    /// The luminance whose colour is 1 where colours are in proportion, cd/m2; `None` leaves it to the map.
    pub white_cd_m2: Option<f64>,
    /// Lux beside the colours, those of each of these groups, too; `None` leaves them out.
    pub lux: Option<&'a [GroupLight]>,
}

/// The part of the light of a map that belongs to a group of luminaires.
#[derive(Clone, Debug)]
pub struct GroupLight {
    /// The group.
    pub name: String,
    /// Its light, undimmed, on the same elements; it is known where that of the map is.
    pub map: IlluminationMap,
}

/// A file, and what became of the light in it.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexColours {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// What luminances are multiplied by, m2/cd.
    pub exposure_m2_cd: f64,
    /// The luminance of which the colour is 1, cd/m2: the inverse of that, or that of the tone curve.
    pub white_cd_m2: f64,
    /// Vertices that carry light.
    pub vertices: usize,
    /// The largest channel of their colours, before any is cut.
    pub largest: f64,
    /// Vertices with a channel above 1, which is cut: glTF allows no more.
    pub above_white: usize,
}

/// `extras` of the document.
#[derive(Serialize)]
struct Extras<'a> {
    isolux_vertices: Note<'a>,
}

/// What those need who read the file without its manual.
#[derive(Serialize)]
struct Note<'a> {
    target: &'static str,
    #[serde(flatten)]
    convention: VertexConvention,
    exposure_m2_cd: f64,
    white_cd_m2: f64,
    /// Names of the groups of luminaires whose light the attributes hold; none without lux.
    #[serde(skip_serializing_if = "Option::is_none")]
    groups: Option<Vec<&'a str>>,
    #[serde(flatten)]
    origin: Origin,
}

/// Writes the file. The same map gives the same bytes.
pub fn write_vertices(file: &VertexFile<'_>) -> Result<VertexColours, MapTooLarge> {
    let VertexFile { scene, map, target, .. } = *file;
    let convention = target.vertex_convention();
    let surfaces = display::surfaces(scene, map);
    let exposure = match convention.kind {
        ColourKind::ToneMapped => Exposure::Curve(file.preview),
        _ => Exposure::White(file.white_cd_m2.unwrap_or_else(|| white_cd_m2(scene, &surfaces))),
    };
    let mut made = VertexColours {
        bytes: Vec::new(),
        exposure_m2_cd: exposure.factor(),
        white_cd_m2: exposure.white_cd_m2(),
        vertices: 0,
        largest: 0.0,
        above_white: 0,
    };
    let (mut objects, mut bytes) = (Objects::default(), Bytes::default());
    add_textures(scene, &mut objects, &mut bytes)?;
    add_meshes((file, &exposure), surfaces, (&mut objects, &mut bytes), &mut made);
    nodes::add_cameras(scene, &mut objects);
    let children = (0..objects.nodes.len() as u32).collect();
    objects.nodes.push(nodes::root(scene, children));
    let note = Note {
        target: target.name(),
        convention,
        exposure_m2_cd: made.exposure_m2_cd,
        white_cd_m2: made.white_cd_m2,
        groups: file.lux.map(|groups| groups.iter().map(|group| group.name.as_str()).collect()),
        origin: Origin::of(map),
    };
    // Without lights: all of theirs is in the colours.
    let used = (vec!["KHR_materials_unlit"], Vec::new());
    made.bytes = pack((objects, bytes), used, Extras { isolux_vertices: note })?;
    Ok(made)
}

/// How luminances become colours.
enum Exposure {
    /// Tone mapped.
    Curve(Preview),
    /// In proportion: this luminance is 1, cd/m2.
    White(f64),
}

impl Exposure {
    fn factor(&self) -> f64 {
        match self {
            Self::Curve(preview) => preview.exposure_m2_cd,
            Self::White(cd_m2) => 1.0 / cd_m2,
        }
    }

    fn white_cd_m2(&self) -> f64 {
        match self {
            Self::Curve(preview) => preview.white_cd_m2,
            Self::White(cd_m2) => *cd_m2,
        }
    }

    fn colour(&self, luminance_cd_m2: Rgb) -> [f64; 3] {
        match self {
            Self::Curve(preview) => preview.colour(luminance_cd_m2),
            Self::White(cd_m2) => luminance_cd_m2.map(|c| c / cd_m2).0,
        }
    }
}

/// What most of all surfaces without light of their own stay below, in each channel; two digits of it.
fn white_cd_m2(scene: &Scene, surfaces: &BTreeMap<Layer, Surface>) -> f64 {
    let mut patches = Vec::new();
    for (layer, surface) in surfaces {
        let finish = finish(scene, layer).filter(|finish| !finish.is_emitter());
        if let Some(finish) = finish {
            patches.extend(patches_of(surface, finish));
        }
    }
    patches.sort_by(|a, b| a.1.total_cmp(&b.1));
    let area: f64 = patches.iter().map(|patch| patch.0).sum();
    let mut brighter = area;
    let white = patches.iter().find(|patch| {
        brighter -= patch.0;
        brighter <= WHITE_SHARE * area
    });
    let white = white.map(|patch| rounded_up(patch.1));
    white.filter(|white| white.is_normal()).unwrap_or(1.0)
}

/// The next number of two digits.
fn rounded_up(value: f64) -> f64 {
    if value <= 0.0 {
        return 0.0;
    }
    let decimals = 1.0 - libm::floor(libm::log10(value));
    let unit = libm::pow(10.0, libm::fabs(decimals));
    // Dividing by a whole number gives the nearest number of two digits; so does multiplying with one.
    if decimals > 0.0 { libm::ceil(value * unit) / unit } else { libm::ceil(value / unit) * unit }
}

fn finish<'a>(scene: &'a Scene, layer: &Layer) -> Option<&'a Finish> {
    scene.materials()[layer.material as usize].finish(layer.back).filter(|_| layer.mapped)
}

/// Area of each triangle, and the largest channel of its luminance, cd/m2, where something is known of it.
fn patches_of<'a>(
    surface: &'a Surface,
    finish: &'a Finish,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let values = shown(&surface.values);
    let channel = move |corner: u32| {
        values[corner as usize].map(|v| luminance_cd_m2(finish, v.total_lx()).max_channel())
    };
    surface.indices.as_chunks::<3>().0.iter().filter_map(move |&corners| {
        let largest = corners.into_iter().filter_map(&channel).reduce(f64::max)?;
        Some((area_m2(corners.map(|k| surface.positions[k as usize])), largest))
    })
}

fn area_m2(corners: [[f32; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(|p| isolux::geometry::Point::from(p.map(f64::from)));
    0.5 * (b - a).cross(c - a).length()
}

/// One mesh and one node a shape.
fn add_meshes(
    (file, exposure): (&VertexFile<'_>, &Exposure),
    surfaces: BTreeMap<Layer, Surface>,
    (objects, bytes): (&mut Objects, &mut Bytes),
    made: &mut VertexColours,
) {
    let distance_m = backs::distance_m(file.scene, file.target);
    let groups = file.lux.unwrap_or_default().iter();
    let groups: Vec<_> = groups.map(|group| display::surfaces(file.scene, &group.map)).collect();
    let mut looks = Looks::default();
    let mut current = None;
    for (layer, mut surface) in surfaces {
        if current != Some(layer.shape) {
            current = Some(layer.shape);
            add_node(&file.scene.shape_names()[layer.shape as usize], objects);
        }
        if layer.back && distance_m > 0.0 {
            backs::stand_off(&mut surface, distance_m);
        }
        let mut sink = Sink { bytes, accessors: &mut objects.accessors };
        let (mut attributes, indices) = sink.geometry(&surface);
        let finish = finish(file.scene, &layer);
        if let Some(finish) = finish {
            let mut colours = colours(&surface, finish, exposure);
            made.count(&colours);
            colours.iter_mut().flatten().for_each(|c| *c = c.clamp(0.0, 1.0));
            attributes.colour = Some(match file.target.vertex_convention().kind {
                ColourKind::Floats => sink.float_colours(&colours),
                ColourKind::ToneMapped => sink.colours(&colours),
            });
        }
        let lit = finish.filter(|_| file.lux.is_some());
        attributes.light = lit.map(|_| {
            let of_groups = groups.iter().map(|surfaces| shown(&surfaces[&layer].values));
            sink.light(&shown(&surface.values), &of_groups.collect::<Vec<_>>())
        });
        let extras = lit.map(reflection);
        let texture = finish.and_then(|f| f.diffuse.texture).filter(|_| !surface.uvs.is_empty());
        let material = looks.of((file.scene, &|l| exposure.colour(l)), (layer, texture), objects);
        if let Some(mesh) = objects.meshes.last_mut() {
            mesh.primitives.push(Primitive { attributes, indices, material, extras });
        }
    }
}

fn reflection(finish: &Finish) -> Reflection {
    Reflection { reflectance: reflectance(finish).0, luminance_cd_m2: finish.luminance_cd_m2.0 }
}

/// Colours of the vertices of a surface, without its texture, which the consumer multiplies them with.
fn colours(surface: &Surface, finish: &Finish, exposure: &Exposure) -> Vec<[f64; 3]> {
    let values = shown(&surface.values).into_iter();
    values.map(|v| exposure.colour(luminance_cd_m2(finish, seen_lx(v.as_ref())))).collect()
}

impl VertexColours {
    fn count(&mut self, colours: &[[f64; 3]]) {
        let largest = |rgb: &[f64; 3]| rgb.iter().copied().fold(0.0, f64::max);
        self.vertices += colours.len();
        self.largest = colours.iter().map(largest).fold(self.largest, f64::max);
        self.above_white += colours.iter().filter(|rgb| largest(rgb) > 1.0).count();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_has_two_digits_and_is_not_below() {
        for (value, expected) in [(127.32, 130.0), (0.0123, 0.013), (100.0, 100.0), (9.95, 10.0)] {
            assert_eq!(rounded_up(value), expected);
        }
        assert_eq!(rounded_up(-1.0), 0.0);
    }
}
