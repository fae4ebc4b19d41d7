//! EXT_mesh_gpu_instancing: one node, many copies of its mesh.

use super::buffers::Document;
use super::notes::Flaw;
use super::{accessor, limits, nodes};
use isolux::geometry::Transform;
use serde_json::Value;

/// Name of the extension.
pub(crate) const NAME: &str = "EXT_mesh_gpu_instancing";

/// Where the copies of a node's mesh stand in the node, `None` for a mesh that stands there once.
pub(super) fn node_from_instances(
    document: &Document,
    node: usize,
) -> Result<Option<Vec<Transform>>, Flaw> {
    let extensions = document.root.nodes[node].extensions.as_ref();
    let Some(extension) = extensions.and_then(|e| e.others.get(NAME)) else { return Ok(None) };
    let read = Attributes { document, record: extension.get("attributes") };
    read.transforms().map(Some).map_err(|flaw| flaw.at(format!("extensions.{NAME}.attributes")))
}

struct Attributes<'a> {
    document: &'a Document<'a>,
    record: Option<&'a Value>,
}

impl Attributes<'_> {
    fn transforms(&self) -> Result<Vec<Transform>, Flaw> {
        let count = self.count()?;
        let translations = self.vectors::<3>("TRANSLATION", count, [0.0; 3])?;
        let rotations = self.vectors::<4>("ROTATION", count, [0.0, 0.0, 0.0, 1.0])?;
        let scales = self.vectors::<3>("SCALE", count, [1.0; 3])?;
        let each = translations.into_iter().zip(rotations).zip(scales);
        each.map(|((translation, rotation), [x, y, z])| {
            let rotation = nodes::unit_quaternion(rotation).map_err(|f| f.at("ROTATION"))?;
            Ok(Transform::translation(translation.into())
                .then_from(&Transform::rotation(rotation))
                .then_from(&Transform::scale(x, y, z)))
        })
        .collect()
    }

    fn accessor(&self, name: &str) -> Result<Option<usize>, Flaw> {
        let Some(value) = self.record.and_then(|record| record.get(name)) else { return Ok(None) };
        let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
        index.map(Some).ok_or_else(|| Flaw::new("is no index", "export the file again").at(name))
    }

    /// How many copies there are: what all attributes agree on.
    fn count(&self) -> Result<usize, Flaw> {
        let mut count = None;
        for name in ["TRANSLATION", "ROTATION", "SCALE"] {
            let Some(accessor) = self.accessor(name)? else { continue };
            let own = accessor::format(self.document, accessor)?.count;
            if *count.get_or_insert(own) != own {
                let what = format!("{own} elements where another attribute has another number");
                return Err(Flaw::new(what, "export the file again").at(name));
            }
        }
        let count = count.unwrap_or(1);
        if count > limits::INSTANCES {
            let what = format!("{count} instances, at most {} are read", limits::INSTANCES);
            return Err(Flaw::new(what, "split the scene"));
        }
        Ok(count)
    }

    fn vectors<const N: usize>(
        &self,
        name: &str,
        count: usize,
        default: [f64; N],
    ) -> Result<Vec<[f64; N]>, Flaw> {
        match self.accessor(name)? {
            Some(accessor) => accessor::vectors(self.document, accessor),
            None => Ok(vec![default; count]),
        }
    }
}
