//! A scene in 256 bits.

use super::Scene;
use serde::Serialize;

impl Scene {
    /// A hash (BLAKE3, hexadecimal) of everything that light depends on: geometry as the ray kernel
    /// stores it, shading normals, texture coordinates, materials, textures, luminaires, groups.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let mesh = self.bvh().mesh();
        for triangle in 0..self.triangle_count() {
            for corner in mesh.triangles[triangle as usize] {
                for c in mesh.positions[corner as usize] {
                    hasher.update(&c.to_bits().to_le_bytes());
                }
            }
            hasher.update(&self.material_index(triangle).to_le_bytes());
            hasher.update(&self.shape_of(triangle).to_le_bytes());
            for normal in self.corner_normals(triangle).into_iter().flatten() {
                let v = normal.to_vector();
                update_all(&mut hasher, &[v.x, v.y, v.z]);
            }
            for uv in self.corner_uvs(triangle).into_iter().flatten() {
                update_all(&mut hasher, &uv);
            }
        }
        update_json(&mut hasher, &self.materials());
        update_json(&mut hasher, &self.luminaires());
        update_json(&mut hasher, &self.groups());
        for texture in self.textures() {
            hasher.update(&texture.width.to_le_bytes());
            hasher.update(&texture.height.to_le_bytes());
            hasher.update(&texture.srgb);
        }
        hasher.finalize().to_hex().to_string()
    }
}

fn update_all(hasher: &mut blake3::Hasher, values: &[f64]) {
    for value in values {
        hasher.update(&value.to_bits().to_le_bytes());
    }
}

/// Plain values by their JSON text, whose numbers are exact.
fn update_json(hasher: &mut blake3::Hasher, value: &impl Serialize) {
    let text = serde_json::to_vec(value).expect("plain values always have a JSON text");
    hasher.update(&(text.len() as u64).to_le_bytes());
    hasher.update(&text);
}
