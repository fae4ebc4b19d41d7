//! Attributes of new vertices, in the types they had.

use super::corners::Part;
use super::error::OntoError;
use super::references::{number, take_extension};
use super::store::Store;
use crate::gltf::{DRACO, Elements, Opened};
use serde_json::{Map, Value, json};

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
/// Attributes have at least this much room.
const STRIDE: usize = 4;
/// With more vertices the largest number of 16 bits would be one, which restarts strips.
const MOST_SHORT: usize = 65_535;

/// A primitive like another, of the vertices of a part; places in the lightmap are in this set of texture coordinates. Its material is
/// left to the caller.
pub(super) fn primitive(
    (opened, place): (&Opened, &str),
    old: &Value,
    (part, set): (&Part, u32),
    store: &mut Store,
) -> Result<Value, OntoError> {
    let mut new = store.copy(opened, old)?;
    take_extension(&mut new, DRACO);
    let gather = Gather { opened, place, part };
    let mut attributes = old["attributes"].as_object().cloned().unwrap_or_default();
    attributes.remove(&name_of_set(set));
    let mut attributes = gather.attributes(&attributes, store)?;
    let places: Vec<u8> = part.uvs.iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    let view = store.view(&places, json!({"target": VERTICES}))?;
    let places = json!(store.accessor(json!({
        "bufferView": view, "componentType": FLOAT, "type": "VEC2", "count": part.uvs.len(),
    })));
    // glTF wants the first sets where there is a further one.
    for lower in 0..set {
        attributes.entry(name_of_set(lower)).or_insert_with(|| places.clone());
    }
    attributes.insert(name_of_set(set), places);
    new["attributes"] = Value::Object(attributes);
    if let Some(targets) = old.get("targets").and_then(Value::as_array) {
        let of_target =
            |target: &Value| gather.attributes(target.as_object().unwrap_or(&Map::new()), store);
        let targets: Result<Vec<_>, _> = targets.iter().map(of_target).collect();
        new["targets"] = json!(targets?);
    }
    new["indices"] = json!(indices(part, store)?);
    if let Some(members) = new.as_object_mut() {
        // Triangles one by one, as they are without it.
        members.remove("mode");
    }
    Ok(new)
}

/// The attribute of a set of texture coordinates.
pub(super) fn name_of_set(set: u32) -> String {
    format!("TEXCOORD_{set}")
}

struct Gather<'a> {
    opened: &'a Opened,
    place: &'a str,
    part: &'a Part,
}

impl Gather<'_> {
    fn attributes(
        &self,
        old: &Map<String, Value>,
        store: &mut Store,
    ) -> Result<Map<String, Value>, OntoError> {
        let attribute = |(name, accessor): (&String, &Value)| {
            let new = match number(accessor) {
                Some(accessor) => json!(self.attribute(name, accessor, store)?),
                None => accessor.clone(),
            };
            Ok((name.clone(), new))
        };
        old.iter().map(attribute).collect()
    }

    fn attribute(
        &self,
        name: &str,
        accessor: usize,
        store: &mut Store,
    ) -> Result<usize, OntoError> {
        let record = &self.opened.json["accessors"][accessor];
        let mut new = store.copy(self.opened, record)?;
        for member in ["sparse", "byteOffset", "bufferView", "min", "max"] {
            new.as_object_mut().and_then(|members| members.remove(member));
        }
        new["count"] = json!(self.part.vertices.len());
        let is_zero = record.get("bufferView").is_none()
            && record.get("sparse").is_none()
            && !self.opened.is_unpacked(accessor);
        if is_zero {
            // Displacements of nothing.
            set_bounds(&mut new, name, &[[0.0; 2]; 3]);
            return Ok(store.accessor(new));
        }
        let elements = self.opened.elements(accessor)?;
        let bytes = self.gathered(name, &elements)?;
        set_bounds(&mut new, name, &elements.bounds(&bytes));
        let size = elements.size();
        let stride = size.next_multiple_of(STRIDE);
        let mut members = json!({"target": VERTICES});
        let bytes = if stride == size {
            bytes
        } else {
            members["byteStride"] = json!(stride);
            let padded = |element: &[u8]| {
                let mut padded = element.to_vec();
                padded.resize(stride, 0);
                padded
            };
            bytes.chunks_exact(size).flat_map(padded).collect()
        };
        new["bufferView"] = json!(store.view(&bytes, members)?);
        Ok(store.accessor(new))
    }

    /// Elements of the vertices, seen from behind where they are of a back.
    fn gathered(&self, name: &str, elements: &Elements) -> Result<Vec<u8>, OntoError> {
        let size = elements.size();
        let all: Vec<&[u8]> = elements.bytes.chunks_exact(size).collect();
        let mut bytes = Vec::with_capacity(self.part.vertices.len() * size);
        for &vertex in &self.part.vertices {
            let element = all.get(vertex as usize).ok_or_else(|| {
                let what = format!("has {} elements and is asked for number {vertex}", all.len());
                let place = format!("{}.{name}", self.place);
                self.opened.problem(place, what, "export the file again")
            })?;
            bytes.extend_from_slice(element);
        }
        if self.part.is_back && matches!(name, "NORMAL" | "TANGENT") {
            elements.negate(&mut bytes);
        }
        Ok(bytes)
    }
}

/// Positions tell how far they reach; for others that is left out.
fn set_bounds(accessor: &mut Value, name: &str, bounds: &[[f64; 2]]) {
    if name == "POSITION" {
        accessor["min"] = bounds.iter().map(|b| number_of(b[0])).collect();
        accessor["max"] = bounds.iter().map(|b| number_of(b[1])).collect();
    }
}

/// Whole numbers without a point.
fn number_of(value: f64) -> Value {
    let whole = value as i64;
    if whole as f64 == value { json!(whole) } else { json!(value) }
}

fn indices(part: &Part, store: &mut Store) -> Result<usize, OntoError> {
    let is_short = part.vertices.len() <= MOST_SHORT;
    let (component, bytes): (u32, Vec<u8>) = if is_short {
        let short = part.indices.iter().flat_map(|&index| (index as u16).to_le_bytes());
        (UNSIGNED_SHORT, short.collect())
    } else {
        (UNSIGNED_INT, part.indices.iter().flat_map(|index| index.to_le_bytes()).collect())
    };
    let view = store.view(&bytes, json!({"target": INDICES}))?;
    Ok(store.accessor(json!({
        "bufferView": view, "componentType": component, "type": "SCALAR", "count": part.indices.len(),
    })))
}
