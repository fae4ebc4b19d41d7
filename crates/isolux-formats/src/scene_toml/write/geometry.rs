//! Shapes as one glTF file: a mesh each, named as the shape, of a material that is named as in the
//! `scene.toml`, which says what it is.

use super::file::SceneFile;
use super::materials::names;
use super::text::quoted;
use isolux::scene::{Body, Dielectric, Finish, Material, SceneParts, Shape, UpAxis};
use isolux::units::Rgb;
use serde_json::{Value, json};

const DOCUMENT: &str = "scene.gltf";
const BUFFER: &str = "scene.bin";
/// Component types and targets of glTF 2.0.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
/// The extension by which glass is told from white plastic.
const TRANSMISSION: &str = "KHR_materials_transmission";

/// The entry of the `scene.toml`.
pub(super) fn text(parts: &SceneParts) -> String {
    let mut toml = format!("\n[[geometry]]\nfile = \"{DOCUMENT}\"\n\n[geometry.materials]\n");
    for name in used_names(parts) {
        toml += &format!("{0} = {0}\n", quoted(&name));
    }
    toml
}

/// Materials that something is made of.
fn used_names(parts: &SceneParts) -> impl Iterator<Item = String> {
    let used: Vec<u32> = filled(parts).map(|shape| shape.material).collect();
    let numbered = (0..).zip(names(parts));
    numbered.filter(move |(index, _)| used.contains(index)).map(|(_, name)| name)
}

fn filled(parts: &SceneParts) -> impl Iterator<Item = &Shape> {
    parts.shapes.iter().filter(|shape| !shape.triangles.is_empty())
}

/// The document and its buffer.
pub(super) fn files(parts: &SceneParts) -> [SceneFile; 2] {
    let mut writer = Writer { up: parts.up, ..Writer::default() };
    let mut meshes = Vec::new();
    for shape in filled(parts) {
        let primitive = writer.primitive(shape);
        meshes.push(json!({ "name": shape.name, "primitives": [primitive] }));
    }
    let nodes: Vec<Value> = filled(parts)
        .enumerate()
        .map(|(mesh, shape)| json!({ "name": shape.name, "mesh": mesh }))
        .collect();
    let roots: Vec<usize> = (0..nodes.len()).collect();
    let is_glass = |m: &Material| matches!(m.body, Body::Dielectric(_));
    let extensions: Vec<&str> =
        parts.materials.iter().any(is_glass).then_some(TRANSMISSION).into_iter().collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("isolux ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": parts.name, "nodes": roots }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials(parts),
        "accessors": writer.accessors,
        "bufferViews": writer.views,
        "buffers": [{ "uri": BUFFER, "byteLength": writer.bytes.len() }],
    });
    if !extensions.is_empty() {
        document["extensionsUsed"] = json!(extensions);
    }
    let text = format!("{document:#}\n");
    [SceneFile::new(DOCUMENT, text), SceneFile::new(BUFFER, writer.bytes)]
}

/// As near as glTF comes; the `scene.toml` is what counts.
fn materials(parts: &SceneParts) -> Vec<Value> {
    names(parts).into_iter().zip(&parts.materials).map(|(n, m)| material(n, &m.body)).collect()
}

fn material(name: String, body: &Body) -> Value {
    let (front, back) = match body {
        Body::Dielectric(glass) => return pane(name, glass),
        Body::Opaque { front, back } => (front, back),
    };
    let is_mirror = front.is_pure_mirror();
    let Rgb([red, green, blue]) = if is_mirror { front.mirror } else { front.diffuse.colour };
    json!({
        "name": name,
        "doubleSided": *back != Finish::BLACK,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": u8::from(is_mirror),
            "roughnessFactor": u8::from(!is_mirror),
        },
    })
}

fn pane(name: String, glass: &Dielectric) -> Value {
    let Rgb([red, green, blue]) = glass.transmittance;
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0,
            "roughnessFactor": 0,
        },
        "extensions": { TRANSMISSION: { "transmissionFactor": 1 } },
    })
}

#[derive(Default)]
struct Writer {
    up: UpAxis,
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Writer {
    fn primitive(&mut self, shape: &Shape) -> Value {
        let positions: Vec<[f32; 3]> = shape.positions.iter().map(|&p| self.turned(p)).collect();
        let position = self.vectors(&positions, "VEC3");
        let ends = |pick: fn(f32, f32) -> f32, start: f32| {
            positions.iter().fold([start; 3], |end, p| [0, 1, 2].map(|k| pick(end[k], p[k])))
        };
        self.accessors[position]["min"] = json!(ends(f32::min, f32::INFINITY));
        self.accessors[position]["max"] = json!(ends(f32::max, f32::NEG_INFINITY));
        let mut attributes = json!({ "POSITION": position });
        if let Some(normals) = &shape.normals {
            let normals: Vec<[f32; 3]> = normals.iter().map(|&n| self.turned(n)).collect();
            attributes["NORMAL"] = json!(self.vectors(&normals, "VEC3"));
        }
        if let Some(uvs) = &shape.uvs {
            let uvs: Vec<[f32; 2]> = uvs.iter().map(|uv| uv.map(|c| c as f32)).collect();
            attributes["TEXCOORD_0"] = json!(self.vectors(&uvs, "VEC2"));
        }
        let corners: Vec<u8> =
            shape.triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
        let indices =
            self.accessor(&corners, INDICES, UNSIGNED, 3 * shape.triangles.len(), "SCALAR");
        json!({ "attributes": attributes, "indices": indices, "material": shape.material })
    }

    /// glTF is y-up; without signs of zeros.
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f32; 3] {
        let turned = match self.up {
            UpAxis::Y => [x, y, z],
            UpAxis::Z => [x, z, -y],
        };
        turned.map(|c| (c + 0.0) as f32)
    }

    fn vectors<const N: usize>(&mut self, vectors: &[[f32; N]], kind: &str) -> usize {
        let bytes: Vec<u8> = vectors.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
        self.accessor(&bytes, VERTICES, FLOAT, vectors.len(), kind)
    }

    fn accessor(
        &mut self,
        bytes: &[u8],
        target: u32,
        component: u32,
        count: usize,
        kind: &str,
    ) -> usize {
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target,
        }));
        self.bytes.extend_from_slice(bytes);
        self.accessors.push(json!({
            "bufferView": self.views.len() - 1, "componentType": component, "count": count, "type": kind,
        }));
        self.accessors.len() - 1
    }
}
