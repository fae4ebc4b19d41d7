//! A file at hand to be written anew: its JSON, its data, and where the shapes of its scene come from.

use super::accessor::{self, Format};
use super::buffers::Document;
use super::meshes::Origin;
use super::notes::{Flaw, Notes};
use super::primitive::Source;
use super::{Reading, container, instances, limits, open, or_fail, resolve};
use crate::source::read_bytes;
use crate::{Problem, Problems, Reach};
use gltf_json::accessor::ComponentType;
use isolux::geometry::Transform;
use isolux::scene::Shape;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// An opened file.
pub(crate) struct Opened {
    /// All that the file says.
    pub(crate) json: Value,
    /// The shapes of its default scene, in the order in which it is solved.
    pub(crate) shapes: Vec<(Origin, Shape)>,
    path: PathBuf,
    document: Document<'static>,
}

/// The elements of an accessor as stored, one after the other.
pub(crate) struct Elements {
    pub(crate) bytes: Vec<u8>,
    format: Format,
}

impl Opened {
    /// Opens a file and reads its scene. What is left out of that was said when it was solved.
    pub(crate) fn open(path: &Path, reach: Reach) -> Result<Self, Problems> {
        let mut notes = Notes::new(path);
        let bytes = read_bytes(path, limits::BUFFER_BYTES)?;
        let container = or_fail(container::open(&bytes), &mut notes)?;
        let (document, placed) = open((path, reach), &container, &mut notes)?;
        let (parts, origins) = resolve(&document, &placed, (path, Reading::default()), &mut notes);
        notes.check()?;
        let json = serde_json::from_slice(container.json)
            .map_err(|error| Problem::new(path, "", error.to_string(), "export the file again"))?;
        let shapes = origins.into_iter().zip(parts.shapes).collect();
        Ok(Self { json, shapes, path: path.to_owned(), document: document.into_owned() })
    }

    /// A finding about the file.
    pub(crate) fn problem(
        &self,
        place: impl Into<String>,
        what: impl Into<String>,
        remedy: &str,
    ) -> Problem {
        Problem::new(&self.path, place, what, remedy)
    }

    /// Its path.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Corners of the triangles of a primitive in the order of the file.
    pub(crate) fn triangles(&self, origin: Origin) -> Result<Vec<[u32; 3]>, Problem> {
        let record = &self.document.root.meshes[origin.mesh].primitives[origin.primitive];
        let source = Source::new(&self.document, record, origin.mesh, origin.primitive);
        let size = self.told(source.size(&mut Notes::new(&self.path)))?;
        self.told(size.map_or(Ok(Vec::new()), |size| source.triangles(size)))
    }

    /// The elements of an accessor.
    pub(crate) fn elements(&self, accessor: usize) -> Result<Elements, Problem> {
        let (format, bytes) = self.told(accessor::packed(&self.document, accessor))?;
        Ok(Elements { bytes, format })
    }

    /// Whether an accessor was stored compressed, and elsewhere than it says.
    pub(crate) fn is_unpacked(&self, accessor: usize) -> bool {
        self.document.unpacked.accessors.contains_key(&accessor)
    }

    /// The bytes of a view, unpacked.
    pub(crate) fn view(&self, index: usize) -> Result<&[u8], Problem> {
        self.told(self.document.view(index)).map(|view| view.bytes)
    }

    /// Where the copies of a node's mesh stand in the node.
    pub(crate) fn instances(&self, node: usize) -> Result<Vec<Transform>, Problem> {
        let found = self.told(instances::node_from_instances(&self.document, node))?;
        Ok(found.unwrap_or_default())
    }

    /// The bytes of a file that the file names.
    pub(crate) fn linked(&self, uri: &str, place: &str) -> Result<Vec<u8>, Problem> {
        let fetched = self.document.folder.fetch(uri, limits::PICTURE_BYTES);
        self.told(fetched.map_err(|flaw| flaw.rooted(place)))
    }

    fn told<T>(&self, result: Result<T, Flaw>) -> Result<T, Problem> {
        result.map_err(|flaw| flaw.into_problem(&self.path))
    }
}

impl Elements {
    /// Bytes of an element.
    pub(crate) fn size(&self) -> usize {
        self.format.element_bytes()
    }

    /// The least and the largest value of each component, of elements of this format.
    pub(crate) fn bounds(&self, bytes: &[u8]) -> Vec<[f64; 2]> {
        let raw = Format { normalized: false, ..self.format };
        let size = raw.component.size();
        let mut bounds = vec![[f64::INFINITY, f64::NEG_INFINITY]; raw.width];
        for element in bytes.chunks_exact(raw.element_bytes()) {
            for (component, [least, most]) in element.chunks_exact(size).zip(&mut bounds) {
                let value = accessor::number(raw, component);
                (*least, *most) = (least.min(value), most.max(value));
            }
        }
        bounds
    }

    /// Turns vectors around.
    pub(crate) fn negate(&self, bytes: &mut [u8]) {
        match self.format.component {
            ComponentType::F32 => bytes.iter_mut().skip(3).step_by(4).for_each(|b| *b ^= 0x80),
            ComponentType::I8 => {
                bytes.iter_mut().for_each(|b| *b = (*b as i8).saturating_neg() as u8);
            }
            ComponentType::I16 => bytes.as_chunks_mut().0.iter_mut().for_each(|pair| {
                *pair = i16::from_le_bytes(*pair).saturating_neg().to_le_bytes();
            }),
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32 => {}
        }
    }
}
