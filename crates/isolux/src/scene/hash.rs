//! A scene in 256 bits.

use super::{Body, Finish, Material, Scene};
use crate::units::Rgb;
use isolux_geometry::Point;
use rayon::prelude::*;
use serde::Serialize;
use std::io;

/// Bytes that are hashed at once, at least.
const AT_ONCE: usize = 1 << 16;

/// Luminaires that are written by one task, and tasks whose texts are in memory together: a luminaire with a measured table has some
/// twenty kilobytes of text.
const TOGETHER: usize = 64;
const TASKS: usize = 16;

impl Scene {
    /// A hash (BLAKE3, hexadecimal) of everything that light depends on: geometry as the ray kernel
    /// stores it, shading normals, texture coordinates, materials, textures, luminaires, groups.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        self.update_with_triangles(&mut hasher);
        update_json(&mut hasher, &self.materials());
        update_json_of_each(&mut hasher, self.luminaires());
        update_json(&mut hasher, &self.groups());
        self.update_with_textures(&mut hasher);
        hasher.finalize().to_hex().to_string()
    }

    /// The same of the surfaces alone, without any light of their own.
    pub fn surfaces_hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        self.update_with_triangles(&mut hasher);
        let materials: Vec<Material> = self.materials().iter().map(dark).collect();
        update_json(&mut hasher, &materials);
        self.update_with_textures(&mut hasher);
        hasher.finalize().to_hex().to_string()
    }

    fn update_with_triangles(&self, hasher: &mut blake3::Hasher) {
        let mesh = self.bvh().mesh();
        // BLAKE3 hashes many bytes at once faster than a few at a time.
        let mut bytes = Vec::with_capacity(2 * AT_ONCE);
        if mesh.origin != Point::ORIGIN {
            add(&mut bytes, &<[f64; 3]>::from(mesh.origin));
        }
        for triangle in 0..self.triangle_count() {
            for corner in mesh.triangles[triangle as usize] {
                let position = mesh.positions[corner as usize];
                bytes.extend(position.iter().flat_map(|c| c.to_bits().to_le_bytes()));
            }
            bytes.extend(self.material_index(triangle).to_le_bytes());
            bytes.extend(self.shape_of(triangle).to_le_bytes());
            for normal in self.corner_normals(triangle).into_iter().flatten() {
                let v = normal.to_vector();
                add(&mut bytes, &[v.x, v.y, v.z]);
            }
            for uv in self.corner_uvs(triangle).into_iter().flatten() {
                add(&mut bytes, &uv);
            }
            if bytes.len() >= AT_ONCE {
                hasher.update(&bytes);
                bytes.clear();
            }
        }
        hasher.update(&bytes);
    }

    fn update_with_textures(&self, hasher: &mut blake3::Hasher) {
        for texture in self.textures() {
            hasher.update(&texture.width.to_le_bytes());
            hasher.update(&texture.height.to_le_bytes());
            hasher.update(&texture.srgb);
        }
    }
}

fn dark(material: &Material) -> Material {
    let off = |finish: &Finish| Finish { luminance_cd_m2: Rgb::BLACK, ..finish.clone() };
    let body = match &material.body {
        Body::Opaque { front, back } => Body::Opaque { front: off(front), back: off(back) },
        glass @ Body::Dielectric(_) => glass.clone(),
    };
    Material { body, ..material.clone() }
}

fn add(bytes: &mut Vec<u8>, values: &[f64]) {
    bytes.extend(values.iter().flat_map(|value| value.to_bits().to_le_bytes()));
}

/// Plain values by their JSON text, whose numbers are exact.
fn update_json(hasher: &mut blake3::Hasher, value: &impl Serialize) {
    update_text(hasher, &json(value));
}

/// The same of many plain values, on all threads. They are written twice, as their length comes first and their text is too long to keep.
fn update_json_of_each(hasher: &mut blake3::Hasher, values: &[impl Serialize + Sync]) {
    let written: usize = values.par_iter().map(json_length).sum();
    // With brackets about all, and a comma between two.
    let length = written + values.len().saturating_sub(1) + 2;
    hasher.update(&(length as u64).to_le_bytes());
    hasher.update(b"[");
    for (number, some) in values.chunks(TOGETHER * TASKS).enumerate() {
        let parts: Vec<String> = some.par_chunks(TOGETHER).map(|some| json(&some)).collect();
        for (index, part) in parts.iter().enumerate() {
            hasher.update(if number + index > 0 { b"," } else { b"" });
            hasher.update(&part.as_bytes()[1..part.len() - 1]);
        }
    }
    hasher.update(b"]");
}

/// Bytes that are counted and let go.
struct Counted(usize);

impl io::Write for Counted {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn json_length(value: &impl Serialize) -> usize {
    let mut counted = Counted(0);
    serde_json::to_writer(&mut counted, value).expect("plain values always have a JSON text");
    counted.0
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain values always have a JSON text")
}

/// A text and before it its length, so that none runs into the next.
fn update_text(hasher: &mut blake3::Hasher, text: &str) {
    hasher.update(&(text.len() as u64).to_le_bytes());
    hasher.update(text.as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Piece by piece the bytes are those of the whole text.
    #[test]
    fn many_values_are_hashed_as_one_list() {
        for count in [0, 1, 2, TOGETHER, TOGETHER + 1, 2 * TOGETHER * TASKS + 3] {
            let values: Vec<(usize, String)> = (0..count).map(|k| (k, "x".repeat(k % 7))).collect();
            let [mut whole, mut pieces] = [blake3::Hasher::new(), blake3::Hasher::new()];
            update_json(&mut whole, &values);
            update_json_of_each(&mut pieces, &values);
            assert_eq!(whole.finalize(), pieces.finalize(), "{count}");
        }
    }
}
