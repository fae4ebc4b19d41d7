//! Small files made by the tests.

use isolux::scene::{SceneParts, Shape};
use isolux_formats::{Loaded, Problems, gltf};
use serde_json::{Value, json};
use std::path::Path;

pub(crate) const FLOAT: u32 = 5126;
pub(crate) const U8: u32 = 5121;
pub(crate) const U16: u32 = 5123;
pub(crate) const U32: u32 = 5125;
pub(crate) const I8: u32 = 5120;
pub(crate) const I16: u32 = 5122;

/// A file as JSON and binary chunk.
#[derive(Clone)]
pub(crate) struct File {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

impl File {
    /// Nothing but a version.
    pub(crate) fn empty() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "buffers": [{"byteLength": 0}],
            "bufferViews": [], "accessors": [],
        });
        Self { json, binary: Vec::new() }
    }

    /// One triangle in the plane z = 0, grey, one-sided: mesh 0 of node 0, accessor 0, material 0.
    pub(crate) fn triangle() -> Self {
        let mut file = Self::empty();
        let positions = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        let accessor = file.accessor(&positions, "VEC3", FLOAT, 3);
        file.json["materials"] = json!([{
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0},
        }]);
        file.json["meshes"] =
            json!([{"primitives": [{"attributes": {"POSITION": accessor}, "material": 0}]}]);
        file.json["nodes"] = json!([{"mesh": 0}]);
        file.json["scenes"] = json!([{"nodes": [0]}]);
        file.json["scene"] = json!(0);
        file
    }

    /// Adds bytes as a view of their own; the index of the view.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = json!(self.binary.len());
        push(
            &mut self.json["bufferViews"],
            json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}),
        )
    }

    /// Adds bytes as a view and an accessor of their own; the index of the accessor.
    pub(crate) fn accessor(&mut self, bytes: &[u8], kind: &str, of: u32, count: usize) -> usize {
        let view = self.view(bytes);
        push(
            &mut self.json["accessors"],
            json!({"bufferView": view, "type": kind, "componentType": of, "count": count}),
        )
    }

    /// The first primitive of mesh 0.
    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut out = b"glTF".to_vec();
        let length = 12 + 8 + json.len() + 8 + self.binary.len();
        for word in [2, length as u32] {
            out.extend(word.to_le_bytes());
        }
        for (kind, data) in [(b"JSON", &json), (b"BIN\0", &self.binary)] {
            out.extend((data.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(data);
        }
        out
    }

    pub(crate) fn read(&self) -> Result<Loaded<SceneParts>, Problems> {
        read_bytes("scene.glb", &self.glb())
    }

    /// What a good file makes, with its warnings.
    pub(crate) fn load(&self) -> Loaded<SceneParts> {
        self.read().unwrap_or_else(|problems| panic!("{problems}"))
    }

    /// What a good file makes that nothing is left out of.
    pub(crate) fn parts(&self) -> SceneParts {
        let loaded = self.load();
        assert_eq!(loaded.warnings, [], "unexpected warnings");
        loaded.value
    }

    /// The only shape of a good file.
    pub(crate) fn shape(&self) -> Shape {
        let mut parts = self.load().value;
        assert_eq!(parts.shapes.len(), 1);
        parts.shapes.remove(0)
    }
}

pub(crate) fn push(list: &mut Value, value: Value) -> usize {
    let list = list.as_array_mut().unwrap();
    list.push(value);
    list.len() - 1
}

/// Reads bytes as a file of that name, alone in its directory.
pub(crate) fn read_bytes(name: &str, bytes: &[u8]) -> Result<Loaded<SceneParts>, Problems> {
    let directory = tempfile::tempdir().unwrap();
    read_in(directory.path(), name, bytes)
}

pub(crate) fn read_in(
    directory: &Path,
    name: &str,
    bytes: &[u8],
) -> Result<Loaded<SceneParts>, Problems> {
    let path = directory.join(name);
    std::fs::write(&path, bytes).unwrap();
    gltf::read(&path)
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// That one of the warnings speaks of this, at this place.
pub(crate) fn assert_warns(loaded: &Loaded<SceneParts>, place: &str, words: &str) {
    let found = loaded.warnings.iter().any(|w| w.place.contains(place) && w.what.contains(words));
    assert!(found, "no warning `{words}` at `{place}` in {:#?}", loaded.warnings);
}

/// A PNG of one row of pixels.
pub(crate) fn png(pixels: &[[u8; 3]]) -> Vec<u8> {
    let width = pixels.len() as u32;
    let picture = image::RgbImage::from_raw(width, 1, pixels.concat()).unwrap();
    let mut out = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut out, image::ImageFormat::Png).unwrap();
    out.into_inner()
}

/// A PNG with alpha, as wide as is said.
pub(crate) fn png_rgba(width: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    let height = pixels.len() as u32 / width;
    let picture = image::RgbaImage::from_raw(width, height, pixels.concat()).unwrap();
    let mut out = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut out, image::ImageFormat::Png).unwrap();
    out.into_inner()
}
