//! Illumination maps as `.glb` files: lit geometry for every viewer, and all of the map and its
//! scene for isolux itself. `docs/book/map-format.md` describes the format.

mod alone;
mod arrays;
mod attributes;
mod backs;
mod bytes;
mod container;
pub(crate) mod display;
mod displayed;
mod document;
pub(crate) mod images;
mod lightmap_arrays;
mod looks;
mod nodes;
mod preview;
mod read;
mod record;
mod scene_arrays;
mod skies;
mod texels;
mod value_arrays;
mod vertices;
mod write;

pub use alone::{scene_bytes, scene_of_bytes};
pub(crate) use container::pack;
pub(crate) use displayed::{Displayed, displayed};
pub use preview::Preview;
pub use read::{MapFile, is_export, is_map, read, read_with_texels};
pub(crate) use texels::Parts;
pub use texels::{TexelFile, write_texels};
pub use vertices::{GroupLight, VertexColours, VertexFile, write_vertices};
pub use write::write;

/// A map that does not fit into a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the map takes {bytes} bytes, more than the 4 GiB of a .glb file; ask for less accuracy")]
pub struct MapTooLarge {
    /// Bytes of the file, or of the part that is too large alone.
    pub bytes: u64,
}

/// What is wrong with a map file, before it is known which file it is.
#[derive(Clone, Debug, PartialEq)]
struct Fault {
    place: String,
    what: String,
}

impl Fault {
    fn new(place: impl Into<String>, what: impl Into<String>) -> Self {
        Self { place: place.into(), what: what.into() }
    }
}
