//! A written file, taken apart.

use crate::written::illuminance_lx;
use image::DynamicImage;
use isolux::geometry::{Point, Transform, Triangle, Vector};
use serde_json::Value;
use std::collections::HashMap;

/// The parts of a `.glb`.
pub(crate) struct Glb {
    pub(crate) json: Value,
    binary: Vec<u8>,
}

impl Glb {
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
        Self { json, binary: bytes[28 + word(12)..].to_vec() }
    }

    pub(crate) fn node(&self, name: &str) -> &Value {
        self.json["nodes"].as_array().unwrap().iter().find(|n| n["name"] == name).unwrap()
    }

    /// The mesh of a node.
    pub(crate) fn mesh_of(&self, name: &str) -> &Value {
        &self.json["meshes"][number(&self.node(name)["mesh"])]
    }

    pub(crate) fn view(&self, view: &Value) -> &[u8] {
        let view = &self.json["bufferViews"][number(view)];
        let start = view.get("byteOffset").map_or(0, number);
        &self.binary[start..start + number(&view["byteLength"])]
    }

    /// Elements of an accessor as numbers, normalized ones as they are stored.
    pub(crate) fn numbers(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.json["accessors"][number(accessor)];
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let count = number(&accessor["count"]);
        let Some(view) = accessor.get("bufferView") else { return vec![vec![0.0; width]; count] };
        let size = match number(&accessor["componentType"]) {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let stride = self.json["bufferViews"][number(view)].get("byteStride");
        let stride = stride.map_or(width * size, number);
        let bytes = self.view(view);
        let one = |bytes: &[u8]| match (number(&accessor["componentType"]), bytes) {
            (5126, bytes) => f64::from(f32::from_le_bytes(bytes.try_into().unwrap())),
            (5120, &[a]) => f64::from(a as i8),
            (5122, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
            (_, bytes) => {
                let mut word = [0; 4];
                word[..bytes.len()].copy_from_slice(bytes);
                f64::from(u32::from_le_bytes(word))
            }
        };
        let element = |k: usize| {
            let bytes = &bytes[k * stride..k * stride + width * size];
            bytes.chunks(size).map(one).collect()
        };
        (0..count).map(element).collect()
    }

    /// Where every node of the default scene stands.
    pub(crate) fn placed(&self) -> Vec<(&Value, Transform)> {
        let mut open: Vec<(usize, Transform)> = Vec::new();
        let roots = self.json["scenes"][number(&self.json["scene"])]["nodes"].as_array().unwrap();
        open.extend(roots.iter().map(|node| (number(node), Transform::IDENTITY)));
        let mut placed = Vec::new();
        while let Some((node, world_from_parent)) = open.pop() {
            let node = &self.json["nodes"][node];
            let world_from_node = world_from_parent.then_from(&parent_from_node(node));
            placed.push((node, world_from_node));
            let children = node.get("children").and_then(Value::as_array);
            open.extend(
                children.into_iter().flatten().map(|child| (number(child), world_from_node)),
            );
        }
        placed
    }

    fn page(&self, texture: usize) -> DynamicImage {
        let image = &self.json["images"][number(&self.json["textures"][texture]["source"])];
        image::load_from_memory(self.view(&image["bufferView"])).unwrap()
    }

    /// Compares light of the lightmap with what it is known to be, in the middle of all triangles that have some; how many
    /// there were.
    pub(crate) fn check_light(&self, from_lux: f64) -> usize {
        let mut pages: HashMap<usize, DynamicImage> = HashMap::new();
        let mut checked = 0;
        for (node, world_from_node) in self.placed() {
            let Some(mesh) = node.get("mesh") else { continue };
            for primitive in self.json["meshes"][number(mesh)]["primitives"].as_array().unwrap() {
                let Some(material) = primitive.get("material") else { continue };
                let material = &self.json["materials"][number(material)];
                let Some(light) = material.pointer("/extensions/MOZ_lightmap") else { continue };
                let texture = number(&light["index"]);
                let page = pages.entry(texture).or_insert_with(|| self.page(texture));
                let intensity = light["intensity"].as_f64().unwrap();
                for (triangle, uvs) in
                    self.triangles(primitive, &light["texCoord"], &world_from_node)
                {
                    let expected = from_lux
                        * illuminance_lx(
                            triangle.point(1.0 / 3.0, 1.0 / 3.0),
                            triangle.normal().unwrap(),
                        );
                    let found = intensity * read(page, middle(&uvs));
                    // Half a code of eight bits of sRGB, at a third of the brightest, is 0.6 %; texels at rims are moved by less.
                    assert!(
                        (found / expected - 1.0).abs() < 0.01,
                        "{node}: {found} in place of {expected}"
                    );
                    checked += 1;
                }
            }
        }
        checked
    }

    fn triangles(
        &self,
        primitive: &Value,
        set: &Value,
        world_from_node: &Transform,
    ) -> Vec<(Triangle, [[f64; 2]; 3])> {
        let attributes = &primitive["attributes"];
        let positions = self.numbers(&attributes["POSITION"]);
        let uvs = self.numbers(&attributes[format!("TEXCOORD_{set}")]);
        let is_mirrored = world_from_node.determinant() < 0.0;
        let indices = self.numbers(&primitive["indices"]);
        let all = indices.as_chunks::<3>().0.iter().map(|corners| {
            let mut corners = [0, 1, 2].map(|k| corners[k][0] as usize);
            if is_mirrored {
                corners.swap(1, 2);
            }
            let point = |v: usize| {
                world_from_node.point(Point::new(positions[v][0], positions[v][1], positions[v][2]))
            };
            (Triangle { corners: corners.map(point) }, corners.map(|v| [uvs[v][0], uvs[v][1]]))
        });
        all.collect()
    }
}

pub(crate) fn number(value: &Value) -> usize {
    value.as_u64().unwrap_or_else(|| panic!("{value}")) as usize
}

fn middle(uvs: &[[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|k| uvs.iter().map(|uv| uv[k]).sum::<f64>() / 3.0)
}

/// The nearest texel, linear.
fn read(page: &DynamicImage, [u, v]: [f64; 2]) -> f64 {
    let page = page.as_rgb8().unwrap();
    let at = |c: f64, size: u32| ((c * f64::from(size)) as u32).min(size - 1);
    let code = f64::from(page.get_pixel(at(u, page.width()), at(v, page.height())).0[1]) / 255.0;
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

fn parent_from_node(node: &Value) -> Transform {
    let list = |key: &str| -> Option<Vec<f64>> {
        let list = node.get(key)?.as_array()?;
        Some(list.iter().map(|c| c.as_f64().unwrap()).collect())
    };
    if let Some(m) = list("matrix") {
        let column = |k: usize| Vector::new(m[4 * k], m[4 * k + 1], m[4 * k + 2]);
        return Transform { columns: [0, 1, 2].map(column), translation: column(3) };
    }
    let vector = |key: &str, usual: f64| {
        let list = list(key).unwrap_or(vec![usual; 3]);
        Vector::new(list[0], list[1], list[2])
    };
    let q = list("rotation").unwrap_or(vec![0.0, 0.0, 0.0, 1.0]);
    let scale = vector("scale", 1.0);
    Transform::translation(vector("translation", 0.0))
        .then_from(&Transform::rotation([q[0], q[1], q[2], q[3]]))
        .then_from(&Transform::scale(scale.x, scale.y, scale.z))
}
