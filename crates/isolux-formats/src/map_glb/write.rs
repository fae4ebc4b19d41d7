//! From a scene and its map to the bytes of a file.

use super::arrays::{self, Table};
use super::attributes::Sink;
use super::bytes::Bytes;
use super::container;
use super::display::{self, Layer, Surface};
use super::document::{
    Asset, Buffer, Document, Image, Light, Lights, Mesh, Node, Objects, Primitive, RootExtensions,
    Scene as SceneRoots, Texture,
};
use super::looks::Looks;
use super::record::{Record, Sealed, version};
use super::{MapTooLarge, Preview, images, lightmap_arrays, nodes, scene_arrays, value_arrays};
use isolux::lightmap::Lightmap;
use isolux::map::{IlluminationMap, Provenance};
use isolux::scene::Scene;
use serde::Serialize;

/// The bytes of the `.glb` file of a map of `scene`. The same map gives the same bytes.
pub fn write(
    scene: &Scene,
    map: &IlluminationMap,
    preview: &Preview,
) -> Result<Vec<u8>, MapTooLarge> {
    let mut bytes = Bytes::default();
    let mut objects = Objects::default();
    let pictures = add_textures(scene, &mut objects, &mut bytes)?;
    add_meshes((scene, map, preview), &mut objects, &mut bytes);
    nodes::add_cameras(scene, &mut objects);
    let lights = nodes::add_lights(scene, &mut objects);
    let children = (0..objects.nodes.len() as u32).collect();
    objects.nodes.push(nodes::root(scene, children));
    let record = record((scene, map, preview), (&pictures, None), &mut bytes);
    let mut extensions_used = vec!["KHR_materials_unlit"];
    if !lights.is_empty() {
        extensions_used.push("KHR_lights_punctual");
    }
    pack((objects, bytes), (extensions_used, lights), Sealed::new(&record))
}

/// A file of these objects, the last node of which is the root.
pub(super) fn pack(
    (mut objects, bytes): (Objects, Bytes),
    (extensions_used, lights): (Vec<&'static str>, Vec<Light>),
    extras: impl Serialize,
) -> Result<Vec<u8>, MapTooLarge> {
    objects.buffer_views = bytes.views;
    let document = Document {
        asset: Asset { version: "2.0", generator: format!("isolux {}", env!("CARGO_PKG_VERSION")) },
        extensions_used,
        extensions: (!lights.is_empty()).then_some(RootExtensions { lights: Lights { lights } }),
        scene: 0,
        scenes: [SceneRoots { nodes: [objects.nodes.len() as u32 - 1] }],
        objects,
        buffers: Vec::from_iter(
            (!bytes.content.is_empty()).then_some(Buffer { byte_length: bytes.content.len() }),
        ),
        extras,
    };
    let json = serde_json::to_vec(&document).expect("plain structs with names for keys");
    container::pack(&json, &bytes.content)
}

/// Embeds the textures and returns their buffer views.
pub(super) fn add_textures(
    scene: &Scene,
    objects: &mut Objects,
    bytes: &mut Bytes,
) -> Result<Vec<u32>, MapTooLarge> {
    let mut views = Vec::new();
    for (index, texture) in scene.textures().iter().enumerate() {
        let too_large = MapTooLarge { bytes: texture.srgb.len() as u64 };
        let png = images::encode(texture).ok_or(too_large)?;
        let buffer_view = bytes.view(&png, None);
        objects.images.push(Image { buffer_view, mime_type: "image/png" });
        objects.textures.push(Texture { sampler: None, source: index as u32 });
        views.push(buffer_view);
    }
    Ok(views)
}

pub(super) type Input<'a> = (&'a Scene, &'a IlluminationMap, &'a Preview);

/// One mesh and one node a shape.
fn add_meshes(input: Input<'_>, objects: &mut Objects, bytes: &mut Bytes) {
    let mut looks = Looks::default();
    let mut current = None;
    for (layer, surface) in display::surfaces(input.0, input.1) {
        if current != Some(layer.shape) {
            current = Some(layer.shape);
            add_node(&input.0.shape_names()[layer.shape as usize], objects);
        }
        let primitive = primitive(input, (layer, &surface), &mut looks, (objects, bytes));
        if let Some(mesh) = objects.meshes.last_mut() {
            mesh.primitives.push(primitive);
        }
    }
}

pub(super) fn add_node(name: &str, objects: &mut Objects) {
    let mesh = Some(objects.meshes.len() as u32);
    objects.meshes.push(Mesh { name: name.to_owned(), primitives: Vec::new() });
    objects.nodes.push(Node { name: name.to_owned(), mesh, ..Node::default() });
}

fn primitive(
    (scene, _, preview): Input<'_>,
    (layer, surface): (Layer, &Surface),
    looks: &mut Looks,
    (objects, bytes): (&mut Objects, &mut Bytes),
) -> Primitive {
    let mut sink = Sink { bytes, accessors: &mut objects.accessors };
    let (mut attributes, indices) = sink.geometry(surface);
    let material = &scene.materials()[layer.material as usize];
    let finish = material.finish(layer.back);
    if let Some(finish) = finish.filter(|_| layer.mapped) {
        let (colour, light) = sink.coloured_light(&surface.values, (finish, preview));
        (attributes.colour, attributes.light) = (Some(colour), Some(light));
    }
    let texture = finish.and_then(|f| f.diffuse.texture).filter(|_| !surface.uvs.is_empty());
    let material = looks.of((scene, &|l| preview.colour(l)), (layer, texture), objects);
    Primitive { attributes, indices, material, extras: None }
}

/// Writes all arrays and says what they are.
pub(super) fn record(
    (scene, map, preview): Input<'_>,
    (pictures, lightmap): (&[u32], Option<&Lightmap>),
    bytes: &mut Bytes,
) -> Record {
    let mut table = Table::new();
    let scene = scene_arrays::write(scene.to_parts(), pictures, bytes, &mut table);
    value_arrays::write(map, bytes, &mut table);
    let lightmap = lightmap.and_then(|l| lightmap_arrays::write(l, (bytes, &mut table)));
    let arrays_blake3 = arrays::checksum(&table, |view| bytes.of(view)).unwrap_or_default();
    Record {
        format_version: version(&scene.materials),
        provenance: storable(&map.provenance),
        preview: *preview,
        scene,
        lightmap,
        arrays: table,
        arrays_blake3,
    }
}

/// Provenance as JSON can hold it: an accuracy that is not finite was not reached.
fn storable(provenance: &Provenance) -> Provenance {
    let finite = |v: &f64| v.is_finite();
    let accuracy = provenance.accuracy.filter(|a| {
        let all = [a.reached, a.statistical, a.discretization, a.caustics, a.bias, a.interpolated];
        all.iter().all(finite)
    });
    let accuracy_target = provenance.accuracy_target.filter(finite);
    Provenance { accuracy, accuracy_target, ..provenance.clone() }
}
