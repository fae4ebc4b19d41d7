//! Where shapes come from.

use crate::gltf::{Opened, Origin};
use serde_json::Value;

/// A primitive of the file as written.
pub(super) fn primitive(opened: &Opened, origin: Origin) -> &Value {
    &opened.json["meshes"][origin.mesh]["primitives"][origin.primitive]
}

/// Its place in the file.
pub(super) fn place(origin: Origin) -> String {
    format!("meshes[{}].primitives[{}]", origin.mesh, origin.primitive)
}
