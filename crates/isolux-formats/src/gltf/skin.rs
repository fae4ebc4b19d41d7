//! Skins at rest: vertices carried by the joints as the nodes stand (glTF 2.0, section 3.7.3).

use super::accessor;
use super::buffers::Document;
use super::nodes::{self, Placed};
use super::notes::{Flaw, no_such};
use isolux::geometry::{Normal, Point, Transform, Vector};
use std::collections::HashMap;

/// Where the nodes of the scene stand, by index.
pub(super) type WorldFromNode = HashMap<usize, Transform>;

/// The places of all nodes, asked for where there is a skin.
pub(super) fn places(placed: &[Placed]) -> WorldFromNode {
    placed.iter().map(|p| (p.node, p.world_from_node)).collect()
}

/// What takes a vertex from the mesh to the world, for each joint of a skin.
pub(super) fn world_from_mesh(
    document: &Document,
    skin: usize,
    world_from_node: &WorldFromNode,
) -> Result<Vec<Transform>, Flaw> {
    let skins = &document.root.skins;
    let record = skins.get(skin).ok_or_else(|| no_such("skins", skin, skins.len()).at("skin"))?;
    let at = |flaw: Flaw| flaw.rooted(format!("skins[{skin}]"));
    let inverse = record.inverse_bind_matrices.map(|accessor| {
        accessor::matrices(document, accessor.value()).map_err(|f| at(f.at("inverseBindMatrices")))
    });
    let inverse = inverse.transpose()?;
    if let Some(inverse) = inverse.as_ref().filter(|list| list.len() < record.joints.len()) {
        let what = format!("{} matrices for {} joints", inverse.len(), record.joints.len());
        let flaw = Flaw::new(what, "export the file again");
        return Err(at(flaw.at("inverseBindMatrices")));
    }
    let joints = record.joints.iter().map(|joint| joint.value()).enumerate();
    joints
        .map(|(k, joint)| {
            let world_from_joint = world_from_node.get(&joint).ok_or_else(|| {
                let what = format!("the joint nodes[{joint}] is not in the scene");
                Flaw::new(what, "export the skeleton with the mesh").at(format!("joints[{k}]"))
            })?;
            let joint_from_mesh = match &inverse {
                Some(list) => nodes::from_matrix(&affine(list[k]))
                    .map_err(|flaw| flaw.at(format!("inverseBindMatrices[{k}]")))?,
                None => Transform::IDENTITY,
            };
            Ok(world_from_joint.then_from(&joint_from_mesh))
        })
        .collect::<Result<_, Flaw>>()
        .map_err(at)
}

/// The matrix with a last row of 0 0 0 1 where it is that but for the rounding of an inversion in `f32`.
fn affine(mut matrix: [f64; 16]) -> [f64; 16] {
    const ROUNDING: f64 = 1e-4;
    let last = [(3, 0.0), (7, 0.0), (11, 0.0), (15, 1.0)];
    if last.iter().all(|&(k, value)| (matrix[k] - value).abs() < ROUNDING) {
        for (k, value) in last {
            matrix[k] = value;
        }
    }
    matrix
}

/// Four joints of every vertex, and their weights.
pub(super) struct Influence {
    pub(super) joints: Vec<[f64; 4]>,
    pub(super) weights: Vec<[f64; 4]>,
}

/// All joints of every vertex.
pub(super) struct Influences {
    pub(super) sets: Vec<Influence>,
}

impl Influences {
    /// The transform of every vertex: the mean of those of its joints by weight. Weights that do not
    /// add up to one are scaled; a vertex without any follows its first joint.
    pub(super) fn blend(
        &self,
        joints: &[Transform],
        vertices: usize,
    ) -> Result<Vec<Transform>, Flaw> {
        (0..vertices).map(|vertex| self.of_vertex(vertex, joints)).collect()
    }

    fn of_vertex(&self, vertex: usize, joints: &[Transform]) -> Result<Transform, Flaw> {
        let each = || {
            self.sets
                .iter()
                .flat_map(move |set| set.joints[vertex].into_iter().zip(set.weights[vertex]))
        };
        let sum: f64 = each().map(|(_, weight)| weight.max(0.0)).sum();
        let mut blended = Blend::default();
        for (index, (joint, weight)) in each().enumerate() {
            let weight = match sum > 0.0 {
                true => weight.max(0.0) / sum,
                false => f64::from(u8::from(index == 0)),
            };
            if weight == 0.0 {
                continue;
            }
            let transform = joints.get(joint as usize).ok_or_else(|| {
                let what = format!("vertex {vertex} follows joint {joint} of {}", joints.len());
                Flaw::new(what, "export the file again").at("attributes.JOINTS_0")
            })?;
            blended.add(transform, weight);
        }
        Ok(blended.0)
    }
}

struct Blend(Transform);

impl Default for Blend {
    fn default() -> Self {
        Self(Transform { columns: [Vector::ZERO; 3], translation: Vector::ZERO })
    }
}

impl Blend {
    fn add(&mut self, transform: &Transform, weight: f64) {
        let sum = |old: Vector, new: Vector| old + new * weight;
        let (old, new) = (self.0, transform);
        self.0 = Transform {
            columns: [0, 1, 2].map(|k| sum(old.columns[k], new.columns[k])),
            translation: sum(old.translation, new.translation),
        };
    }
}

/// Positions carried to the world.
pub(super) fn carry_points(positions: &mut [[f64; 3]], world_from_mesh: &[Transform]) {
    for (position, transform) in positions.iter_mut().zip(world_from_mesh) {
        *position = transform.point(Point::from(*position)).into();
    }
}

/// Normals turned to the world; zero, for which the scene takes the triangle's own, where one is lost.
pub(super) fn carry_normals(normals: &mut [[f64; 3]], world_from_mesh: &[Transform]) {
    for (normal, transform) in normals.iter_mut().zip(world_from_mesh) {
        let image = Vector::from(*normal).normal().and_then(|normal| transform.normal(normal));
        *normal = image.map(Normal::to_vector).unwrap_or_default().into();
    }
}

/// Turns the triangles back whose corners are mostly reflected on the way, so that their front stays the front.
pub(super) fn keep_fronts(triangles: &mut [[u32; 3]], world_from_mesh: &[Transform]) {
    let is_reflected: Vec<bool> =
        world_from_mesh.iter().map(|transform| transform.determinant() < 0.0).collect();
    for triangle in triangles {
        if triangle.iter().filter(|&&corner| is_reflected[corner as usize]).count() > 1 {
            triangle.swap(1, 2);
        }
    }
}
