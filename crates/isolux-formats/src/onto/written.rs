//! The new document.

use super::corners::{Sides, parts};
use super::error::OntoError;
use super::groups::{Group, Groups};
use super::matching::Matched;
use super::materials::{LIGHTMAP, Materials, Use};
use super::options::Options;
use super::origins::{place, primitive};
use super::references::{has_extension, index, list, take_extension};
use super::store::Store;
use super::warnings::LIGHTS;
use super::{links, vertices};
use crate::gltf::{DRACO, INSTANCES, MESHOPT_NAMES, Opened, Origin};
use crate::lightmap::LightmapFileError;
use crate::map_glb::{Parts, TexelFile, pack};
use isolux::geometry::Transform;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// The bytes of the file.
pub(super) fn bytes(
    (opened, matched): (&Opened, &Matched),
    (set, options): (u32, Options),
    file: &TexelFile<'_>,
) -> Result<Vec<u8>, OntoError> {
    let sides = Sides::of(&file.lightmap.layout);
    let groups = Groups::of(opened, matched, &sides);
    let mut document = opened.json.clone();
    let lost = groups.take_replaced(&mut document);
    let mut store = Store::of(opened, &document, &lost)?;
    links::take_in(opened, &mut document, &mut store)?;
    let name = opened.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
    let light = Parts::of(file, name)?;
    let pages = add_pages(&light, &mut document, &mut store)?;
    let staying = list(&document, "meshes").flat_map(|mesh| list(mesh, "primitives"));
    let materials = Materials::of(&document, staying, (pages, set));
    let mut scene = Grafted { opened, matched, sides, set, document, store, materials };
    scene.add_meshes(&groups)?;
    let Grafted { mut document, store, materials, .. } = scene;
    document["materials"] = Value::Array(materials.all);
    document["extras"][Parts::NOTE] = light.note;
    if options.without_lights {
        take_lights(&mut document);
    }
    finish(&mut document, store)
}

/// Adds pages as textures, and tells which they are.
fn add_pages(
    light: &Parts,
    document: &mut Value,
    store: &mut Store,
) -> Result<Vec<(usize, f64)>, OntoError> {
    let sampler = push(document, "samplers", light.sampler.clone());
    let mut pages = Vec::new();
    for picture in &light.pictures {
        let view = store.view(&picture.png, json!({}))?;
        let image = json!({"name": "lightmap", "bufferView": view, "mimeType": "image/png"});
        let source = push(document, "images", image);
        let texture = push(document, "textures", json!({"sampler": sampler, "source": source}));
        pages.push((texture, picture.strength));
    }
    Ok(pages)
}

/// Adds to a list of the document, which may not be there yet; its place there.
fn push(document: &mut Value, key: &str, value: Value) -> usize {
    if document.get(key).is_none_or(|list| !list.is_array()) {
        document[key] = json!([]);
    }
    let list = document[key].as_array_mut();
    list.map_or(0, |list| {
        list.push(value);
        list.len() - 1
    })
}

/// A document on its way.
struct Grafted<'a> {
    opened: &'a Opened,
    matched: &'a Matched,
    sides: Sides<'a>,
    /// Of texture coordinates.
    set: u32,
    document: Value,
    store: Store,
    materials: Materials,
}

impl Grafted<'_> {
    /// A mesh for each of its places that carries light: the first place has the old one, unless that is needed as it is.
    fn add_meshes(&mut self, groups: &Groups) -> Result<(), OntoError> {
        let mut changed = BTreeSet::new();
        let mut expanded = BTreeMap::new();
        for (group, shapes) in &groups.lit {
            let mesh = self.mesh(group, shapes)?;
            let index = if groups.may_change(group.mesh) && changed.insert(group.mesh) {
                self.document["meshes"][group.mesh] = mesh;
                group.mesh
            } else {
                push(&mut self.document, "meshes", mesh)
            };
            match group.copy {
                None => self.document["nodes"][group.node]["mesh"] = json!(index),
                Some(copy) => {
                    expanded.entry(group.node).or_insert_with(Vec::new).push((copy, index));
                }
            }
        }
        for (node, copies) in expanded {
            self.expand(node, &copies)?;
        }
        Ok(())
    }

    /// The mesh of one place, with light where that comes.
    fn mesh(&mut self, group: &Group, shapes: &BTreeMap<usize, usize>) -> Result<Value, OntoError> {
        let old = &self.opened.json["meshes"][group.mesh];
        let mut primitives = Vec::new();
        for (number, primitive) in list(old, "primitives").enumerate() {
            match shapes.get(&number) {
                Some(&shape) => primitives.extend(self.lit(shape)?),
                None => primitives.push(self.store.copy(self.opened, primitive)?),
            }
        }
        let mut mesh = self.store.copy(self.opened, old)?;
        mesh["primitives"] = Value::Array(primitives);
        Ok(mesh)
    }

    /// A primitive for each side and page of a shape.
    fn lit(&mut self, shape: usize) -> Result<Vec<Value>, OntoError> {
        let origin: Origin = self.opened.shapes[shape].0;
        let place = place(origin);
        let old = primitive(self.opened, origin);
        let parts = parts(self.opened, shape, self.matched, &self.sides)?;
        let is_parted = parts.iter().any(|part| part.is_back);
        let mut primitives = Vec::new();
        for part in &parts {
            let mut new =
                vertices::primitive((self.opened, &place), old, (part, self.set), &mut self.store)?;
            self.materials.light(&mut new, Use { page: part.page, is_parted });
            primitives.push(new);
        }
        Ok(primitives)
    }

    /// Nodes in place of copies of a node's mesh.
    fn expand(&mut self, node: usize, copies: &[(usize, usize)]) -> Result<(), OntoError> {
        let old = &self.opened.json;
        let of_mesh = index(&old["nodes"][node], "mesh").map(|mesh| &old["meshes"][mesh]);
        let named = [Some(&old["nodes"][node]), of_mesh].into_iter().flatten();
        let name = named.filter_map(|named| named.get("name")?.as_str()).next().unwrap_or("copy");
        let places = self.opened.instances(node)?;
        let weights = self.document["nodes"][node].get("weights").cloned();
        for &(copy, mesh) in copies {
            let mut child = json!({"name": format!("{name}[{copy}]"), "mesh": mesh});
            if let Some(place) = places.get(copy).filter(|place| **place != Transform::IDENTITY) {
                child["matrix"] = json!(matrix(place));
            }
            if let Some(weights) = &weights {
                child["weights"] = weights.clone();
            }
            let child = push(&mut self.document, "nodes", child);
            push(&mut self.document["nodes"][node], "children", json!(child));
        }
        let parent = &mut self.document["nodes"][node];
        take_extension(parent, INSTANCES);
        for member in ["mesh", "weights"] {
            parent.as_object_mut().and_then(|members| members.remove(member));
        }
        Ok(())
    }
}

/// Column by column.
fn matrix(place: &Transform) -> [f64; 16] {
    let [a, b, c] = place.columns;
    let t = place.translation;
    [a.x, a.y, a.z, 0.0, b.x, b.y, b.z, 0.0, c.x, c.y, c.z, 0.0, t.x, t.y, t.z, 1.0]
}

/// Takes luminaires off their nodes.
fn take_lights(document: &mut Value) {
    let nodes = document["nodes"].as_array_mut();
    for node in nodes.into_iter().flatten() {
        for name in LIGHTS {
            take_extension(node, name);
        }
    }
}

/// One buffer, and the extensions that are there.
fn finish(document: &mut Value, mut store: Store) -> Result<Vec<u8>, OntoError> {
    store.close();
    let mut buffer = document["buffers"][0].clone();
    for name in MESHOPT_NAMES {
        take_extension(&mut buffer, name);
    }
    buffer.as_object_mut().and_then(|members| members.remove("uri"));
    buffer["byteLength"] = json!(store.content.len());
    document["buffers"] = json!([buffer]);
    document["accessors"] = Value::Array(store.accessors);
    document["bufferViews"] = Value::Array(store.views);
    let taken = [DRACO, INSTANCES].into_iter().chain(MESHOPT_NAMES);
    let gone: Vec<&str> = taken.filter(|name| !has_extension(document, name)).collect();
    for key in ["extensionsUsed", "extensionsRequired"] {
        let names = document.get_mut(key).and_then(Value::as_array_mut);
        if let Some(names) = names {
            names.retain(|name| !gone.iter().any(|gone| name == gone));
            if names.is_empty() {
                document.as_object_mut().and_then(|members| members.remove(key));
            }
        }
    }
    if !list(document, "extensionsUsed").any(|name| name == LIGHTMAP) {
        push(document, "extensionsUsed", json!(LIGHTMAP));
    }
    let json = serde_json::to_vec(document).expect("keys are names");
    pack(&json, &store.content)
        .map_err(|error| LightmapFileError::TooLarge { bytes: error.bytes }.into())
}
