//! Buffers that only stand in for what is stored compressed elsewhere.

use super::meshopt::{self, Packed};
use gltf_json::Root;

/// Which buffers need not be there.
pub(super) fn find(root: &Root) -> Vec<bool> {
    let mut is_read = vec![false; root.buffers.len()];
    let mut is_replaced = is_read.clone();
    let mark = |list: &mut Vec<bool>, buffer: usize| {
        if let Some(slot) = list.get_mut(buffer) {
            *slot = true;
        }
    };
    for view in &root.buffer_views {
        match view.extensions.as_ref().and_then(|e| Packed::read(&e.others)) {
            Some(packed) => {
                mark(&mut is_replaced, view.buffer.value());
                if let Ok(packed) = packed {
                    mark(&mut is_read, packed.buffer);
                }
            }
            None => mark(&mut is_read, view.buffer.value()),
        }
    }
    let marked = root.buffers.iter().map(|buffer| {
        let extensions = buffer.extensions.as_ref().map(|e| &e.others);
        let of = |name: &&str| extensions.and_then(|others| others.get(*name)?.get("fallback"));
        meshopt::NAMES.iter().any(|name| of(name).is_some_and(|value| value == true))
    });
    let unread = is_replaced.into_iter().zip(is_read).map(|(replaced, read)| replaced && !read);
    marked.zip(unread).map(|(marked, unread)| marked || unread).collect()
}
