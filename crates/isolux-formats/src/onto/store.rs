//! Data of the new file: one buffer, into which all that stays is copied before new vertices follow.

use super::error::OntoError;
use super::references::{Referenced, list, take_extension};
use crate::gltf::{MESHOPT_NAMES, Opened};
use crate::lightmap::LightmapFileError;
use serde_json::{Value, json};

/// Places of views, of which any array can be read.
const ALIGNMENT: usize = 8;
/// What 32 bits of GLB can say.
const MOST_BYTES: usize = u32::MAX as usize;

/// Bytes that copies in the JSON may take: a mesh of many places has one for each.
const MOST_COPIED: usize = 256 << 20;
/// What a value takes at least.
const A_VALUE: usize = 8;

/// The data of a file while it grows.
pub(super) struct Store {
    pub(super) content: Vec<u8>,
    pub(super) accessors: Vec<Value>,
    pub(super) views: Vec<Value>,
    /// Numbers that nothing refers to any more.
    free_accessors: Vec<usize>,
    free_views: Vec<usize>,
    /// Bytes that may still be copied.
    room: usize,
}

impl Store {
    /// What stays of a file whose document has lost primitives, whose accessors and views these were.
    pub(super) fn of(
        opened: &Opened,
        document: &Value,
        lost: &Referenced,
    ) -> Result<Self, OntoError> {
        let mut store = Self {
            content: Vec::new(),
            accessors: list(document, "accessors").cloned().collect(),
            views: list(document, "bufferViews").cloned().collect(),
            free_accessors: Vec::new(),
            free_views: Vec::new(),
            room: MOST_COPIED,
        };
        let stay = Referenced::of(document, &|_| true);
        let is_free = |accessor: &usize| {
            lost.accessors.contains(accessor) && !stay.accessors.contains(accessor)
        };
        let free: Vec<usize> = (0..store.accessors.len()).rev().filter(is_free).collect();
        let mut of_lost = Referenced { views: lost.views.clone(), ..Referenced::default() };
        free.iter().for_each(|&accessor| of_lost.add_views(&store.accessors[accessor]));
        let stay = Referenced::of(document, &|accessor| {
            free.binary_search_by(|a| accessor.cmp(a)).is_ok()
        });
        for index in (0..store.views.len()).rev() {
            if of_lost.views.contains(&index) && !stay.views.contains(&index) {
                store.free_views.push(index);
            }
        }
        store.free_accessors = free;
        for index in 0..store.views.len() {
            if store.free_views.binary_search_by(|view| index.cmp(view)).is_err() {
                store.keep(opened, index)?;
            }
        }
        Ok(store)
    }

    /// Copies a view, unpacked.
    fn keep(&mut self, opened: &Opened, index: usize) -> Result<(), OntoError> {
        let bytes = opened.view(index)?;
        let offset = self.append(bytes)?;
        let view = &mut self.views[index];
        view["buffer"] = json!(0);
        view["byteOffset"] = json!(offset);
        view["byteLength"] = json!(bytes.len());
        for name in MESHOPT_NAMES {
            take_extension(view, name);
        }
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> Result<usize, OntoError> {
        let start = self.content.len().next_multiple_of(ALIGNMENT);
        let end = start.saturating_add(bytes.len());
        if end > MOST_BYTES {
            return Err(LightmapFileError::TooLarge { bytes: end as u64 }.into());
        }
        self.content.resize(start, 0);
        self.content.extend_from_slice(bytes);
        Ok(start)
    }

    /// A copy of a part of the document.
    pub(super) fn copy(&mut self, opened: &Opened, part: &Value) -> Result<Value, OntoError> {
        self.room = self.room.checked_sub(weight(part)).ok_or_else(|| {
            let what = format!(
                "copies for all places of its meshes take more than {MOST_COPIED} bytes of JSON"
            );
            opened.problem("meshes", what, "place fewer copies, or split the scene")
        })?;
        Ok(part.clone())
    }

    /// Adds a view of bytes, of which there must be some, with more of its members.
    pub(super) fn view(&mut self, bytes: &[u8], members: Value) -> Result<usize, OntoError> {
        let mut view = members;
        view["buffer"] = json!(0);
        view["byteOffset"] = json!(self.append(bytes)?);
        view["byteLength"] = json!(bytes.len());
        Ok(put(&mut self.views, &mut self.free_views, view))
    }

    /// Adds an accessor.
    pub(super) fn accessor(&mut self, accessor: Value) -> usize {
        put(&mut self.accessors, &mut self.free_accessors, accessor)
    }

    /// Places that nothing came to: accessors of zeros, views of a byte.
    pub(super) fn close(&mut self) {
        for index in self.free_accessors.drain(..) {
            let accessor = &self.accessors[index];
            self.accessors[index] = json!({"componentType": accessor["componentType"], "type": accessor["type"], "count": 1});
        }
        if self.content.is_empty() && !self.free_views.is_empty() {
            self.content.push(0);
        }
        for index in self.free_views.drain(..) {
            self.views[index] = json!({"buffer": 0, "byteLength": 1});
        }
    }
}

/// About the bytes that a value takes as text.
fn weight(value: &Value) -> usize {
    A_VALUE
        + match value {
            Value::String(text) => text.len(),
            Value::Array(values) => values.iter().map(weight).sum(),
            Value::Object(members) => members.iter().map(|(key, v)| key.len() + weight(v)).sum(),
            _ => 0,
        }
}

fn put(all: &mut Vec<Value>, free: &mut Vec<usize>, value: Value) -> usize {
    match free.pop() {
        Some(index) => {
            all[index] = value;
            index
        }
        None => {
            all.push(value);
            all.len() - 1
        }
    }
}
