//! Data that is stored compressed, unpacked to what a plain file would hold before anything reads it.

use super::buffers::Document;
use super::draco;
use super::meshopt::Packed;
use super::notes::{Flaw, Notes};
use super::unpacked::Budget;

/// Unpacks all there is. The first part that cannot be unpacked ends it: time is bounded by what
/// was unpacked in full.
pub(super) fn unpack(document: &mut Document, notes: &mut Notes) {
    let mut budget = Budget::new();
    if notes.accept(unpack_views(document, &mut budget)).is_some() {
        notes.accept(draco::unpack_primitives(document, &mut budget));
    }
}

fn unpack_views(document: &mut Document, budget: &mut Budget) -> Result<(), Flaw> {
    for index in 0..document.root.buffer_views.len() {
        let view = &document.root.buffer_views[index];
        let packed = view.extensions.as_ref().and_then(|e| Packed::read(&e.others));
        let Some(packed) = packed else { continue };
        let bytes = packed.and_then(|packed| {
            budget.spend(packed.unpacked_bytes())?;
            let (offset, length) = (packed.byte_offset, packed.byte_length);
            packed.unpack(document.stored(packed.buffer, offset, length)?)
        });
        let bytes = bytes.map_err(|flaw| flaw.rooted(format!("bufferViews[{index}]")))?;
        document.unpacked.views.insert(index, bytes);
    }
    Ok(())
}
