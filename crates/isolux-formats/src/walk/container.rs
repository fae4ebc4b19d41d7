//! Bytes with a header of JSON before them, as the page reads them.

use serde::Serialize;

/// The first bytes.
const MAGIC: &[u8; 8] = b"ISOWALK1";
/// Header and sections begin at multiples of this, so that any array can be read in place.
const ALIGNMENT: usize = 8;

/// Where an array of numbers lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Section {
    /// Bytes from the end of the header.
    offset: usize,
    /// Numbers, not bytes.
    count: usize,
    #[serde(rename = "type")]
    kind: &'static str,
}

/// The sections while they grow.
#[derive(Default)]
pub(super) struct Sections {
    content: Vec<u8>,
}

impl Sections {
    pub(super) fn u8s(&mut self, values: &[u8]) -> Section {
        self.add("u8", values.len(), values.iter().copied())
    }

    pub(super) fn i8s(&mut self, values: &[i8]) -> Section {
        self.add("i8", values.len(), values.iter().map(|v| v.cast_unsigned()))
    }

    pub(super) fn u16s(&mut self, values: &[u16]) -> Section {
        self.add("u16", values.len(), values.iter().flat_map(|v| v.to_le_bytes()))
    }

    pub(super) fn u32s(&mut self, values: &[u32]) -> Section {
        self.add("u32", values.len(), values.iter().flat_map(|v| v.to_le_bytes()))
    }

    pub(super) fn f32s(&mut self, values: &[f32]) -> Section {
        self.add("f32", values.len(), values.iter().flat_map(|v| v.to_le_bytes()))
    }

    fn add(
        &mut self,
        kind: &'static str,
        count: usize,
        bytes: impl Iterator<Item = u8>,
    ) -> Section {
        let offset = self.content.len().next_multiple_of(ALIGNMENT);
        self.content.resize(offset, 0);
        self.content.extend(bytes);
        Section { offset, count, kind }
    }

    /// The container: magic, length of the header, the header padded with spaces, the sections.
    pub(super) fn with_header(self, header: &impl Serialize) -> Vec<u8> {
        // Headers are plain structures: numbers, strings and lists.
        let mut header = serde_json::to_vec(header).unwrap_or_default();
        header.resize(header.len().next_multiple_of(ALIGNMENT), b' ');
        let mut all = Vec::with_capacity(16 + header.len() + self.content.len());
        all.extend_from_slice(MAGIC);
        all.extend_from_slice(&(header.len() as u32).to_le_bytes());
        all.extend_from_slice(&[0; 4]);
        all.extend_from_slice(&header);
        all.extend_from_slice(&self.content);
        all
    }
}
