//! A file before it is on a disk.

/// A file by its name within the folder of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// Name without folders.
    pub name: String,
    /// Contents.
    pub bytes: Vec<u8>,
}

impl SceneFile {
    pub(super) fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into() }
    }
}
