//! Buffers and the views into them.

use super::limits;
use super::notes::{Flaw, Notes, no_such};
use super::placeholders;
use super::unpacked::Unpacked;
use super::uri::Folder;
use gltf_json::Root;
use std::borrow::Cow;

/// The file as written, with all bytes it refers to at hand.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    pub(super) folder: Folder,
    /// What is stored compressed, once it is unpacked.
    pub(super) unpacked: Unpacked,
    buffers: Vec<Cow<'a, [u8]>>,
}

/// Bytes of a buffer view.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: Option<usize>,
}

impl<'a> Document<'a> {
    /// Fetches every buffer; what cannot be fetched is noted.
    pub(super) fn load(
        root: Root,
        folder: Folder,
        embedded: Option<&'a [u8]>,
        notes: &mut Notes,
    ) -> Self {
        let mut left = limits::BUFFER_BYTES;
        let mut buffers = Vec::with_capacity(root.buffers.len());
        let is_placeholder = placeholders::find(&root);
        for (index, buffer) in root.buffers.iter().enumerate() {
            if is_placeholder[index] {
                buffers.push(Cow::default());
                continue;
            }
            let embedded = embedded.filter(|_| index == 0);
            let fetched = fetch(buffer, &folder, embedded, left);
            let bytes = notes.accept(fetched.map_err(|f| f.rooted(format!("buffers[{index}]"))));
            left -= bytes.as_ref().map_or(0, |b| b.len() as u64);
            buffers.push(bytes.unwrap_or_default());
        }
        Self { root, folder, unpacked: Unpacked::default(), buffers }
    }

    /// The same, with bytes of its own.
    pub(super) fn into_owned(self) -> Document<'static> {
        let Self { root, folder, unpacked, buffers } = self;
        let buffers = buffers.into_iter().map(|bytes| Cow::Owned(bytes.into_owned())).collect();
        Document { root, folder, unpacked, buffers }
    }

    /// The bytes of a view, found to lie inside its buffer.
    pub(super) fn view(&self, index: usize) -> Result<View<'_>, Flaw> {
        let views = &self.root.buffer_views;
        let view = views.get(index).ok_or_else(|| no_such("bufferViews", index, views.len()))?;
        let stride = view.byte_stride.map(|s| s.0);
        if let Some(bytes) = self.unpacked.views.get(&index) {
            return Ok(View { bytes, stride });
        }
        let (offset, length) = (view.byte_offset.map_or(0, |o| o.0), view.byte_length.0);
        let bytes = self
            .stored(view.buffer.value(), offset, length)
            .map_err(|flaw| flaw.rooted(format!("bufferViews[{index}]")))?;
        Ok(View { bytes, stride })
    }

    /// Bytes as they are in a buffer.
    pub(super) fn stored(&self, buffer: usize, offset: u64, length: u64) -> Result<&[u8], Flaw> {
        let bytes = self
            .buffers
            .get(buffer)
            .ok_or_else(|| no_such("buffers", buffer, self.buffers.len()).at("buffer"))?;
        part(bytes, offset, length).ok_or_else(|| {
            let what = format!(
                "{length} bytes from byte {offset} reach past the end of buffers[{buffer}], which has {}",
                bytes.len()
            );
            Flaw::new(what, "the file is damaged; export it again")
        })
    }
}

/// `length` bytes from `offset`, if all of them are there.
pub(super) fn part(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}

fn fetch<'a>(
    buffer: &gltf_json::Buffer,
    folder: &Folder,
    embedded: Option<&'a [u8]>,
    limit: u64,
) -> Result<Cow<'a, [u8]>, Flaw> {
    let length = buffer.byte_length.0;
    if length > limit {
        let what =
            format!("{length} bytes; all buffers together may have {}", limits::BUFFER_BYTES);
        return Err(Flaw::new(what, "split the scene"));
    }
    let mut bytes = match (&buffer.uri, embedded) {
        (Some(uri), _) => Cow::Owned(folder.fetch(uri, limit).map_err(|flaw| flaw.at("uri"))?),
        (None, Some(chunk)) => Cow::Borrowed(chunk),
        (None, None) => {
            let what = "no URI, and the file has no binary chunk for it";
            return Err(Flaw::new(what, "export the file again"));
        }
    };
    if (bytes.len() as u64) < length {
        let what = format!("{length} bytes announced, {} found", bytes.len());
        return Err(Flaw::new(what, "the data is cut short; copy or export it again"));
    }
    match &mut bytes {
        Cow::Owned(bytes) => bytes.truncate(length as usize),
        Cow::Borrowed(bytes) => *bytes = &bytes[..length as usize],
    }
    Ok(bytes)
}
