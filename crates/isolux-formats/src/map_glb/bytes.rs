//! The binary chunk, cut into buffer views.

use super::document::BufferView;
use serde::Deserialize;

/// Views begin at multiples of this, so that any array can be read in place.
const ALIGNMENT: usize = 8;

/// The binary chunk while it grows.
#[derive(Default)]
pub(super) struct Bytes {
    pub(super) content: Vec<u8>,
    pub(super) views: Vec<BufferView>,
}

impl Bytes {
    /// Appends a view and returns its index. `content` must not be empty: glTF knows no empty view.
    pub(super) fn view(&mut self, content: &[u8], target: Option<u32>) -> u32 {
        let start = self.content.len().next_multiple_of(ALIGNMENT);
        self.content.resize(start, 0);
        self.content.extend_from_slice(content);
        let byte_length = content.len();
        self.views.push(BufferView { buffer: 0, byte_offset: start, byte_length, target });
        self.views.len() as u32 - 1
    }

    /// The bytes of a view.
    pub(super) fn of(&self, view: u32) -> Option<&[u8]> {
        let view = self.views.get(view as usize)?;
        self.content.get(view.byte_offset..view.byte_offset + view.byte_length)
    }
}

/// A buffer view as read.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    #[serde(default)]
    buffer: u32,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
}

impl View {
    /// Its bytes; `None` where it reaches beyond them.
    pub(super) fn of(self, binary: &[u8]) -> Option<&[u8]> {
        let end = self.byte_offset.checked_add(self.byte_length)?;
        binary.get(self.byte_offset..end).filter(|_| self.buffer == 0)
    }
}
